#include "core/input/base64.h"

#include <gtest/gtest.h>

#include "core/input/usage_error.h"

namespace ptb {
namespace {

const std::pair<std::string, std::string> pairs[] = {
    {"", ""}, {"f", "Zg=="}, {"fo", "Zm8="}, {"foobar", "Zm9vYmFy"}, {std::string("\xff\xfe\0", 3), "//4A"},
};

TEST(Base64, is_that_of_rfc_4648) {
    for (const auto& [bytes, text] : pairs) EXPECT_EQ(base64(bytes), text);
}

TEST(Base64, leads_back_to_the_bytes) {
    for (const auto& [bytes, text] : pairs) EXPECT_EQ(from_base64(text), bytes);
    std::string all;
    for (int i = 0; i < 256; ++i) all += static_cast<char>(i);
    EXPECT_EQ(from_base64(base64(all)), all);
}

TEST(Base64, anything_else_is_refused) {
    for (const char* text : {"Z", "Zg=", "Zg=g", "Z===", "====", "Zm9v\n", "Zm 8", "Zm9_"})
        EXPECT_THROW(from_base64(text), UsageError) << text;
}

}  // namespace
}  // namespace ptb
