"""The validation's power: a kernel with a small error is rejected, before any time of it; the right one is not."""

import shutil
import unittest

from ptbench import SOURCE, TINY, CliTest, changed, ended

VALIDATE = (*changed(TINY, path_length=5), "--scene", "thesis", "-d", "pocl:0", "--skip-time")

# Name, file, right text, wrong text, what the reason says.
WRONG = (
    ("albedo x 0.98", "pt/pt.cl", "vec_mul(path->throughput, surface.weight)",
     "vec_mul(path->throughput, vec_scale(surface.weight, (lanes_f)(0.98f)))", "standard errors"),
    ("1 % of paths cut", "engine/trace.h", "            const lanes_mask full = lanes_hold(",
     "            ends |= (((unit.pixel_hash + unit.sample * 9973u) % 100u == 0u) & (turn + launch.path_length -"
     " path.last_turn > (unit.pixel_hash * 7919u + unit.sample * 104729u) % launch.path_length));\n"
     "            const lanes_mask full = lanes_hold(", "segments a sample"),
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


# Of pt_nee: name, scene, and so on. What is too small for a picture of these scenes: tests/render/light_test.cpp.
ROULETTE = ("-a", "roulette=albedo")
MET = "share_of_met(world, path, hit, alive COUNTED_ARGUMENT)"
WRONG_LIGHT = (
    ("what is met counts in full, cap", "thesis", "pt_nee/segment.h", MET, "(lanes_f)(1.0f)", "standard errors"),
    ("what is met counts in full, cone", "free_light", "pt_nee/segment.h", MET, "(lanes_f)(1.0f)", "standard errors"),
    ("density of what is asked for x 1.1", "thesis", "engine/light.h", "PI * lamp.density.part", "1.1f * PI * lamp.density.part",
     "standard errors"),
    ("the lamp's cosine left out", "thesis", "scene/lamps.h", "cosine = -vec_dot(sample.direction, outwards);",
     "cosine = (lanes_f)(1.0f);", "standard errors"),
    ("area of the cap x 1.1", "thesis", "scene/lamps.h", "LAMP_FLOAT(lamps, number, cap_density)",
     "LAMP_FLOAT(lamps, number, cap_density) / 1.1f", "standard errors"),
    ("extent of the cone x 1.1", "free_light", "scene/lamps.h", "sight.extent = squared_sine *", "sight.extent = 1.1f * squared_sine *",
     "standard errors"),
    ("chance of a lamp left out", "lamps", "scene/lamps.h", "LAMP_FLOAT(lamps, number, chance)", "(lanes_f)(1.0f)", "standard errors"),
    ("an opaque ball that throws no shadow", "thesis", "scene/hit.h", "blocked |= meets & other;", "if (i != 7u) blocked |= meets & other;",
     "standard errors"),
    ("glass that throws no shadow", "free_light", "scene/hit.h", "blocked |= ((in & leaves) | (!in & meets)) & other;",
     "(void)in, (void)meets, (void)leaves, (void)other;", "standard errors"),
)

# Of bdpt, by 32 renders of each, at path length 8: smaller faults are tests/render/both_ends_test.cpp's.
WRONG_ENDS = (
    ("light that passes glass is not scaled", "lamp_in_glass", "bdpt/vertex.h",
     "if (carries) path->throughput = vec_scale(path->throughput, squeezed);", "", "standard errors"),
    ("light that the camera sees is left out", "lamp_in_glass", "bdpt/bdpt.cl",
     "    show_all(world, picture, light, &path->inside, traced COUNTED_ARGUMENT);\n", "", "standard errors"),
    ("odds of vertices that are joined x 2", "eclipse", "bdpt/join.h", "g * (view->density * light->odds + light->density * view->odds)",
     "2.0f * g * (view->density * light->odds + light->density * view->odds)", "standard errors"),
)


class Power(CliTest):
    def validated(self, kernels, code, *words, **axes):
        record = self.only_case(*changed(VALIDATE, **axes), *words, "--kernel-dir", kernels, code=code)
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
        for path_length in (5, 128):
            with self.subTest(path_length):
                self.assert_accepted(self.validated(self.kernels(), 0, path_length=path_length))

    def test_wrong_kernels_are_rejected(self):
        for name, file, right, wrong, reason in WRONG:
            with self.subTest(name):
                self.assert_rejected(self.validated(self.kernels(file, right, wrong), 4), reason)

    def assert_rejected(self, record, reason):
        self.assertEqual(record["status"], "invalid")
        self.assertIn(reason, record["reason"])

    def assert_accepted(self, record):
        self.assertEqual(ended(record), "ok", record["reason"])

    def test_right_light_is_accepted(self):
        for scene in ("thesis", "free_light", "lamps"):
            with self.subTest(scene):
                self.assert_accepted(self.validated(self.kernels(), 0, kernel="pt_nee", scene=scene))

    def test_wrong_light_is_rejected(self):
        for name, scene, file, right, wrong, reason in WRONG_LIGHT:
            with self.subTest(name):
                self.assert_rejected(self.validated(self.kernels(file, right, wrong), 4, kernel="pt_nee", scene=scene), reason)

    def test_right_ends_are_accepted_and_wrong_ones_rejected(self):
        words = {"kernel": "bdpt", "path_length": 8}
        for scene in ("lamp_in_glass", "eclipse"):
            with self.subTest(scene):
                self.assert_accepted(self.validated(self.kernels(), 0, scene=scene, **words))
        for name, scene, file, right, wrong, reason in WRONG_ENDS:
            with self.subTest(name):
                self.assert_rejected(self.validated(self.kernels(file, right, wrong), 4, scene=scene, **words), reason)

    def test_roulette_is_judged_by_its_picture(self):
        for kernel in ("pt", "pt_nee"):
            with self.subTest(kernel):
                self.assert_accepted(self.validated(self.kernels(), 0, *ROULETTE, kernel=kernel))
        unweighted = self.kernels("engine/path.h", "over_chance((lanes_f)(1.0f), chance)", "(lanes_f)(1.0f)")
        self.assert_rejected(self.validated(unweighted, 4, *ROULETTE, kernel="pt_nee"), "standard errors")


if __name__ == "__main__":
    unittest.main()
