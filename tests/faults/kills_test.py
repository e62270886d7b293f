"""Three kills at set moments; scripts/experiments/kill_test.py does many at random ones."""

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
        whole_s, planned = kill_test.reference(BINARY)
        hits = [outcome for victim, share in (("coordinator", 0.6), ("worker", 0.6), ("coordinator", 0.8))
                if (outcome := kill_test.one_kill(BINARY, victim, share * whole_s, planned))]
        self.assertTrue(hits, "nothing was killed; nothing is tested")


if __name__ == "__main__":
    unittest.main()
