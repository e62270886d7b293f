#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "bench/cli/formats.h"
#include "bench/cli/options.h"
#include "bench/record/record.h"
#include "bench/report/published.h"
#include "bench/worker/coordinator.h"
#include "core/file/path_lock.h"

namespace ptb {

/// The outputs of a run: a folder with everything, and what --json, --csv, --csv-samples, --md and --html
/// ask for beside it.
class Outputs {
  public:
    /// Creates the folder, holds it against other runs, and makes sure that everything can be written. Throws
    /// UsageError, leaving nothing.
    Outputs(const RunFlags& flags, const std::string& config, const std::string& started_at);
    /// Removes a folder that stayed empty.
    ~Outputs();
    Outputs(const Outputs&) = delete;
    Outputs& operator=(const Outputs&) = delete;

    /// The pictures that cases are to write. Of each device one: the better a case, the higher its rank, so
    /// that the best of those that are not skipped is there. At equal time: every case's own, since times
    /// will tell which those are. `done` are the records of a resumed run; the pictures of any other older
    /// run are removed.
    std::map<Case, ImageFile> pictures(Pictures kind, const std::vector<Case>& cases,
                                       const std::vector<Record>& done = {});
    /// Of the pictures that are wanted and there now, the cases that made them.
    std::vector<Picture> made(const std::vector<Record>& records) const;
    /// Removes those that were written in case they would be wanted.
    void keep(const std::vector<Picture>& pictures) const;
    std::filesystem::path journal() const;
    bool stdout_is_taken() const;

    /// Writes all files; `published` stands beside the run's own times. Throws std::runtime_error with the
    /// path, the reason, and where the journal is.
    void write(const ResultFile& result, const PublishedTable& published);

    /// What was written, pictures included.
    std::vector<std::string> written() const;

  private:
    explicit Outputs(std::filesystem::path folder);
    /// All that is written.
    Destinations files() const;
    void remove_pictures_but(const std::set<std::string>& kept) const;
    void write_all(const ResultFile& result, const PublishedTable& published);

    std::filesystem::path folder_;
    PathLock lock_;
    bool created_ = false;
    Destinations asked_;
    std::vector<std::string> written_;
    Pictures kind_ = Pictures::best;
    std::set<std::string> pictures_;
};

/// Opens a file for writing as the end of a run will, without leaving a new one behind. Throws UsageError
/// that names the flag.
void check_writable(const std::string& flag, const std::filesystem::path& file);

/// `text` as part of a file name: letters, digits, '.', '_' and '-' stay.
std::string file_safe(std::string text);

}  // namespace ptb
