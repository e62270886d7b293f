#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/record/journal.h"
#include "bench/worker/coordinator.h"

namespace ptb {

/// Appends each record to the journal, and brings those of each second onto the disk together; a journal that
/// cannot be written is a warning, not the end of the run.
class JournalWriter : public RunObserver {
  public:
    JournalWriter(const std::filesystem::path& file, ResultFile& result);
    ~JournalWriter() override;
    JournalWriter(const JournalWriter&) = delete;
    JournalWriter& operator=(const JournalWriter&) = delete;
    void progressed(std::size_t index, const Case& c, const Response& response) override;
    void finished(std::size_t index, const Record& record) override;

  private:
    void sync_in_time();

    Journal journal_;
    std::vector<std::string>& warnings_;
    bool broken_ = false;
    double synced_s_;
};

}  // namespace ptb
