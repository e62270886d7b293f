"""Lists of rays as users meet them: rates in every output, and no time behind a wrong hit."""

import csv
import unittest

from ptbench import ONE, SOURCE, CliTest, changed, ended

SEARCH = (SOURCE / "kernels/scene/tree8.h").read_text()
RAYS = (*changed(ONE, kernel="rays", size=64), "--scene", "cornell")


class Rays(CliTest):
    def test_every_kind_has_a_rate_in_the_record_the_table_and_csv(self):
        result = self.run_ok(*RAYS, "-a", "ray_kind=[primary,bounce1,bounce3,shadow]", "--out", "out", "--csv", "rays.csv")
        cases = self.scratch.result()["cases"]
        self.assertEqual([ended(case) for case in cases], ["ok"] * 4, [case["reason"] for case in cases])
        for case in cases:
            with self.subTest(case["params"]["ray_kind"]):
                self.assertIn("rays", case["validation"]["checks"])
                self.assertEqual(case["work"]["listed_rays"], 64 * 64 * 2)
                self.assertAlmostEqual(case["statistics"]["mrays_per_s"], case["statistics"]["msamples_per_s"])
        self.assertIn("Mrays/s", result.stdout)
        with open(self.scratch.work / "rays.csv") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["ray_kind"] for row in rows], ["primary", "bounce1", "bounce3", "shadow"])
        self.assertTrue(all(float(row["mrays_per_s"]) > 0 for row in rows))

    def test_a_ray_that_misses_what_is_there_gives_no_time(self):
        wrong = SEARCH.replace("(numbers != s->left)", "(numbers != s->left) & (numbers != 7u)")
        self.assertNotEqual(wrong, SEARCH)
        self.scratch.write("kernels/scene/tree8.h", wrong)
        record = self.only_case(*RAYS, "--kernel-dir", "kernels", code=4)
        self.assertEqual((record["status"], record["samples"], record["statistics"]), ("invalid", [], None))
        self.assertIn("the ray from (", record["reason"])
        self.assertIn("meets triangle 7 at", record["reason"])


if __name__ == "__main__":
    unittest.main()
