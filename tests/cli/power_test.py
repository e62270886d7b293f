"""The validation's power: a kernel with a small error is rejected, before any time of it; the right one is not."""

import shutil
import unittest

from ptbench import SOURCE, CliTest, changed, TINY

VALIDATE = (*changed(TINY, path_length=128), "-d", "pocl:0", "--skip-time")

# Name, file, right text, wrong text, what the reason says.
WRONG = (
    ("albedo x 0.98", "pt/pt.cl", "vec_mul(path->throughput, surface.weight)",
     "vec_mul(path->throughput, vec_scale(surface.weight, (lanes_f)(0.98f)))", "standard errors"),
    ("1 % of paths cut", "engine/trace.h", "            turn = uint_hold(turn + 1u);\n",
     "            turn = uint_hold(turn + 1u);\n            ends |= (((unit.pixel_hash + unit.sample * 9973u) % 100u == 0u) & (turn + launch.path_length -"
     " path.last_turn > (unit.pixel_hash * 7919u + unit.sample * 104729u) % launch.path_length));", "segments a sample"),
    ("pixel grid shifted by one", "engine/unit.h", "(pixel - row * launch->width)",
     "(pixel - row * launch->width + 1u)", "block at column"),
    ("red and blue swapped", "engine/unit.h", "LANE(unit->sum.x, lane), LANE(unit->sum.y, lane), LANE(unit->sum.z, lane)",
     "LANE(unit->sum.z, lane), LANE(unit->sum.y, lane), LANE(unit->sum.x, lane)", "standard errors"),
    ("a sample too many counted", "engine/unit.h", "tally.samples = LANE(unit->counts, lane) % ENGINE_FULL_LENGTH",
     "tally.samples = (LANE(unit->counts, lane) % ENGINE_FULL_LENGTH) + (LANE(unit->number, lane) == 77u ? 1u : 0u)", "samples counted"),
    ("a sample too few rendered", "engine/unit.h",
     "end = LANES_GATHER(uint, starts + 1, run, );",
     "end = LANES_GATHER(uint, starts + 1, run, ) - 1u;",
     "samples counted"),
    ("NaN in one pixel", "engine/film.h", "const float radiance[3] = {tally.radiance.x,",
     "const float radiance[3] = {launch->first_pixel + pixel == 4321u ? NAN : tally.radiance.x,", "nan at column 97, row 33"),
    ("random numbers shared by two neighbours", "engine/unit.h", "random_of_pixel(pixel,",
     "random_of_pixel(pixel / 2u,", "random numbers"),
    ("random numbers shared by two rows", "engine/unit.h", "random_of_pixel(pixel,",
     "random_of_pixel(pixel - row % 2u * launch->width,", "random numbers"),
)


class Power(CliTest):
    def validated(self, kernels, code):
        record = self.only_case(*VALIDATE, "--kernel-dir", kernels, code=code)
        self.assertIsNone(record["statistics"])
        self.assertTrue(record["build"]["overridden"])
        return record

    def kernels(self, file="", right="", wrong=""):
        folder = self.scratch.work / "kernels"
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(SOURCE / "kernels", folder)
        if file:
            text = (folder / file).read_text()
            self.assertEqual(text.count(right), 1, f"{file} has no such line any more: {right}")
            (folder / file).write_text(text.replace(right, wrong))
        return folder

    def test_the_right_kernel_is_accepted(self):
        record = self.validated(self.kernels(), 0)
        self.assertEqual((record["status"], record["reason"]), ("ok", ""))

    def test_wrong_kernels_are_rejected(self):
        for name, file, right, wrong, reason in WRONG:
            with self.subTest(name):
                record = self.validated(self.kernels(file, right, wrong), 4)
                self.assertEqual(record["status"], "invalid")
                self.assertIn(reason, record["reason"])


if __name__ == "__main__":
    unittest.main()
