"""Kills after so many cases; scripts/experiments/kill_test.py does many at random ones."""

import os
import sys
import unittest
from unittest import mock

from ptbench import BINARY, SOURCE, Scratch

sys.path.insert(0, str(SOURCE / "scripts/experiments"))
import kill_test  # noqa: E402


class Kills(unittest.TestCase):
    def setUp(self):
        scratch = Scratch()
        self.addCleanup(scratch.remove)
        environment = mock.patch.dict(os.environ, OCL_ICD_VENDORS=str(scratch.icds), OCL_ICD_FILENAMES="")
        environment.start()
        self.addCleanup(environment.stop)

    def test_a_kill_costs_the_case_in_progress(self):
        _, planned = kill_test.reference(BINARY)
        for victim, after in (("coordinator", 1), ("worker", 3), ("worker", 10), ("coordinator", 12)):
            with self.subTest(victim, after=after):
                outcome = kill_test.one_kill(BINARY, victim, (after, 0), planned)
                self.assertIsNotNone(outcome, "nothing was killed; nothing is tested")
                self.assertGreaterEqual(outcome[0], after)


if __name__ == "__main__":
    unittest.main()
