"""What becomes of a case: every planned one ends as exactly one record, whose reason a user can act on."""

import re
import unittest

from ptbench import ONE, SOURCE, TINY, CliTest, changed, ended

PT_KERNEL = (SOURCE / "kernels/pt/pt.cl").read_text()


class Limits(CliTest):
    def unsupported(self, *words):
        record = self.only_case(*words)
        self.assertEqual(record["status"], "unsupported", record["reason"])
        self.assertEqual(record["samples"], [])
        return record["reason"]

    def test_a_size_beyond_the_memory_names_both_numbers(self):
        reason = self.unsupported(*changed(ONE, size="40000x40000"), "--max-total-time", "0")
        needed, there = map(int, re.search(r"needs (\d+) MiB of device memory.* has (\d+) MiB", reason).groups())
        self.assertGreater(needed, there)
        self.assertIn("40000x40000", reason)

    def test_a_work_group_beyond_the_limit_names_it(self):
        self.assertRegex(self.unsupported(*changed(ONE, wg=1 << 20)), r"1048576.* allows \d+")

    def test_pt_has_no_two_dimensional_work_groups(self):
        self.assertRegex(self.unsupported(*changed(ONE, wg="8x8")), "8x8.*pt.*one-dimensional")

    def test_lanes_that_a_kernel_lacks(self):
        self.assertRegex(self.unsupported(*changed(ONE, kernel="thesis"), "--lanes", "4"), "lanes 4: thesis has 1")

    def test_odd_work_groups_and_odd_sizes_work(self):
        self.run_ok(*changed(ONE, size="17x13", wg="7,64"), "--out", "pt", "-q")
        self.run_ok(*changed(ONE, kernel="thesis", size="17x13", wg="5,7x3,8x8"), "--out", "thesis", "-q")
        for folder in ("pt", "thesis"):
            for record in self.scratch.result(folder)["cases"]:
                self.assertEqual(ended(record), "ok", record["reason"])
                self.assertEqual(record["work"]["samples"], 17 * 13 * 2)
                self.assertGreater(record["statistics"]["median_ns"], 0)


class Kernels(CliTest):
    def test_shadow_rays_are_counted_beside_segments(self):
        for kernel, asks_lamps, has_others in (("pt", False, False), ("pt_nee", True, False), ("pt_lt", True, True), ("bdpt", True, True), ("gpt", True, True)):
            record = self.only_case(*changed(ONE, kernel=kernel, path_length=3))
            work, statistics = record["work"], record["statistics"]
            self.assertEqual(work["shadow_rays"] > 0, asks_lamps)
            self.assertEqual(work["light_segments"] > 0, has_others)
            if asks_lamps:
                rays = work["segments"] + work["shadow_rays"] + work["light_segments"]
                rays_a_segment = rays / work["segments"]
                self.assertAlmostEqual(statistics["mrays_per_s"] / statistics["msegments_per_s"], rays_a_segment)
            else:
                self.assertIsNone(statistics["mrays_per_s"])

    def test_a_kernel_that_does_not_compile(self):
        lines = PT_KERNEL.splitlines()
        line = next(number for number, text in enumerate(lines, 1) if text.startswith("static inline lanes_mask"))
        self.scratch.write("kernels/pt/pt.cl", PT_KERNEL.replace("static inline lanes_mask", "static inline mistake", 1))
        record = self.only_case(*ONE, "--kernel-dir", "kernels", code=1)
        self.assertEqual(record["status"], "compile")
        self.assertRegex(record["reason"], rf"pt/pt.cl:{line}:\d+.*mistake")
        self.assertRegex(record["build"]["log"], rf"pt/pt.cl:{line}:\d+.*mistake")
        self.assertTrue(record["build"]["overridden"])
        self.assertRegex(record["build"]["kernel_hash"], "^[0-9a-f]{16}$")
        self.assertEqual(record["samples"], [])
        verbose = self.run_ok(*ONE, "--kernel-dir", "kernels", "-v", code=1)
        self.assertIn("build log of pt on pocl:1", verbose.stderr)

    def test_render_ends_with_the_same_reason(self):
        self.scratch.write("kernels/pt/pt.cl", "no kernel\n")
        result = self.run_ok("render", "-o", "x.png", "--kernel-dir", "kernels", code=1)
        self.assertRegex(result.stderr.splitlines()[-1], r"^error: .*pt/pt.cl:1:")
        self.assertNotIn("x.png", self.scratch.files())

    def test_an_include_that_is_missing(self):
        self.scratch.write("kernels/pt/pt.cl", '#include "pt/nowhere.h"\n')
        record = self.only_case(*ONE, "--kernel-dir", "kernels", code=1)
        self.assertEqual(record["status"], "compile")
        self.assertRegex(record["reason"], "pt/pt.cl:1: .*pt/nowhere.h")
        self.assertTrue(record["build"]["overridden"])

    def test_a_wrong_image_is_not_timed(self):
        film = (SOURCE / "kernels/engine/film.h").read_text()
        wrong = film.replace("{tally.radiance.x, tally.radiance.y,", "{1.2f * tally.radiance.x, 1.2f * tally.radiance.y,")
        self.assertNotEqual(wrong, film)
        self.scratch.write("kernels/engine/film.h", wrong)
        record = self.only_case(*ONE, "--kernel-dir", "kernels", code=4)
        self.assertEqual(record["status"], "invalid")
        self.assertEqual((record["samples"], record["statistics"]), ([], None))
        self.assertTrue(record["reason"])
        self.assertTrue(record["build"]["overridden"])


class Budget(CliTest):
    def test_what_does_not_fit_is_skipped_with_the_reason(self):
        words = changed(TINY, spp="1,2,2000000000", samples=3)
        self.run_ok(*words, "--max-total-time", "20", "--out", "out", "-q")
        planned = self.run_ok(*words, "--dry-run", "-q").stdout.splitlines()
        records = self.scratch.result()["cases"]
        self.assertEqual(len(records), len(planned))
        found = [(r["params"]["device"], r["params"]["spp"], r["status"]) for r in records]
        self.assertEqual(found, [(device, spp, "skipped" if spp == 2000000000 else "ok")
                                 for device in ("pocl:0", "pocl:1") for spp in (1, 2, 2000000000)])
        for record in records:
            if record["status"] == "skipped":
                self.assertRegex(record["reason"], r"predicted .* a sample, .* of the budget .*--max-total-time")

    def test_a_budget_that_is_used_up(self):
        record = self.only_case(*ONE, "--max-total-time", "0.001")
        self.assertEqual(record["status"], "skipped")
        self.assertIn("--max-total-time", record["reason"])


class Scenes(CliTest):
    def validation(self, text):
        self.scratch.write("mine.json", text)
        record = self.only_case(*changed(ONE, spp=4), "--scene", "mine.json")
        self.assertEqual(ended(record), "ok", record["reason"])
        return record["validation"]

    def test_a_shipped_name_with_other_content_is_not_judged_by_what_is_stored_of_the_name(self):
        text = (SOURCE / "configs/scenes/thesis.json").read_text()
        self.assertEqual(self.validation(text)["against"], "thesis_pt_128x128_pl2")
        brighter = self.validation(text.replace("[15, 15, 15]", "[30, 30, 30]"))
        self.assertIn("the host's tracer, a few samples", brighter["against"])
        self.assertIn("no stored reference", self.scratch.result()["cases"][0]["efficiency"]["reason"])


class Isolation(CliTest):
    def test_no_isolate_measures_the_same_in_this_process(self):
        apart = self.only_case(*ONE)
        together = self.only_case(*ONE, "--no-isolate")
        self.assertEqual((ended(apart), ended(together)), ("ok", "ok"))
        self.assertEqual(apart["work"]["segments"], together["work"]["segments"])
        self.assertTrue(any("--no-isolate" in warning for warning in self.scratch.result()["warnings"]))


if __name__ == "__main__":
    unittest.main()
