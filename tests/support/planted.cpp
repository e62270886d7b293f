#include "tests/support/planted.h"

#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

namespace ptb {

namespace {

std::string text_of(const std::filesystem::path& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// Each test has one of its own: ctest runs them at the same time.
std::filesystem::path folder_of_test() {
    const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
    return std::filesystem::path(PTB_BINARY_DIR) / "planted_kernels" /
           (std::string(test->test_suite_name()) + "." + test->name());
}

}  // namespace

std::filesystem::path plant(const Planted& fault) {
    const auto folder = folder_of_test();
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder.parent_path());
    std::filesystem::copy(std::filesystem::path(PTB_SOURCE_DIR) / "kernels", folder,
                          std::filesystem::copy_options::recursive);
    std::string text = text_of(folder / fault.file);
    const std::string right = fault.right;
    const auto at = text.find(right);
    EXPECT_NE(at, std::string::npos) << fault.file << " has no such text any more: " << right;
    EXPECT_EQ(text.find(right, at + 1), std::string::npos) << "more than once: " << right;
    if (at != std::string::npos) text.replace(at, right.size(), fault.wrong);
    std::ofstream(folder / fault.file) << text;
    return folder;
}

}  // namespace ptb
