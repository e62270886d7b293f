"""The axes that say how work is expressed: each value is validated, what means nothing is refused, queues tell of overlap."""

import unittest

from ptbench import ONE, SOURCE, CliTest, changed, ended

UNIT = (SOURCE / "kernels/engine/unit.h").read_text()


class Variants(CliTest):
    def records(self, *words, code=0):
        self.run_ok(*ONE, *words, "--out", "run", "-q", code=code, timeout=300)
        return self.scratch.result("run")["cases"]

    def test_every_launch_is_timed_behind_the_same_image(self):
        cases = self.records("-a", "queue=[in_order,out_of_order]", "-a", "dispatch=[ndrange,tasks]",
                             "-a", "film_memory=[buffer,image]")
        self.assertEqual(len(cases), 8)
        for record in cases:
            with self.subTest(record["params"]):
                self.assertEqual(ended(record), "ok", record["reason"])
                self.assertGreater(record["statistics"]["median_ns"], 0)
                self.assertEqual(record["validation"]["max_abs_z"], cases[0]["validation"]["max_abs_z"])
                overlap = record["work"]["overlap"]
                if record["params"]["queue"] == "in_order":
                    self.assertIsNone(overlap)
                else:
                    self.assertTrue(0 <= overlap <= 1)

    def test_what_changes_the_image_is_validated_by_itself(self):
        cases = self.records("-a", "pixel_filter=[jitter,centre,stratified]")
        self.assertEqual([ended(record) for record in cases], ["ok"] * 3)
        jitter, centre, stratified = (record["validation"] for record in cases)
        self.assertEqual(stratified["against"], jitter["against"])
        self.assertIn("the host's tracer", centre["against"])
        self.assertNotEqual(stratified["max_abs_z"], jitter["max_abs_z"])

    def test_paths_that_end_at_random_are_judged_by_their_image(self):
        off, albedo = self.records("-a", "roulette=[off,albedo]")
        self.assertEqual((ended(off), ended(albedo)), ("ok", "ok"), albedo["reason"])
        checks, without = set(off["validation"]["checks"]), set(albedo["validation"]["checks"])
        self.assertEqual(checks - without, {"segments", "full_length"})
        self.assertLess(albedo["work"]["segments"], off["work"]["segments"])

    def test_an_invalid_build_has_a_verdict_and_no_time(self):
        wrong = UNIT.replace("* launch->stratum_height", "* launch->stratum_width")  # 2 x 5 cells as 2 x 2: too tall
        self.assertNotEqual(wrong, UNIT)
        self.scratch.write("kernels/engine/unit.h", wrong)
        words = changed(ONE, spp=10)
        self.run_ok(*words, "-a", "pixel_filter=[jitter,stratified]", "--kernel-dir", "kernels", "--out", "run", "-q", code=4)
        jitter, stratified = self.scratch.result("run")["cases"]
        self.assertEqual((ended(jitter), ended(stratified)), ("ok", "invalid"))
        self.assertEqual((stratified["samples"], stratified["statistics"]), ([], None))
        self.assertIn("standard errors", stratified["reason"])

    def test_what_a_kernel_lacks_is_refused_by_name(self):
        for axis, value, says in (("rng", "hash", "thesis has auto, park_miller"),
                                  ("scene_memory", "local", "thesis has auto, global"),
                                  ("pixel_filter", "centre", "thesis has jitter"),
                                  ("film_memory", "image", "thesis has buffer")):
            with self.subTest(axis):
                record = self.only_case(*changed(ONE, kernel="thesis"), "-a", f"{axis}={value}")
                self.assertEqual(record["status"], "unsupported")
                self.assertEqual(record["reason"], f"{axis} {value}: {says}")
        record = self.only_case(*changed(ONE, wg="8"), "-a", "dispatch=tasks")
        self.assertEqual(record["status"], "unsupported")
        self.assertIn("work_group has to be implicit", record["reason"])


if __name__ == "__main__":
    unittest.main()
