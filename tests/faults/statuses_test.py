"""Each status made for real: one case suffers, its record says from what, and the cases after it are measured."""

import csv
import unittest

from faulty import BY_EIGHT, THREE, FaultTest
from ptbench import ONE, TINY, changed, ended


class NoFault(FaultTest):
    def test_the_layer_alone_changes_nothing(self):
        self.assertEqual([ended(record) for record in self.records("", *THREE)], ["ok"] * 3)

    def test_a_mistake_in_the_faults_is_no_silent_success(self):
        for fault in ("explode", "timer how", "fail when=5"):
            with self.subTest(fault):
                self.assertIn("PTB_FAULT", self.layered(fault, *ONE, code=77).stderr)


class Dying(FaultTest):
    def test_a_worker_that_dies_costs_one_case(self):
        for how, signal in (("kill", "SIGKILL (9)"), ("abort", "SIGABRT (6)"), ("segv", "SIGSEGV (11)")):
            with self.subTest(how):
                hit = self.one_of_three(f"crash how={how} {BY_EIGHT}", "crash")
                self.assertEqual(hit["reason"],
                                 f"killed by {signal}: fault layer: {how} in clEnqueueNDRangeKernel")

    def test_a_worker_that_hangs_is_killed(self):
        hit = self.one_of_three(f"hang {BY_EIGHT}", "timeout", words=changed(THREE, timeout=2))
        self.assertEqual(hit["reason"], "no sign of life for 2 s (--timeout)")

    def test_one_that_hangs_behind_a_launcher_is_ended(self):
        for script in ('"$@"', 'setsid --wait "$@"'):
            with self.subTest(script):
                words = [*changed(THREE, timeout=2), *self.scratch.launcher(script)]
                self.one_of_three(f"hang {BY_EIGHT}", "timeout", words=words)
                self.assertEqual(self.scratch.processes(), [])

    def test_one_that_hangs_while_costs_are_estimated_or_devices_asked_for(self):
        once = self.scratch.root / "once"
        statuses = [ended(r) for r in self.records(f"hang at=1 once={once}", *changed(THREE, timeout=2))]
        self.assertEqual(statuses, ["ok"] * 3)
        result = self.layered("hang call=clGetDeviceIDs", *ONE, code=77)
        self.assertRegex(result.stderr, r"pocl\.icd: no answer within \d+ s")

    def test_wherever_a_worker_dies_the_run_goes_on(self):
        for call in ("clSetKernelArg", "clCreateBuffer", "clFinish", "clEnqueueReadBuffer",
                     "clGetEventProfilingInfo"):
            with self.subTest(call):
                hit = self.one_of_three(f"crash call={call} {BY_EIGHT}", "crash")
                self.assertIn(call, hit["reason"])

    def test_a_driver_that_dies_when_asked_for_devices_is_named(self):
        result = self.layered("crash call=clGetDeviceIDs how=segv", *ONE, code=77)
        self.assertRegex(result.stderr, r"pocl\.icd: killed by SIGSEGV \(11\): fault layer")

    def test_a_worker_that_never_opens_leaves_a_reason(self):
        for fault, status, reason in (
                ("crash call=clCreateContext", "skipped", "the worker of pocl:1 fails to start: killed by SIGABRT"),
                ("fail call=clCreateContext code=-6", "skipped", "pocl:1 cannot be opened: .*CL_OUT_OF_HOST_MEMORY")):
            with self.subTest(fault):
                for record in self.records(fault, *THREE, code=None):
                    self.assertEqual(record["status"], status)
                    self.assertRegex(record["reason"], reason)


class Refusing(FaultTest):
    def test_a_failing_call_is_named_with_its_error(self):
        for code, name in ((-4, "CL_MEM_OBJECT_ALLOCATION_FAILURE"), (-9999, "unknown error")):
            with self.subTest(code):
                hit = self.one_of_three(f"fail code={code} {BY_EIGHT}", "runtime")
                self.assertRegex(hit["reason"], rf"^clEnqueueNDRangeKernel\(pt_render, .*local 8\) on "
                                                rf"\".+\": {name} \({code}\)")

    def test_any_call_may_fail(self):
        for call in ("clCreateProgramWithSource", "clBuildProgram", "clCreateKernel", "clCreateBuffer",
                     "clSetKernelArg", "clEnqueueFillBuffer", "clFinish", "clEnqueueReadBuffer",
                     "clGetKernelWorkGroupInfo", "clGetEventProfilingInfo"):
            with self.subTest(call):
                record = self.record(f"fail call={call} code=-6", *ONE, code=1)
                self.assertEqual(record["status"], "runtime")
                self.assertRegex(record["reason"], rf"{call}.*CL_OUT_OF_HOST_MEMORY \(-6\)")

    def test_a_work_group_that_the_driver_refuses_is_unsupported(self):
        for code, name in ((-54, "CL_INVALID_WORK_GROUP_SIZE"), (-5, "CL_OUT_OF_RESOURCES")):
            with self.subTest(code):
                hit = self.one_of_three(f"fail code={code} {BY_EIGHT}", "unsupported", code=0)
                self.assertRegex(hit["reason"], rf"work_group 8: this kernel allows \d+ work-items here \({name}\)")

    def test_a_build_that_fails_is_a_compile_error_even_without_a_log(self):
        record = self.record("fail call=clBuildProgram code=-11", *ONE, code=1)
        self.assertEqual(record["status"], "compile")
        self.assertIn("does not compile", record["reason"])
        self.assertFalse(record["build"]["overridden"])
        self.assertRegex(record["build"]["kernel_hash"], "^[0-9a-f]{16}$")


class Lost(FaultTest):
    def test_a_lost_device_costs_one_case_if_a_new_worker_finds_it_again(self):
        for code, name in ((-2, "CL_DEVICE_NOT_AVAILABLE"), (-5, "CL_OUT_OF_RESOURCES")):
            with self.subTest(code):
                hit = self.one_of_three(f"lose code={code} {BY_EIGHT}", "runtime")
                self.assertIn(f"{name} ({code})", hit["reason"])

    def test_one_that_stays_lost_leaves_its_other_cases_untried(self):
        lost = self.scratch.root / "lost"
        fault = f"lose code=-2 {BY_EIGHT} once={lost}; fail call=clCreateContext code=-2 given={lost}"
        before, hit, after = self.records(fault, *THREE, code=1)
        self.assertEqual([ended(before), hit["status"], after["status"]], ["ok", "runtime", "skipped"])
        self.assertRegex(after["reason"], "pocl:1 cannot be opened: clCreateContext.*CL_DEVICE_NOT_AVAILABLE")

    def test_the_cases_of_other_devices_do_not_suffer(self):
        words = changed(TINY, wg="4,8,16") + ["-d", "pocl:1", "-d", "pocl:0"]
        records = self.records(f"lose code=-2 {BY_EIGHT} once={self.scratch.root / 'lost'}", *words, code=1)
        self.assertEqual([(r["params"]["device"], ended(r)) for r in records],
                         [("pocl:0", "ok"), ("pocl:0", "runtime"), ("pocl:0", "ok"), *[("pocl:1", "ok")] * 3])

    def test_lost_while_costs_are_estimated(self):
        once = self.scratch.root / "once"
        statuses = [ended(r) for r in self.records(f"lose code=-2 at=1 once={once}", *THREE)]
        self.assertEqual(statuses, ["ok"] * 3)


class InOneProcess(FaultTest):
    def test_a_device_that_fails_is_opened_anew(self):
        words = [*THREE, "--no-isolate"]
        self.one_of_three(f"fail code=-4 {BY_EIGHT}", "runtime", words=words)
        self.one_of_three(f"corrupt factor=nan {BY_EIGHT}", "invalid", code=4, words=words)


class Wrong(FaultTest):
    def assert_no_time(self, record):
        self.assertEqual((record["samples"], record["statistics"]), ([], None))
        self.assertEqual(record["build"]["first_launch_ns"], 0)
        if record["work"]:
            self.assertEqual(record["work"]["longest_launch_ns"], 0)

    def test_corrupted_pixels_are_never_timed(self):
        for factor in ("nan", "-1", "1.5", "0"):
            with self.subTest(factor):
                record = self.record(f"corrupt pixels=0.05 factor={factor}", *ONE, code=4)
                self.assertEqual(record["status"], "invalid")
                self.assertIn("column", record["reason"])
                self.assert_no_time(record)

    def test_no_file_has_a_time_of_a_wrong_image(self):
        hit = self.one_of_three(f"corrupt pixels=0.1 factor=nan {BY_EIGHT}", "invalid", code=4)
        self.assertRegex(hit["reason"], r"timed image: .*nan")
        self.assert_no_time(hit)
        with open(self.scratch.work / "out/result.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        times = [name for name in rows[0] if name.endswith("_ms") and name != "build_ms"] + \
                [name for name in rows[0] if name.endswith("_per_s")]
        self.assertIn("time_ms", times)
        for row in rows:
            (self.assertFalse if row["status"] == "invalid" else self.assertTrue)(row["time_ms"])
        (row,) = [row for row in rows if row["status"] == "invalid"]
        self.assertEqual({name: row[name] for name in times}, dict.fromkeys(times, ""))

    def test_thesis_is_checked_as_well(self):
        words = changed(ONE, kernel="thesis")
        record = self.record("corrupt pixels=0.5 factor=1.5 pixel_bytes=16", *words, code=4)
        self.assertEqual(record["status"], "invalid")


class Untried(FaultTest):
    def test_what_a_slow_device_cannot_do_in_the_budget_is_skipped(self):
        words = [*changed(ONE, spp="1,500000"), "--max-total-time", "20"]
        statuses = [ended(r) for r in self.records("slow factor=50", *words)]
        self.assertEqual(statuses, ["ok", "skipped"])

    def test_work_beyond_a_limit_is_unsupported_before_any_launch(self):
        record = self.record("crash kernel=pt_render", *changed(ONE, size="40000x40000"))
        self.assertEqual(record["status"], "unsupported")


if __name__ == "__main__":
    unittest.main()
