"""`ptbench render`: pictures by extension, the same bits for every work-group, what a time gives and interruption keeps."""

import re
import signal
import unittest

from formats import pfm_pixels, png_size
from ptbench import SOURCE, CliTest

SMALL = ("render", "-d", "pocl:1", "--size", "12x8", "--spp", "4", "--path-length", "5")


class Render(CliTest):
    def picture(self, *words, name="x.pfm"):
        self.run_ok(*words, "-o", name, "-q")
        return (self.scratch.work / name).read_bytes()

    def test_each_extension_is_its_format(self):
        self.assertEqual(png_size(self.picture(*SMALL, name="x.png")), (12, 8))
        self.assertTrue(self.picture(*SMALL, name="x.ppm").startswith(b"P3\n12 8\n255\n"))
        self.assertEqual(self.picture(*SMALL, name="x.exr")[:4], b"\x76\x2f\x31\x01")
        size, pixels = pfm_pixels(self.picture(*SMALL))
        self.assertEqual(size, (12, 8))
        self.assertTrue(all(value >= 0 for value in pixels) and max(pixels) > 0)

    def test_what_was_written_is_said(self):
        self.assertRegex(self.run_ok(*SMALL, "-o", "x.PNG").stderr, r"^written: x.PNG \(4 SPP in [\d.e-]+ s\)\n$")
        self.assertEqual(self.scratch.files(), ["x.PNG"])

    def test_refusals_come_before_the_work(self):
        for words, says in [
            ((), "-o FILE is missing"),
            (("-o", "x.gif"), '"x.gif"'),
            (("-o", "missing/x.png"), "missing/x.png"),
            (("-o", "/proc/x.png"), "/proc/x.png"),
            (("-o", "x.png", "--spp", "0"), "spp"),
            (("-o", "x.png", "--spp", "1,2"), "spp"),
            (("-o", "x.png", "-a", "rng=[hash,park_miller]"), "one picture"),
            (("-o", "x.png", "-a", "rng=haash"), "auto, hash, park_miller"),
            (("-o", "x.png", "--kernel", "thesis", "-a", "pixel_filter=centre"), "thesis has jitter"),
            (("-o", "x.png", "--kernel", "ptt"), "did you mean pt?"),
            (("-o", "x.png", "--scene", "thesi"), "did you mean thesis?"),
            (("-o", "x.png", "--seed", "-1"), "--seed"),
            (("-o", "x.png", "--wg", "8x8"), "one-dimensional"),
            (("-o", "x.png", "--size", "40000"), "MiB of device memory"),
            (("-o", "x.png", "--time", "0"), "more than 0"),
            (("-o", "x.png", "--time", "1", "--spp", "4"), "--time: found beside --spp"),
            (("-o", "x.png", "--time", "1", "-a", "(spp,size)=[(4,8)]"), "--time: found beside --spp"),
            (("-o", "x.png", "--time", "1", "-a", "pixel_filter=stratified"), "--time: found beside pixel_filter"),
            (("-o", "x.png", "--time", "1", "--wg", "8x8"), "one-dimensional"),
            (("-o", "x.png", "--aov", "depth"), "--aov"),
            (("-o", "x.png", "--aov", "cost"), "aov cost: scene thesis has no meshes"),
            (("-o", "x.png", "--aov", "cost", "--scene", "knot", "--kernel", "rays"), "aov cost: rays shows where rays end"),
            (("-o", "x.png", "--time", "1", "--scene", "knot", "--kernel", "rays"), "--time: found beside kernel rays"),
            (("-o", "x.png", "--aov", "cost", "--scene", "knot", "--kernel", "thesis"), "thesis sees spheres alone"),
            (("-o", "x.png", "--aov", "cost", "--kernel", "gbdpt"), "aov cost: scene thesis has no meshes"),
            (("-o", "x.png", "--aov", "dx"), "aov dx: pt has no gradients"),
            (("-o", "x.png", "--aov", "primal", "--kernel", "bdpt"), "aov primal: bdpt has no gradients"),
            (("-o", "x.png", "-a", "reconstruction=l1"), "reconstruction l1: pt has no gradients"),
            (("-o", "x.png", "-a", "reconstruction=l3", "--kernel", "gbdpt"), "weighted, l2, l1, none"),
            (("-o", "x.png", "--kernel", "gbdpt", "--scene", "cornell"), "gbdpt sees spheres alone"),
        ]:
            with self.subTest(words):
                self.assert_refused("render", *words, says=says)

    def test_differences_have_signs_where_a_file_keeps_them(self):
        words = ("render", "-d", "pocl:1", "--size", "12x8", "--spp", "4", "--path-length", "3", "--kernel", "gbdpt", "-a", "lanes=1")
        _, primal = pfm_pixels(self.picture(*words, "--aov", "primal"))
        self.assertTrue(all(value >= 0 for value in primal) and max(primal) > 0)
        for aov in ("dx", "dy"):
            _, signed = pfm_pixels(self.picture(*words, "--aov", aov))
            self.assertLess(min(signed), 0)
            self.assertGreater(max(signed), 0)
            shown = [int(value) for value in self.picture(*words, "--aov", aov, name="x.ppm").split()[4:]]
            rows = [signed[i : i + 36] for i in range(0, len(signed), 36)]
            downwards = [value for row in reversed(rows) for value in row]  # a .pfm begins below
            darker = [value for value, difference in zip(shown, downwards) if difference < -1e-3]
            self.assertTrue(darker and min(darker) > 0, darker)

    def test_the_cost_of_samples_is_nodes_triangles_and_rays_or_a_heat_map(self):
        words = ("render", "-d", "pocl:0", "--scene", "cornell", "--size", "12x8", "--spp", "3", "--path-length", "4", "--aov", "cost")
        _, pixels = pfm_pixels(self.picture(*words))
        rays = pixels[2::3]
        self.assertTrue(all(1 <= each <= 4 for each in rays), rays)
        for nodes, each in zip(pixels[0::3], rays):
            self.assertGreaterEqual(nodes, each * 0.99)
        said = self.run_ok(*words, "-o", "x.png").stderr
        self.assertRegex(said, r"^written: x.png \(3 SPP in [\d.e-]+ s; nodes of a sample: [0-9.]+ to [0-9.]+, mean [0-9.]+; white: [0-9]+\)$")

    def test_the_image_does_not_depend_on_the_work_group(self):
        for device in ("pocl:0", "pocl:1"):
            for kernel, groups in (("pt", ("7", "64")), ("thesis", ("5", "4x4"))):
                words = (*SMALL[:2], device, *SMALL[3:], "--kernel", kernel)
                implicit = self.picture(*words)
                for group in groups:
                    with self.subTest(device=device, kernel=kernel, group=group):
                        self.assertEqual(self.picture(*words, "--wg", group), implicit)

    def test_axes_choose_what_has_no_flag_of_its_own(self):
        first = self.picture(*SMALL)
        self.assertNotEqual(self.picture(*SMALL, "-a", "rng=park_miller"), first)
        self.assertEqual(self.picture(*SMALL, "-a", "queue=out_of_order", "-a", "film_memory=image"), first)

    def test_the_seed_matters_and_repeats(self):
        first = self.picture(*SMALL)
        self.assertEqual(self.picture(*SMALL, "--seed", "1"), first)
        self.assertNotEqual(self.picture(*SMALL, "--seed", "2"), first)

    def test_a_scene_file_is_the_shipped_scene_of_that_text(self):
        self.scratch.write("mine.json", (SOURCE / "configs/scenes/free_light.json").read_text())
        self.assertEqual(self.picture(*SMALL, "--scene", "mine.json"), self.picture(*SMALL, "--scene", "free_light"))

    def test_a_time_gives_whole_samples_which_are_those_of_as_many_spp(self):
        for kernel in ("pt", "thesis"):
            with self.subTest(kernel):
                words = ("render", "-d", "pocl:1", "--size", "24x16", "--path-length", "5", "--kernel", kernel)
                said = self.run_ok(*words, "--time", "0.5", "-o", "time.pfm").stderr
                spp, _ = re.fullmatch(r"written: time.pfm \((\d+) SPP in (\d+\.\d+|\d+) s\)\n", said).groups()
                _, timed = pfm_pixels((self.scratch.work / "time.pfm").read_bytes())
                _, counted = pfm_pixels(self.picture(*words, "--spp", spp))
                for one, other in zip(timed, counted, strict=True):
                    self.assertAlmostEqual(one, other, delta=1e-3 * max(other, 0.01))  # sums in another order

    def test_a_time_can_be_cut_short(self):
        process, terminal = self.start_in_terminal("render", "-d", "pocl:1", "--size", "32", "--time", "600", "-o", "part.pfm")
        terminal.wait_for(r"\d %")
        process.send_signal(signal.SIGINT)
        self.assertEqual(terminal.end_of(process), 130, terminal.text)
        self.assertRegex(terminal.text, r"\033\[Kwritten: part.pfm \([\d.e+]+ SPP in [\d.]+ s; interrupted: as far as it got\)\n$")

    def test_interruption_keeps_what_is_rendered(self):
        words = ("render", "-d", "pocl:1", "--size", "32", "--path-length", "5")
        _, whole = pfm_pixels(self.picture(*words, "--spp", "2000"))
        process, terminal = self.start_in_terminal(*words, "--spp", "500000", "-o", "part.pfm")
        terminal.wait_for(r"[1-9]\d* %")
        process.send_signal(signal.SIGINT)
        self.assertEqual(terminal.end_of(process), 130, terminal.text)
        self.assertRegex(terminal.text, r"\033\[Kwritten: part.pfm \([\d.e+]+ SPP in [\d.]+ s; interrupted: as far as it got\)\n$")
        size, part = pfm_pixels((self.scratch.work / "part.pfm").read_bytes())
        self.assertEqual(size, (32, 32))
        self.assertAlmostEqual(sum(part) / sum(whole), 1, delta=0.1)  # 5 million samples: far within 10 %
        self.assertEqual(self.scratch.files(), ["part.pfm", "x.pfm"])


if __name__ == "__main__":
    unittest.main()
