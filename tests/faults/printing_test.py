"""What drivers print while they build is kept beside the log of the build, and reaches no terminal."""

import unittest

from faulty import FaultTest
from ptbench import ONE, ended

PICTURE = ("render", "-d", "pocl:1", "--size", "8", "--spp", "1", "--path-length", "2", "-o", "x.pfm")
SAYS = ("say", "say to=stdout", "say call=clEnqueueNDRangeKernel at=1")  # PoCL compiles at a first launch
WORDS = "1_warning_generated."


class Printing(FaultTest):
    def test_a_picture_is_made_without_a_word_of_the_driver(self):
        for fault in SAYS:
            with self.subTest(fault):
                result = self.layered(fault, *PICTURE)
                self.assertEqual(result.stdout, "")
                self.assertRegex(result.stderr, r"^written: x.pfm \(1 SPP in [\d.e-]+ s\)\n$")

    def test_verbose_shows_it(self):
        for fault in SAYS:
            with self.subTest(fault):
                result = self.layered(fault, *PICTURE, "-v")
                self.assertEqual(result.stdout, "")
                self.assertIn(f"printed by the driver:\n{WORDS}\n", result.stderr)

    def test_a_record_holds_it_and_the_run_does_not_print_it(self):
        for fault in SAYS:
            with self.subTest(fault):
                result = self.layered(fault, *ONE, "--out", "out")
                self.assertNotIn(WORDS, result.stdout + result.stderr)
                (record,) = self.scratch.result()["cases"]
                self.assertEqual(ended(record), "ok")
                self.assertIn(f"printed by the driver:\n{WORDS}", record["build"]["log"])

    def test_a_silent_driver_has_nothing_printed(self):
        self.assertNotIn("printed", self.record("", *ONE)["build"]["log"])


class FailedPictures(FaultTest):
    def test_what_went_wrong_is_said_in_a_line(self):
        for fault, says in (
                ("say;crash how=segv", "killed by SIGSEGV (11): fault layer: segv in clEnqueueNDRangeKernel"),
                ("say;fail call=clBuildProgram code=-6", "CL_OUT_OF_HOST_MEMORY (-6)"),
                ("say;fail call=clBuildProgram code=-11", "the kernel does not compile on"),
                ("crash call=clCreateContext", "the worker of pocl:1 fails to start: killed by SIGABRT")):
            with self.subTest(fault):
                (line,) = self.layered(fault, *PICTURE, code=1).stderr.splitlines()
                self.assertTrue(line.startswith("error: "), line)
                self.assertIn(says, line)
                self.assertEqual(self.scratch.files(), [])


if __name__ == "__main__":
    unittest.main()
