"""One picture by two devices, of which one fails: the picture is that of one alone."""

import json
import unittest

from faulty import FaultTest
from ptbench import TINY

WORK = ("render", "--size", "48x32", "--spp", "40", "--path-length", "6")


class Together(FaultTest):
    def setUp(self):
        super().setUp()
        self.run_ok(*WORK, "-d", "0", "-o", "alone.pfm", "-q")

    def bytes_of(self, name):
        return (self.scratch.work / name).read_bytes()

    def made_by(self, device):
        ranges = json.loads((self.scratch.work / "x.pfm.ranges.json").read_text())
        (parts,) = [each["parts"] for each in ranges["devices"] if each["device"] == device]
        return parts

    def test_a_driver_that_crashes_once_costs_what_its_worker_made(self):
        for fault in ("crash call=clFinish how=segv from=8", "crash call=clEnqueueReadBuffer how=kill from=1",
                      "lose call=clFinish code=-5 from=8", "fail call=clEnqueueNDRangeKernel code=-5 from=8"):
            with self.subTest(fault):
                hit = self.scratch.work / "hit"
                hit.unlink(missing_ok=True)
                said = self.layered(f"{fault} once={hit}", *WORK, "-d", "0,1", "-o", "x.pfm").stderr
                self.assertTrue(hit.exists(), "nothing failed; nothing is tested")
                self.assertIn("what it made is made again", said)
                self.assertEqual(self.bytes_of("x.pfm"), self.bytes_of("alone.pfm"))

    def test_devices_that_always_fail_end_it_with_their_reason(self):
        said = self.layered("crash call=clEnqueueNDRangeKernel how=segv", *WORK, "-d", "0,1", "-o", "x.pfm", code=1).stderr
        self.assertIn("SIGSEGV", said)
        self.assertEqual(self.scratch.files(), ["alone.pfm"])


class AtTheSameTime(FaultTest):
    def test_who_drops_out_spoils_the_times_of_the_others(self):
        words = ("--all-devices", *TINY, "--together", "all")
        hit = self.scratch.root / "hit"
        fell, other = sorted(self.records(f"crash call=clEnqueueReadBuffer at=6 once={hit}", *words, code=None),
                             key=lambda record: record["status"])
        self.assertEqual((fell["status"], other["status"]), ("crash", "unstable"), [fell["reason"], other["reason"]])
        self.assertIn(f"together all: {fell['params']['device']} dropped out: killed by", other["reason"])
        self.assertEqual(self.scratch.processes(), [])


if __name__ == "__main__":
    unittest.main()
