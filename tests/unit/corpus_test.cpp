// What fuzzing found and reached (tests/fuzz), read again; a reader that fails on it aborts.
#include <algorithm>

#include <gtest/gtest.h>

#include "core/input/json.h"
#include "tests/fuzz/targets.h"

namespace ptb {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_in(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

TEST(Corpus, every_reader_takes_its_corpus) {
    for (const fuzz::Target& target : fuzz::targets()) {
        const auto files = files_in(fs::path(PTB_SOURCE_DIR) / "tests/fuzz/corpus" / target.name);
        EXPECT_FALSE(files.empty()) << target.name;
        for (const fs::path& file : files) {
            SCOPED_TRACE(file);
            target.feed(read_text(file));
        }
    }
}

}  // namespace
}  // namespace ptb
