"""A device whose event times are wrong is timed by the host's clock; record and table say so and why."""

import unittest

from faulty import FaultTest
from ptbench import ONE, changed, ended


class BrokenTimers(FaultTest):
    def assert_host_clock(self, fault, reason, words=ONE):
        output = self.layered(fault, *words, "--out", "out").stdout
        (record,) = self.scratch.result()["cases"]
        self.assertEqual(ended(record), "ok")
        self.assertEqual(record["statistics"]["timer"], "host")
        self.assertRegex(record["statistics"]["timer_reason"], reason)
        self.assertIn("timer: host", output)
        self.assertIn("timer: host", (self.scratch.work / "out/table.md").read_text())
        host = sorted(sample["host_ns"] for sample in record["samples"])
        self.assertLessEqual(host[0], record["statistics"]["median_ns"])
        self.assertLessEqual(record["statistics"]["median_ns"], host[-1])
        return record

    def test_times_that_contradict_themselves(self):
        for how, reason in (("zero", "zero"), ("swap", r"ends \d+ ns before it starts"),
                            ("underflow", r"lasts \d+ ns where the host waited \d+ ns"),
                            ("scale factor=1000", r"lasts \d+ ns where the host waited \d+ ns")):
            with self.subTest(how):
                record = self.assert_host_clock(f"timer how={how}", reason)
                self.assertEqual({sample["cause"] for sample in record["samples"]}, {"timer_fault"})

    def test_a_clock_that_is_too_slow(self):
        self.assert_host_clock("timer how=scale factor=0.5", "host", words=changed(ONE, spp=20000))

    def test_times_that_cannot_be_had(self):
        self.assert_host_clock("fail call=clGetEventProfilingInfo code=-7", "zero")

    def test_a_clock_that_is_asked_for_is_used_or_refused(self):
        for how in ("zero", "swap", "underflow"):
            with self.subTest(how):
                record = self.record(f"timer how={how}", *ONE, "--timer", "event")
                self.assertEqual((record["status"], record["samples"], record["statistics"]), ("unsupported", [], None))
                self.assertRegex(record["reason"], "--timer event: .*; auto takes the host's clock then")
        record = self.record("", *ONE, "--timer", "host")
        self.assertEqual((record["statistics"]["timer"], record["statistics"]["timer_reason"]), ("host", "asked for"))

    def test_a_slow_launch_is_no_fault_of_the_timer(self):
        record = self.record("slow factor=3 share=0.5", *changed(ONE, spp=2000, samples=5))
        self.assertEqual(record["statistics"]["timer"], "event")


if __name__ == "__main__":
    unittest.main()
