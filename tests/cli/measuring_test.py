"""How a case is measured, as its record shows it: enough samples or a reason, the clock asked for, the line over SPP."""

import csv
import io
import unittest

from ptbench import SOURCE, CliTest, ended, undisturbed
from validate_schema import schema_errors

# As TINY, without a number of samples.
ADAPTIVE = ("-d", "pocl:1", "--kernel", "pt", "--size", "32", "--path-length", "2", "--wg", "implicit",
            "--timeout", "60", "--max-time", "5")
SCHEMA = SOURCE / "configs/schema/result.schema.json"


def half_width(statistics):
    return (statistics["ci_high_ns"] - statistics["ci_low_ns"]) / 2 / statistics["median_ns"]


class Measuring(CliTest):
    def run_cases(self, *words):
        self.output = self.run_ok(*ADAPTIVE, *words, "--out", "out").stdout
        self.assertEqual(schema_errors(SCHEMA, self.scratch.work / "out/result.json"), "")
        result = self.scratch.result()
        for case in result["cases"]:
            counted = case["statistics"]["n"] + case["statistics"]["flagged"]
            self.assertIn(len(case["samples"]), (counted, case["statistics"]["n"]))
        return result

    def test_a_case_stops_when_its_median_is_known_or_says_why_not(self):
        (case,) = self.run_cases("--spp", "40")["cases"]
        statistics = case["statistics"]
        if statistics["stop_reason"] == "precision":
            self.assertLessEqual(half_width(statistics), 0.01)
            self.assertGreaterEqual(statistics["n"], 10)
        else:
            self.assertIn(statistics["stop_reason"], ("max_time", "max_samples"))

    def test_peaks_are_in_the_file_and_in_the_report(self):
        result = self.run_cases("--spp", "1", "--samples", "1", "--peaks")
        ((device, peaks),) = [(each["device"], each["peaks"]) for each in result["peaks"]]
        self.assertEqual(device, "pocl:1")
        self.assertEqual({peak["name"]: peak["reason"] for peak in peaks},
                         dict.fromkeys(("fma", "sqrt", "division", "global", "constant", "launch"), ""))
        self.assertRegex(self.output, r"pocl:1 +fma +[\d.]+ +GFLOP/s")

    def test_counts_and_their_shares_of_the_peaks_are_in_the_file_and_in_the_report(self):
        result = self.run_cases("--spp", "20", "--samples", "1", "--lanes", "1,8", "--peaks")
        peaks = {peak["name"]: peak["value"] for peak in result["peaks"][0]["peaks"]}
        alone, together = sorted(result["cases"], key=lambda case: case["work"]["lanes"])
        for case in (alone, together):
            counted, shares = case["counted"], case["counted"]["of_peak"]
            self.assertGreater(counted["segments"], 0)
            rate = counted["flops_per_segment"] * case["statistics"]["msegments_per_s"] / 1e3
            self.assertAlmostEqual(shares["fma"] * peaks["fma"] / rate, 1)
            self.assertEqual(shares["limit_share"], max(
                shares["fma"], shares["sqrt"] + shares["division"], shares["global"]))
        self.assertIsNone(alone["counted"]["lanes_alive"])
        self.assertIn("one lane a work-item", alone["counted"]["reason"])
        self.assertTrue(0 < together["counted"]["lanes_alive"] <= 1, together["counted"])
        self.assertEqual(together["counted"]["reason"], "")
        # The same scene at one path length: roots of a segment are those of its spheres, and little else.
        self.assertTrue(10 < together["counted"]["roots_per_segment"] < 12, together["counted"])
        self.assertRegex(self.output, r"pocl:1 +pt +thesis +\d")

    def test_nothing_is_counted_unless_asked_for(self):
        (case,) = self.run_cases("--spp", "1", "--samples", "1")["cases"]
        self.assertIsNone(case["counted"])

    def test_energy_has_joules_or_a_reason(self):
        (case,) = self.run_cases("--spp", "1", "--samples", "2")["cases"]
        energy = case["energy"]
        self.assertNotEqual(energy["joules"] is None, energy["reason"] == "", energy)

    def test_caps_on_samples(self):
        (case,) = self.run_cases("--spp", "4", "--max-samples", "4")["cases"]
        self.assertEqual((len(case["samples"]), case["statistics"]["stop_reason"]), (4, "max_samples"))
        (case,) = self.run_cases("--spp", "4", "--min-samples", "23", "-w", "1")["cases"]
        self.assertGreaterEqual(len(case["samples"]), 23)

    def test_three_spps_give_a_line(self):
        measured = self.run_cases("--spp", "20,40,80", "--samples", "9")
        self.scratch.write("steady.json", undisturbed(measured))
        said = self.run_ok("--resume", "steady.json", "--out", "line").stdout
        (fit,) = self.scratch.result("line")["fits"]
        self.assertEqual((fit["points"], fit["params"]["spp"]), (3, 80))
        self.assertGreater(fit["ms_per_spp"], 0)
        self.assertIn("time over SPP", said)

    def test_the_host_clock_when_asked_for(self):
        (case,) = self.run_cases("--spp", "4", "--samples", "5", "--timer", "host")["cases"]
        statistics = case["statistics"]
        self.assertEqual((statistics["timer"], statistics["timer_reason"]), ("host", "asked for"))
        self.assertIn("timer: host (asked for)", self.output)
        host = [sample["host_ns"] / case["work"]["renders"] for sample in case["samples"]]
        self.assertLessEqual(min(host), statistics["median_ns"])
        self.assertLessEqual(statistics["median_ns"], max(host))

    def test_every_sample_as_csv(self):
        self.run_cases("--spp", "4", "--samples", "3", "--csv-samples", "samples.csv")
        rows = list(csv.DictReader(io.StringIO((self.scratch.work / "samples.csv").read_text())))
        (case,) = self.scratch.result()["cases"]
        self.assertEqual([int(row["kernel_ns"]) for row in rows], [s["kernel_ns"] for s in case["samples"]])

    def test_a_thousand_cases_of_which_most_cannot_be_done(self):
        words = ("--spp", "[1:100:1]", "--wg", "implicit,2x2,2x4,4x4,4x8,8x8,8x16,16x16,16x32,32x32")
        self.run_ok("-q", "-d", "pocl:1", "--kernel", "pt", "--size", "16", "--path-length", "2", "-w", "0",
                    "--samples", "1", *words, "--out", "out")
        statuses = [ended(case) for case in self.scratch.result()["cases"]]
        self.assertEqual((statuses.count("ok"), statuses.count("unsupported")), (100, 900))


if __name__ == "__main__":
    unittest.main()
