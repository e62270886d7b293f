#include <fstream>

#include <gmock/gmock.h>
#include <unistd.h>

#include "bench/tune/store.h"
#include "core/input/usage_error.h"
#include "tests/support/variable.h"

namespace ptb {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

DeviceInfo device(const std::string& name = "FX", const std::string& driver = "3.1") {
    DeviceInfo info;
    info.key = "pocl:0";
    info.name = name;
    info.driver_version = driver;
    return info;
}

TunedKernel result(const std::string& kernel, int lanes, const DeviceInfo& of = device()) {
    const Case best{of.key, kernel, "thesis", {512, 512}, 2, 128, {64, 0}, lanes};
    TunedKernel tuned = tuned_kernel(of, "abc", best);
    tuned.ties = {best};
    tuned.samples = 12;
    tuned.tuned_at = "2026-11-29T10:00:00Z";  // the clock may step between two of them
    return tuned;
}

class Store : public testing::Test {
  protected:
    Store() { fs::remove_all(folder); }
    ~Store() override { fs::remove_all(folder); }
    std::string complaint(const std::string& text) {
        fs::create_directories(folder);
        std::ofstream(file) << text;
        try {
            read_tuned(file);
        } catch (const UsageError& error) {
            return error.what();
        }
        return "(accepted)";
    }
    const fs::path folder = fs::path(testing::TempDir()) / ("ptb-tune-store-" + std::to_string(::getpid()));
    const fs::path file = folder / "ptbench/tune.json";
};

TEST_F(Store, what_was_stored_is_read_again_and_nothing_else_is_left) {
    EXPECT_TRUE(read_tuned(file).empty());
    store_tuned(file, result("pt", 16));
    EXPECT_EQ(read_tuned(file), std::vector{result("pt", 16)});
    EXPECT_EQ(std::distance(fs::directory_iterator(file.parent_path()), {}), 1);
}

TEST_F(Store, a_new_result_takes_the_place_of_the_old_one_alone) {
    for (const auto& one :
         {result("pt", 4), result("thesis", 1), result("pt", 8, device("Z80")), result("pt", 16)})
        store_tuned(file, one);
    EXPECT_THAT(read_tuned(file),
                testing::ElementsAre(result("thesis", 1), result("pt", 8, device("Z80")), result("pt", 16)));
}

TEST_F(Store, anything_else_is_refused_in_one_line) {
    fs::create_directories(file.parent_path());
    EXPECT_THAT(complaint("[]"), HasSubstr("not what `ptbench tune` stores"));
    EXPECT_THAT(complaint(R"({"schema": "ptbench.tune.v2", "kernels": []})"), HasSubstr("ptbench.tune.v1"));
    EXPECT_THAT(complaint(R"({"schema": "ptbench.tune.v1"})"), HasSubstr("\"kernels\" is missing"));
    EXPECT_THAT(complaint(R"({"schema": "ptbench.tune.v1", "kernels": [7]})"), HasSubstr("/kernels/0"));
    EXPECT_THAT(complaint("{"), HasSubstr("not JSON"));
    EXPECT_THROW(store_tuned(file, result("pt", 16)), UsageError) << "and is not overwritten";
}

TEST(tuned_lookup, finds_what_is_true_of_device_driver_and_kernel) {
    const std::vector<TunedKernel> stored{result("pt", 8, device("Z80")), result("pt", 16)};
    EXPECT_EQ(look_up(stored, device(), "pt", "abc").found, &stored[1]);
    EXPECT_EQ(look_up(stored, device(), "pt", "abc").stale, "");
    const TunedLookup none = look_up(stored, device(), "thesis", "abc");
    EXPECT_FALSE(none.found);
    EXPECT_EQ(none.stale, "");
}

TEST(tuned_lookup, says_what_is_stale) {
    const std::vector<TunedKernel> stored{result("pt", 16)};
    const auto stale = [&](const DeviceInfo& here, const std::string& hash) {
        const TunedLookup lookup = look_up(stored, here, "pt", hash);
        EXPECT_FALSE(lookup.found);
        return lookup.stale;
    };
    EXPECT_EQ(stale(device("Z80"), "abc"), "tuned for FX, this is Z80");
    EXPECT_EQ(stale(device("FX", "5.0"), "abc"), "tuned for  , 3.1, this is  , 5.0");
    EXPECT_EQ(stale(device(), "def"), "tuned for kernel abc, this is def");
}

TEST(tune_file, lies_where_the_desktop_keeps_configs) {
    {
        const Variable config("XDG_CONFIG_HOME", "/x");
        EXPECT_EQ(default_tune_file(), "/x/ptbench/tune.json");
    }
    const Variable config("XDG_CONFIG_HOME", std::nullopt), home("HOME", "/h");
    EXPECT_EQ(default_tune_file(), "/h/.config/ptbench/tune.json");
}

}  // namespace
}  // namespace ptb
