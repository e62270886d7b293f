"""A fleet whose cards do not all compute rightly: found by the bits of their images, where validation lets them pass."""

import unittest

from faulty import FaultTest
from ptbench import ONE, changed

SMALL = (*changed(ONE, size=64, spp=32, path_length=5), "--expect", "n[1-3]", "--fleet", "F", "-q")
# Some pixels of a film, one thousandth darker: far below the noise.
DIM = "corrupt pixels=0.01 factor=0.999"


class WrongCard(FaultTest):
    def test_a_card_that_dims_a_pixel_is_named_as_wrong(self):
        self.run_ok(*SMALL, SLURMD_NODENAME="n1")
        self.layered(DIM, *SMALL, SLURMD_NODENAME="n2")
        found = self.run_ok(*SMALL, SLURMD_NODENAME="n3", code=4).stdout
        self.assertLessEqual({case["status"] for case in self.scratch.result("F")["cases"]}, {"ok", "unstable"},
                             "each image by itself is right")
        self.assertRegex(found, r"n2/pocl:1 .* wrong image: pt thesis spp 32")
        self.assertNotIn("n1/pocl:1  ", found)
        self.assertIn("exclude: n2\n", found)
        self.run_ok("report", "F", code=4)

    def test_of_two_that_differ_nobody_says_which_is_wrong(self):
        two = changed(SMALL, expect="n[1-2]")
        self.run_ok(*two, SLURMD_NODENAME="n1")
        found = self.layered(DIM, *two, SLURMD_NODENAME="n2", code=4).stdout
        for node in ("n1", "n2"):
            self.assertRegex(found, rf"{node}/pocl:1 .* image differs: pt thesis spp 32")
        self.assertNotIn("exclude", found)


if __name__ == "__main__":
    unittest.main()
