"""How efficient kernels are: noise and efficiency in every output of a run, pictures at equal time, and in comparisons."""

import csv
import io
import json
import unittest

from ptbench import SOURCE, CliTest, Scratch, ended, undisturbed
from validate_schema import schema_errors

LADDER = {"name": "small", "pictures": "equal_time", "samples": 12, "warmup": 0, "max_time": 60,
          "series": [{"kernel": ["pt", "thesis"], "size": 64, "spp": [8, 16], "path_length": 5}]}


class Efficiency(unittest.TestCase):
    """One run of two kernels, looked at from all sides."""

    @classmethod
    def setUpClass(cls):
        cls.scratch = Scratch()
        cls.addClassCleanup(cls.scratch.remove)
        cls.scratch.write("ladder.json", LADDER)
        cls.ran = cls.scratch.run("-d", "pocl:1", "--config", "ladder.json", "--out", "out", "--html", "page.html", timeout=300)
        assert cls.ran.returncode == 0, cls.ran.stdout + cls.ran.stderr
        cls.result = cls.scratch.result()
        cls.cases = cls.result["cases"]

    def test_the_result_file_keeps_to_its_schema(self):
        self.assertEqual(schema_errors(SOURCE / "configs/schema/result.schema.json", self.scratch.work / "out/result.json"), "")

    def test_efficiency_is_one_over_noise_and_seconds_within_its_interval(self):
        for case in self.cases:
            seconds = case["statistics"]["median_ns"] / 1e9
            for noise in (case["efficiency"]["all"], case["efficiency"]["best_99"]):
                self.assertAlmostEqual(noise["efficiency"] * noise["rel_mse"] * seconds, 1)
                if case["statistics"]["ci_low_ns"] is None:  # too few samples without a flag
                    self.assertEqual((noise["low"], noise["high"]), (None, None))
                else:
                    self.assertTrue(noise["low"] < noise["efficiency"] < noise["high"])
            self.assertLess(case["efficiency"]["best_99"]["rel_mse"], case["efficiency"]["all"]["rel_mse"])

    def test_twice_the_samples_have_half_the_noise(self):
        by_work = {(case["params"]["kernel"], case["params"]["spp"]): case["efficiency"]["all"] for case in self.cases}
        for kernel in ("pt", "thesis"):
            few, many = by_work[kernel, 8], by_work[kernel, 16]
            error = 5 * ((few["standard_error"] / 2) ** 2 + many["standard_error"] ** 2) ** 0.5
            self.assertAlmostEqual(few["rel_mse"] / 2, many["rel_mse"], delta=error)

    def test_the_variance_is_the_film_s_or_else_the_reference_s(self):
        self.assertEqual({case["params"]["kernel"]: case["efficiency"]["variance_from"] for case in self.cases},
                         {"pt": "film", "thesis": "reference"})

    def test_each_kernel_leaves_its_picture_at_equal_time_and_no_other(self):
        pictures = [picture["file"] for picture in self.result["pictures"]]
        self.assertEqual(sorted(picture["params"]["kernel"] for picture in self.result["pictures"]), ["pt", "thesis"])
        self.assertEqual(sorted(pictures), sorted(name[4:] for name in self.scratch.files() if name.endswith(".png")))

    def test_tables_say_how_many_times_as_efficient_as_pt(self):
        for text in (self.ran.stdout, (self.scratch.work / "out/table.md").read_text()):
            self.assertIn("efficiency at equal time", text)
            self.assertIn("x pt", text)

    def test_csv_has_what_the_records_have(self):
        rows = list(csv.DictReader(io.StringIO((self.scratch.work / "out/result.csv").read_text())))
        for row, case in zip(rows, self.cases, strict=True):
            for name, noise in (("", case["efficiency"]["all"]), ("_best_99", case["efficiency"]["best_99"])):
                for column, key in (("rel_mse", "rel_mse"), ("rel_mse_error", "standard_error"), ("efficiency", "efficiency"),
                                    ("efficiency_low", "low"), ("efficiency_high", "high")):
                    if noise[key] is None:
                        self.assertEqual(row[column + name], "")
                    else:
                        self.assertAlmostEqual(float(row[column + name]) / noise[key], 1, places=5)

    def test_the_page_has_the_pictures_side_by_side_and_the_table(self):
        page = (self.scratch.work / "page.html").read_text()
        self.assertIn("<h4>thesis at 64x64, path length 5, on ", page)
        self.assertIn("<caption>efficiency at equal time</caption>", page)
        self.assertIn("<caption>relMSE over time</caption>", page)

    def test_compare_shows_the_ratio_of_efficiencies(self):
        steady = self.scratch.write("steady.json", undisturbed(self.result))
        self.scratch.run("compare", steady, steady, "--json", "same.json")
        rows = json.loads((self.scratch.work / "same.json").read_text())["rows"]
        self.assertEqual([row["efficiency_ratio"] for row in rows], [1, 1, 1, 1])
        self.assertEqual(schema_errors(SOURCE / "configs/schema/compare.schema.json", self.scratch.work / "same.json"), "")


class NoEfficiency(CliTest):
    def test_what_cannot_be_said_has_a_reason(self):
        words = ("-d", "pocl:1", "--kernel", "pt", "--path-length", "2", "--wg", "implicit", "--samples", "1", "--warmup", "0")
        for more, reason in ((("--size", "24", "--spp", "2"), "size 24x24: neither a multiple nor a part"),
                             (("--size", "16", "--spp", "1"), "spp 1"),
                             (("--size", "16", "--spp", "4", "-a", "pixel_filter=centre"), "no stored reference"),
                             (("--size", "16", "--spp", "4", "-a", "pixel_filter=stratified"), "stratified")):
            with self.subTest(reason):
                record = self.only_case(*words, *more)
                self.assertIn(reason, record["efficiency"]["reason"])
                self.assertIsNone(record["efficiency"]["all"])
                self.assertEqual(ended(record), "ok")


if __name__ == "__main__":
    unittest.main()
