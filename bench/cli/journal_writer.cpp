#include "bench/cli/journal_writer.h"

#include <fmt/format.h>

namespace ptb {

constexpr double between_syncs_s = 1;

JournalWriter::JournalWriter(const std::filesystem::path& file, ResultFile& result)
    : journal_(file, result), warnings_(result.warnings), synced_s_(steady_seconds()) {}

JournalWriter::~JournalWriter() { journal_.sync(); }

void JournalWriter::progressed(std::size_t, const Case&, const Response&) { sync_in_time(); }

void JournalWriter::finished(std::size_t, const Record& record) {
    if (broken_) return;
    try {
        journal_.append(record);
        sync_in_time();
    } catch (const std::exception& error) {
        broken_ = true;
        warnings_.push_back(fmt::format("the journal ends early: {}", error.what()));
    }
}

void JournalWriter::sync_in_time() {
    if (steady_seconds() - synced_s_ < between_syncs_s) return;
    journal_.sync();
    synced_s_ = steady_seconds();
}

}  // namespace ptb
