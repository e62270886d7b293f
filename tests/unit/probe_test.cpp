#include "bench/worker/probe.h"

#include <fstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/variable.h"

namespace ptb {
namespace {

namespace fs = std::filesystem;

/// A folder of .icd files that goes away.
struct VendorFolder {
    fs::path path = fs::path(testing::TempDir()) / fmt::format("ptb-vendors-{}", ::getpid());
    VendorFolder() { fs::create_directories(path); }
    ~VendorFolder() { fs::remove_all(path); }
    std::string add(const std::string& name, const std::string& library) const {
        std::ofstream(path / name) << library << "\n";
        return (path / name).string();
    }
};

DeviceInfo device(const std::string& key, int platform, int index) {
    DeviceInfo info;
    info.key = key;
    info.platform = "Portable Computing Language";
    info.platform_version = "OpenCL 3.0 PoCL 3.1";
    info.name = "cpu";
    info.driver_version = "3.1";
    info.platform_index = platform;
    info.device_index = index;
    return info;
}

std::vector<DeviceInfo> from(const std::string& icd, std::vector<DeviceInfo> devices) {
    for (auto& each : devices) each.icd = icd;
    return devices;
}

DeviceList probe_fake(const std::string& behaviour, int patience_ms = 5000) {
    const Variable fake("FAKE_PROBE", behaviour);
    return probe({{"/etc/fake.icd", "libfake.so"}}, {PTB_FAKE_WORKER, {}},
                 std::chrono::milliseconds(patience_ms));
}

std::string reason_of(const DeviceList& list) {
    return list.broken.size() == 1 && list.devices.empty() ? list.broken[0].reason : "not broken";
}

TEST(icd, files_are_found_as_a_loader_finds_them) {
    const VendorFolder folder;
    const std::string b = folder.add("b.icd", "libb.so");
    const std::string a = folder.add("a.icd", "liba.so");
    folder.add("readme.txt", "no driver");
    EXPECT_EQ(find_icds({folder.path.string(), ""}), (std::vector<Icd>{{a, "liba.so\n"}, {b, "libb.so\n"}}));
    EXPECT_EQ(find_icds({b, ""}), (std::vector<Icd>{{b, "libb.so\n"}}));
    EXPECT_EQ(find_icds({b, "/opt/x.so:/opt/y.so"}),
              (std::vector<Icd>{{b, "libb.so\n"}, {"/opt/x.so", "/opt/x.so"}, {"/opt/y.so", "/opt/y.so"}}));
    EXPECT_TRUE(find_icds({(folder.path / "missing").string(), ""}).empty());
}

TEST(icd, a_private_folder_holds_one_icd_and_goes_away) {
    fs::path path;
    {
        const IcdFolder folder({"/opt/x.so", "/opt/x.so"});
        path = folder.path();
        EXPECT_EQ(find_icds({path.string(), ""}),
                  (std::vector<Icd>{{(path / "x.icd").string(), "/opt/x.so"}}));
    }
    EXPECT_FALSE(fs::exists(path));
}

TEST(icd, a_folder_that_a_killed_process_left_goes_a_day_later) {
    const Icd icd{"/opt/x.so", "/opt/x.so"};
    const IcdFolder held(icd);
    const fs::path temporary = held.path().parent_path();
    const fs::path left = temporary / "ptbench-icd-left", fresh = temporary / "ptbench-icd-fresh";
    for (const fs::path& path : {left, fresh}) fs::create_directory(path);
    for (const fs::path& path : {left, held.path()})
        fs::last_write_time(path, fs::last_write_time(path) - std::chrono::hours(25));
    const IcdFolder another(icd);
    EXPECT_FALSE(fs::exists(left));
    EXPECT_TRUE(fs::exists(fresh));
    EXPECT_TRUE(fs::exists(held.path())) << "its process lives";
    fs::remove(fresh);
}

TEST(probe, a_worker_sees_only_its_own_driver) {
    const DeviceList list = probe_fake("");
    ASSERT_EQ(list.devices.size(), 1U);
    EXPECT_EQ(list.devices[0].icd, "/etc/fake.icd");
    EXPECT_NE(list.devices[0].name.find("ptbench-icd-"), std::string::npos) << list.devices[0].name;
}

TEST(probe, a_driver_that_misbehaves_is_one_broken_line) {
    EXPECT_EQ(reason_of(probe_fake("sigkill")), "killed by SIGKILL (9)");
    EXPECT_EQ(reason_of(probe_fake("abort")), "killed by SIGABRT (6): assertion failed: !device->lost");
    EXPECT_EQ(reason_of(probe_fake("exit")), "exited with code 3");
    EXPECT_EQ(reason_of(probe_fake("orphan")), "exited with code 4");
    EXPECT_EQ(reason_of(probe_fake("hang", 300)), "no answer within 0.3 s");
    EXPECT_EQ(reason_of(probe_fake("garbage")), "garbled answer \"Segmentation fault (core dumped)\"");
    EXPECT_EQ(reason_of(probe_fake("error")), "CL_OUT_OF_HOST_MEMORY");
}

TEST(probe, platforms_are_numbered_across_drivers) {
    const auto devices = join_devices({from("a", {device("pocl:0", 0, 0), device("pocl:1", 0, 1)}),
                                       from("b", {}), from("c", {device("nvidia:0", 2, 0)})});
    ASSERT_EQ(devices.size(), 3U);
    EXPECT_EQ(devices[1].platform_index, 0);
    EXPECT_EQ(devices[1].device_index, 1);
    EXPECT_EQ(devices[2].platform_index, 1);
    EXPECT_TRUE(devices[2].excluded.empty() || devices[2].name == "cpu");
}

TEST(probe, a_device_found_through_two_drivers_is_used_once) {
    const auto devices =
        join_devices({from("a.icd", {device("pocl:0", 0, 0)}), from("b.icd", {device("pocl:0", 0, 0)})});
    EXPECT_EQ(devices[0].excluded, "");
    EXPECT_EQ(devices[1].excluded, "the same device as pocl:0, found again through b.icd");
}

TEST(probe, equal_devices_of_one_driver_are_two_devices) {
    const auto devices = join_devices({from("a.icd", {device("pocl:0", 0, 0), device("pocl:1", 0, 1)})});
    EXPECT_EQ(devices[1].excluded, "");
}

TEST(probe, different_uuids_are_different_devices) {
    DeviceInfo first = device("pocl:0", 0, 0), second = first;
    first.uuid = "01";
    second.uuid = "02";
    EXPECT_EQ(join_devices({from("a.icd", {first}), from("b.icd", {second})})[1].excluded, "");
}

TEST(probe, keys_are_unique_and_lead_back_to_the_drivers_own) {
    DeviceInfo other = device("pocl:0", 0, 0);
    other.platform_version = "OpenCL 3.0 PoCL 5.0";
    const auto devices = join_devices({from("a.icd", {device("pocl:0", 0, 0)}), from("b.icd", {other})});
    EXPECT_EQ(devices[1].key, "pocl@2:0");
    EXPECT_EQ(local_key("pocl@2:0"), "pocl:0");
    EXPECT_EQ(local_key("pocl:0"), "pocl:0");
}

TEST(probe, the_launcher_comes_first) {
    const IcdFolder folder({"x.icd", "libx.so"});
    const ChildCommand command =
        worker_command({"/bin/ptbench", {"srun", "-w", "node7"}}, folder, "5f", {"--probe"});
    EXPECT_EQ(command.argv, (std::vector<std::string>{"srun", "-w", "node7", "/bin/ptbench", "worker",
                                                      "--probe", "--nonce", "5f"}));
    EXPECT_EQ(command.nonce, "5f");
    EXPECT_TRUE(command.by_launcher);
}

}  // namespace
}  // namespace ptb
