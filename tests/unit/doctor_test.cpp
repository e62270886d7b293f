#include <fstream>
#include <limits>

#include <gmock/gmock.h>

#include "bench/doctor/diagnosis.h"
#include "core/input/json.h"

namespace ptb {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using Weight = Remark::Weight;

/// A folder with the files of a made-up machine.
class Machine {
  public:
    Machine() { fs::remove_all(root); }
    ~Machine() { fs::remove_all(root); }
    Machine& file(const std::string& name, const std::string& text) {
        fs::create_directories((root / name).parent_path());
        std::ofstream(root / name) << text;
        return *this;
    }
    Surroundings look() const { return look_around(root); }
    int running() const { return running_now(root); }

  private:
    fs::path root =
        fs::path(testing::TempDir()) /
        (std::string("ptbench-doctor-") + testing::UnitTest::GetInstance()->current_test_info()->name());
};

void expect(const Remark& remark, Weight weight, const std::string& seen, const std::string& advice = "") {
    EXPECT_EQ(remark.weight, weight) << remark.seen;
    EXPECT_THAT(remark.seen, HasSubstr(seen));
    EXPECT_THAT(remark.advice, HasSubstr(advice));
    EXPECT_EQ(remark.advice.empty(), weight == Weight::fine) << "what is not fine has advice";
}

TEST(doctor, a_machine_without_files_is_no_error) {
    const Surroundings nothing = Machine().look();
    EXPECT_EQ(nothing.cpus_online, 0);
    EXPECT_FALSE(nothing.quota);
    EXPECT_EQ(host_remarks(nothing, 0).size(), 5u);
}

TEST(doctor, cpus_are_counted_in_lists_and_ranges) {
    EXPECT_EQ(count_cpus("0-3,8"), 5);
    EXPECT_EQ(count_cpus("7"), 1);
    EXPECT_EQ(count_cpus(""), 0);
}

TEST(doctor, a_busy_machine_is_warned_of_and_one_that_was_busy_is_not) {
    Machine machine;
    machine.file("proc/loadavg", "9.30 0.93 0.33 4/144 8799\n")
        .file("proc/stat", "cpu  1 1 1\nprocs_running 4\n");
    EXPECT_EQ(machine.running(), 3) << "this thread runs, too";
    machine.file("proc/stat", "cpu  1 1 1\nprocs_running 1\n");
    EXPECT_EQ(machine.running(), 0) << "whatever the load of the last minute was";
    EXPECT_EQ(Machine().running(), 0);
    expect(load_remark(1, 2), Weight::warning, "run now: 1, on 2 CPUs", "taskset");
    expect(load_remark(1, 4), Weight::fine, "run now: 1, on 4 CPUs");
    expect(load_remark(0, 1), Weight::fine, "run now: 0");
}

TEST(doctor, load_is_that_of_the_whole_machine) {
    Machine machine;
    machine.file("sys/devices/system/cpu/online", "0-63\n")
        .file("proc/self/status", "Cpus_allowed_list:\t4,6\n");
    expect(host_remarks(machine.look(), 3)[0], Weight::fine, "3, on 64 CPUs");
}

TEST(doctor, containers_and_laptops_are_told_by_what_they_leave) {
    EXPECT_TRUE(Machine().file(".dockerenv", "").look().container);
    EXPECT_TRUE(Machine().file("proc/self/cgroup", "0::/kubepods/besteffort/pod1\n").look().container);
    EXPECT_FALSE(Machine().file("proc/self/cgroup", "0::/user.slice\n").look().container);
    const std::string supply = "sys/class/power_supply/";
    EXPECT_TRUE(Machine().file(supply + "BAT0/type", "Battery\n").look().battery);
    EXPECT_FALSE(Machine().file(supply + "AC/type", "Mains\n").look().battery);
    EXPECT_FALSE(Machine()
                     .file(supply + "mouse/type", "Battery\n")
                     .file(supply + "mouse/scope", "Device\n")
                     .look()
                     .battery)
        << "a mouse has one, too";
}

TEST(doctor, the_cpus_that_can_be_used_are_those_allowed_or_the_quota) {
    EXPECT_EQ(usable_cpus({}), std::numeric_limits<double>::infinity());
    Surroundings host;
    host.cpus_allowed = 4;
    EXPECT_EQ(usable_cpus(host), 4);
    host.quota = CpuQuota{1.5, "cpu.max"};
    EXPECT_EQ(usable_cpus(host), 1.5);
}

TEST(doctor, stolen_time_is_warned_of) {
    const auto host = Machine().file("proc/stat", "cpu  900 0 50 0 0 0 0 50 0 0\ncpu0 1 1 1 1\n").look();
    expect(steal_remark({}, host.ticks), Weight::warning, "5.0 % of the CPUs' time since boot", "ab");
    expect(steal_remark(host.ticks, {3000, 52}), Weight::fine, "0.1 % of the CPUs' time during the A/A runs");
}

TEST(doctor, the_governor_should_be_performance_on_every_cpu) {
    const std::string cpu = "sys/devices/system/cpu/cpu", governor = "/cpufreq/scaling_governor";
    Machine machine;
    machine.file(cpu + "0" + governor, "performance\n");
    expect(governor_remark(machine.look()), Weight::fine, "performance (1 CPUs)");
    machine.file(cpu + "1" + governor, "powersave\n");
    expect(governor_remark(machine.look()), Weight::warning, "powersave (1 CPUs)",
           "cpupower frequency-set -g performance");
    expect(governor_remark(Machine().look()), Weight::note, "no control");
}

TEST(doctor, boost_clocks_are_noted_whichever_switch_there_is) {
    Machine machine;
    machine.file("sys/devices/system/cpu/intel_pstate/no_turbo", "0\n");
    expect(boost_remark(machine.look()), Weight::note, "on", "no_turbo");
    machine.file("sys/devices/system/cpu/cpufreq/boost", "0\n");
    expect(boost_remark(machine.look()), Weight::fine, "off");
}

TEST(doctor, a_hypervisor_is_a_flag_of_the_cpu_or_a_folder) {
    expect(
        virtualisation_remark(Machine().file("proc/cpuinfo", "flags\t\t: fpu hypervisor lahf_lm\n").look()),
        Weight::note, "virtual machine", "ptbench ab");
    EXPECT_TRUE(Machine().file("sys/hypervisor/type", "xen\n").look().virtual_machine);
    expect(virtualisation_remark(Machine().file("proc/cpuinfo", "flags\t\t: fpu hypervisors\n").look()),
           Weight::fine, "no");
}

TEST(doctor, a_quota_is_found_in_both_versions_of_control_groups_and_above_the_own_one) {
    Machine v2;
    v2.file("sys/devices/system/cpu/online", "0-3\n")
        .file("proc/self/cgroup", "0::/user.slice/job.scope\n")
        .file("sys/fs/cgroup/user.slice/job.scope/cpu.max", "max 100000\n");
    EXPECT_FALSE(v2.look().quota);
    v2.file("sys/fs/cgroup/user.slice/cpu.max", "150000 100000\n");
    expect(cpu_limit_remark(v2.look()), Weight::warning, "a quota of 1.5 CPUs of 4", "cpuset-cpus");

    Machine v1;
    v1.file("sys/devices/system/cpu/online", "0-3\n")
        .file("proc/self/cgroup", "5:cpu,cpuacct:/docker/9f86\n")
        .file("sys/fs/cgroup/cpu,cpuacct/cpu.cfs_quota_us", "-1\n")
        .file("sys/fs/cgroup/cpu,cpuacct/cpu.cfs_period_us", "100000\n");
    EXPECT_FALSE(v1.look().quota);
    v1.file("sys/fs/cgroup/cpu,cpuacct/cpu.cfs_quota_us",
            "200000\n");  // a container sees its own group on top
    EXPECT_EQ(v1.look().quota->cpus, 2);
}

TEST(doctor, fewer_cpus_than_there_are_is_noted) {
    Machine machine;
    machine.file("sys/devices/system/cpu/online", "0-63\n")
        .file("proc/self/status", "Cpus_allowed_list:\t4,6\n");
    expect(cpu_limit_remark(machine.look()), Weight::note, "2 of 64 CPUs", "taskset");
    machine.file("proc/self/status", "Cpus_allowed_list:\t0-63\n");
    expect(cpu_limit_remark(machine.look()), Weight::fine, "64 of 64");
}

DeviceInfo device(const std::string& excluded = "") {
    DeviceInfo info;
    info.key = "pocl:0";
    info.icd = "/etc/OpenCL/vendors/pocl.icd";
    info.timer_resolution_ns = 1;
    info.excluded = excluded;
    return info;
}

TEST(doctor, drivers_that_break_or_come_twice_are_named) {
    expect(driver_remarks({{device()}, {}})[0], Weight::fine, "every driver answers");
    const auto remarks =
        driver_remarks({{device(), device("the same device as pocl:0")}, {{"old.icd", "hangs"}}});
    ASSERT_EQ(remarks.size(), 2u);
    expect(remarks[0], Weight::note, "old.icd cannot be used: hangs", "dpkg -S old.icd");
    expect(remarks[1], Weight::note, "the same device as pocl:0", "dpkg -S /etc/OpenCL/vendors/pocl.icd");
}

/// Ten blocks of one time on both sides; then `now_ns` in the new one's.
SelfComparison compared(std::int64_t base_ns, std::int64_t now_ns, int blocks = screen_blocks) {
    SelfComparison aa{device(), {}, {}, ""};
    const Round base{{base_ns}, {base_ns}}, now{{now_ns}, {now_ns}};
    aa.gate.timer = "event";
    aa.gate.screen.assign(static_cast<std::size_t>(blocks), {{base, now, now, base}});
    aa.gate.confirm.assign(confirm_blocks, {{base, now, now, base}});
    aa.finding = decide({&aa.gate, 1}).front();
    return aa;
}

TEST(doctor, what_event_times_advance_by_is_held_against_what_the_driver_claims) {
    expect(timer_remark(compared(1'000'003, 1'000'000)), Weight::fine, "advance by 1 ns");
    expect(timer_remark(compared(3'072'000, 3'073'024)), Weight::note,
           "claims a resolution of 1 ns, its times advance by 1024 ns");
    expect(timer_remark(compared(3'000'000, 2'000'000)), Weight::warning, "advance by 1000000 ns", "--spp");
    SelfComparison only_looked{device(), {}, {}, ""};
    expect(timer_remark(only_looked), Weight::fine, "claims a resolution of 1 ns");
    only_looked.device.profiling = false;
    expect(timer_remark(only_looked), Weight::warning, "no profiling", "host's clock");
}

TEST(doctor, event_times_that_are_not_believed_are_warned_of) {
    SelfComparison aa = compared(1'000'000, 1'000'000);
    aa.gate.timer = "host";
    expect(timer_remark(aa), Weight::note, "disagree", "top");
    aa.timer_reason = "START = END = 0";
    expect(timer_remark(aa), Weight::warning, "START = END = 0", "newer driver");
}

TEST(doctor, equal_sides_that_differ_are_warned_of) {
    expect(self_remark(compared(1'000'000, 1'000'000)), Weight::fine, "differ by 0.0 %");
    expect(self_remark(compared(1'000'000, 1'100'000)), Weight::warning, "differ by 10.0 %", "do not gate");
    SelfComparison failed{device(), {}, {}, ""};
    failed.gate.not_measured = "base: killed by SIGSEGV (11)";
    expect(self_remark(failed), Weight::warning, "SIGSEGV", "ptbench run -d pocl:0");
}

TEST(doctor, the_smallest_change_follows_the_noise) {
    SelfComparison aa = compared(1'000'000, 1'000'000);
    expect(sight_remark(aa), Weight::fine, "5.0 %, 2.0 % with --profile dedicated; quiet enough");
    aa.finding.evidence.standard_error = 0.01;
    expect(sight_remark(aa), Weight::fine, "5.9 %, 5.0 % with --profile dedicated");
    aa.finding.evidence.standard_error = 0.03;
    expect(sight_remark(aa), Weight::warning, "15.0 %", "--require-mde");
}

TEST(doctor, an_interrupted_comparison_says_nothing_of_the_noise) {
    Diagnosis diagnosis;
    diagnosis.devices = {compared(1'000'000, 1'000'000, 1)};
    diagnosis.devices[0].gate.confirm.clear();
    diagnosis.devices[0].finding = decide({&diagnosis.devices[0].gate, 1}).front();
    add_device_remarks(diagnosis);
    ASSERT_EQ(diagnosis.remarks.size(), 1u);
    EXPECT_EQ(diagnosis.remarks[0].about, "timer");
    EXPECT_EQ(parse_json(diagnosis_json(diagnosis), "doctor")["aa"].size(), 0u);
}

TEST(doctor, warnings_come_first_and_json_has_every_remark) {
    Diagnosis diagnosis;
    diagnosis.list.devices = {device()};
    diagnosis.devices = {compared(1'000'000, 1'000'000)};
    diagnosis.remarks = {load_remark(0, 2), load_remark(9, 2)};
    add_device_remarks(diagnosis);
    EXPECT_TRUE(diagnosis_text(diagnosis).starts_with(
        "warning  load: threads of other programs that run now: 9, on 2 CPUs\n         -> "));
    const Json json = parse_json(diagnosis_json(diagnosis), "doctor");
    EXPECT_EQ(json["remarks"].size(), 6u);
    EXPECT_EQ(json["aa"][0]["tick_ns"], 1'000'000);
}

}  // namespace
}  // namespace ptb
