#pragma once

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "bench/record/record.h"

namespace ptb {

/// The run as it happens, in JSON Lines: the result file without its cases, then one record a line, each
/// flushed. A process killed at any moment loses at most the record that it was writing.
class Journal {
  public:
    /// Starts the file anew with what `so_far` holds, cases included (those that a resumed run keeps).
    /// Throws std::runtime_error with the path and the reason.
    Journal(std::filesystem::path file, const ResultFile& so_far);
    void append(const Record& record);
    /// Onto the disk, where a power cut spares it, unless it is there.
    void sync();

  private:
    struct Close {
        void operator()(std::FILE* stream) const { std::fclose(stream); }
    };
    std::filesystem::path file_;
    std::unique_ptr<std::FILE, Close> stream_;
    bool synced_ = true;
};

/// Reads a journal a record at a time: those of a large fleet are not held in memory.
class JournalReader {
  public:
    /// Throws UsageError unless the first line is a result file's.
    JournalReader(std::istream& in, std::string origin);
    /// The result file, without its cases.
    const ResultFile& header() const { return header_; }
    /// The next record; nothing at the end, or where a last line was cut short. Throws UsageError on anything
    /// else.
    std::optional<Record> next();

  private:
    std::istream& in_;
    std::string origin_;
    ResultFile header_;
    int line_ = 1;
};

/// A journal as a file, opened. Throws UsageError.
std::ifstream open_journal(const std::filesystem::path& file);

/// What the text of a journal holds; a last line that was cut short is left out. Throws UsageError on
/// anything else.
ResultFile parse_journal(std::string_view text, const std::string& origin);
/// Whether the first of several lines is JSON by itself, as a result file's is not.
bool is_journal(std::string_view text);

/// What a journal or a result file holds. Throws UsageError.
ResultFile read_run(const std::filesystem::path& file);

}  // namespace ptb
