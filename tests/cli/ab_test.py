"""`ptbench ab`: two versions measured alternately; what is decided, stored and decided again."""

import json
import os
import signal
import unittest

from ptbench import BINARY, SOURCE, CliTest
from validate_schema import schema_errors

SCHEMA = SOURCE / "configs/schema/ab.schema.json"
# A case of some milliseconds; its validation takes less than a second a side.
TINY = ("ab", "-d", "pocl:1", "--kernel", "pt", "--size", "32", "--spp", "4", "--path-length", "2", "--wg", "implicit",
        "--timeout", "60")
SEGMENT = "            lanes_mask ends = arrive(&world, &path, &meeting, alive, &turn, &face COUNTED_ARGUMENT);\n"
# Every segment takes several times as long; the image is the same.
SLOW = SEGMENT + """            lanes_f wasted = path.ray.direction.x;
            for (int i = 0; i < 3000; ++i) wasted = wasted * 0.999f + 0.5f;
            turn += lanes_any(wasted < -1e30f) ? 1u : 0u;
"""


class AbTest(CliTest):
    def kernels(self, name, old="", new="", file="engine/trace.h"):
        """A folder with a changed file of kernels."""
        text = (SOURCE / "kernels" / file).read_text()
        self.assertIn(old, text)
        self.scratch.write(f"{name}/{file}", text.replace(old, new))
        return name

    def ab(self, *words, code=0, **options):
        """Runs a gate; its stored decision."""
        self.ran = self.run_ok(*TINY, "--json", "ab.json", *words, code=code, **options)
        return self.stored()

    def stored(self, name="ab.json"):
        return json.loads((self.scratch.work / name).read_text())

    def states(self, gate):
        return [finding["state"] for finding in gate["findings"]]


class Decisions(AbTest):
    def test_a_slower_version_is_regressed_and_a_faster_one_improved(self):
        slow = self.kernels("slow", SEGMENT, SLOW)
        gate = self.ab("--new-kernels", slow, code=3)
        self.assertEqual(self.states(gate), ["regressed"])
        self.assertEqual([len(gate["cases"][0][stage]) for stage in ("screen", "confirm")], [10, 20])
        self.assertIn("regressed", self.ran.stdout)
        self.assertEqual(self.states(self.ab("--base-kernels", slow)), ["improved"])

    def test_a_version_is_not_slower_than_itself(self):
        gate = self.ab("--tolerance", "100%")
        self.assertIn(self.states(gate)[0], ("same", "inconclusive"))
        self.assertEqual(gate["base"], gate["new"])
        self.assertIn("A/A", self.ran.stdout)

    def test_the_tolerance_is_the_series_own(self):
        config = {"series": [{"spp": 1, "tolerance": "40%"}, {"spp": 2}], "tolerance": "30%", "device": "pocl:1"}
        self.scratch.write("my.json", config)
        words = [word for word in TINY if word not in ("--spp", "4")]
        self.run_ok(*words, "--config", "my.json", "--json", "ab.json")
        self.assertEqual([case["tolerance"] for case in self.stored()["cases"]], [0.4, 0.3])

    def test_two_configs_are_paired_in_order(self):
        for name, lanes in (("base.json", 1), ("new.json", 4)):
            self.scratch.write(name, {"series": [{"lanes": lanes}]})
        words = ("--base-config", "base.json", "--new-config", "new.json", "--tolerance", "100%")
        (case,) = self.ab(*words)["cases"]
        self.assertEqual((case["base"]["lanes"], case["new"]["lanes"]), ("1", "4"))
        self.scratch.write("new.json", {"series": [{"lanes": [1, 4]}]})
        self.assert_refused(*TINY, *words, says=["--new-config", "found 2 cases", "allowed: 1"])

    def test_two_binaries(self):
        self.scratch.write("new", f"#!/bin/sh\necho $$ >> new.pids\nexec {BINARY} \"$@\"\n")
        (self.scratch.work / "new").chmod(0o755)
        gate = self.ab("--base", BINARY, "--new", "new", "--tolerance", "100%")
        self.assertEqual((gate["base"]["binary"], gate["new"]["binary"]), (BINARY, "new"))
        self.assertEqual(len((self.scratch.work / "new.pids").read_text().split()), 1, "one worker for the whole gate")


class Sides(AbTest):
    def test_a_wrong_image_on_a_side_is_exit_4_and_has_no_times(self):
        bright = self.kernels("bright", "{tally.radiance.x,", "{2.0f * tally.radiance.x,", "engine/film.h")
        gate = self.ab("--new-kernels", bright, code=4)
        self.assertEqual(gate["new_records"][0]["status"], "invalid")
        self.assertEqual(gate["cases"][0]["screen"], [])
        self.assertIn("new: ", self.ran.stdout)
        self.assertEqual(self.ab("--base-kernels", bright, code=4)["base_records"][0]["status"], "invalid")

    def test_a_kernel_that_does_not_build_is_exit_1(self):
        broken = self.kernels("broken", SEGMENT, "no C")
        self.assertEqual(self.ab("--new-kernels", broken, code=1)["new_records"][0]["status"], "compile")

    def test_a_case_that_the_new_side_cannot_do_loses_coverage(self):
        self.scratch.write("base.json", {"series": [{"lanes": 1}, {"lanes": 4}]})
        self.scratch.write("new.json", {"series": [{"lanes": 1}, {"lanes": 4, "work_group": "8x8"}]})
        words = [word for word in TINY if word not in ("--wg", "implicit")]
        words += ["--base-config", "base.json", "--new-config", "new.json", "--tolerance", "100%", "--json", "ab.json"]
        self.run_ok(*words, code=6)
        self.assertEqual(self.states(self.stored())[1], "missing")
        self.run_ok(*words, "--allow-missing", code=0)

    def test_nothing_to_compare_is_not_a_pass(self):
        words = [word if word != "implicit" else "8x8" for word in TINY]
        self.run_ok(*words, "--json", "ab.json", code=7)
        self.assertEqual(self.states(self.stored()), ["unmeasured"])

    def other(self, answer):
        """A binary that answers each request with this line."""
        self.scratch.write("other", f"#!/bin/sh\nwhile read line; do echo '{json.dumps(answer)}'; done\n")
        (self.scratch.work / "other").chmod(0o755)
        return "other"

    def test_a_worker_of_another_protocol_is_not_comparable(self):
        for kind in ("ready", "failed"):
            other = self.other({"kind": kind, "protocol": 1, "reason": "no"})
            result = self.run_ok(*TINY, "--new", other, "-q", "--json", "ab.json", code=7)
            self.assertIn("speaks protocol 1", result.stderr)

    def test_a_binary_that_is_no_ptbench_is_named(self):
        result = self.run_ok(*TINY, "--base", "/bin/true", "-q", "--json", "ab.json", code=1)
        self.assertIn("--base: the worker of pocl:1 fails to start", result.stderr)


class Stored(AbTest):
    def test_a_decision_keeps_to_its_schema_and_is_decided_again(self):
        slow = self.kernels("slow", SEGMENT, SLOW)
        self.ab("--new-kernels", slow, code=3)
        self.assertEqual(schema_errors(SCHEMA, self.scratch.work / "ab.json"), "")
        again = self.run_ok("compare", "--replay", "ab.json", code=3)
        self.assertEqual(again.stdout, self.ran.stdout)
        self.assertEqual(self.run_ok("compare", "--replay", "ab.json", "--md", "-", code=3).stderr, self.ran.stdout)

    def test_a_decision_that_its_data_do_not_bear_out_is_an_error(self):
        gate = self.ab("--tolerance", "100%")
        gate["findings"][0]["state"] = "improved"
        self.scratch.write("forged.json", gate)
        result = self.run_ok("compare", "--replay", "forged.json", code=1)
        self.assertIn("forged.json: /findings/0/state: stored is improved, its data say", result.stderr)

    def test_what_is_no_decision_is_refused(self):
        gate = self.ab("--tolerance", "100%")
        del gate["cases"][0]["screen"][0]["rounds"][2]
        self.scratch.write("short.json", gate)
        self.assert_refused("compare", "--replay", "short.json", says=["/cases/0/screen/0/rounds", "found 3 rounds"])
        self.scratch.write("other.json", {"schema": "ptbench.v1"})
        self.assert_refused("compare", "--replay", "other.json", says=["not a decision"])

    def test_without_json_the_file_is_named_after_time_and_config(self):
        self.run_ok(*TINY, "--tolerance", "100%", "-q")
        self.assertRegex(" ".join(self.scratch.files()), r"ptbench-results/\d{4}-.*Z-ab-ci.json")

    def test_interruption_keeps_what_was_measured(self):
        process = self.start("ab", "-d", "pocl:1", "--kernel", "pt", "--size", "128", "--spp", "200",
                                     "--path-length", "5", "--wg", "implicit", "--json", "ab.json")
        for line in process.stderr:
            if "block 1 of" in line:
                break
        process.send_signal(signal.SIGINT)
        _, err = process.communicate(timeout=30)
        self.assertEqual(process.returncode, 130, err)
        gate = self.stored()
        self.assertTrue(gate["run"]["interrupted"])
        self.assertNotIn(self.states(gate)[0], ("regressed", "improved"))


class Refusals(AbTest):
    def test_flags_that_cannot_be(self):
        for words, says in [
            (("--tolerance", "5"), ["--tolerance", "found 5", "5%"]),
            (("--require-mde", "5%"), ["--require-mde", "found 5%", "more than the tolerance of 5%"]),
            (("--require-mde", "x"), ["--require-mde", "found x"]),
            (("--json", "-"), ["--json", "--replay"]),
            (("--json", "missing/x.json"), ["--json", "missing/x.json"]),
            (("--new", "missing"), ["--new", "missing"]),
            (("--new-kernels", "missing"), ["--new-kernels", "missing"]),
            (("--new-config", "missing"), ["missing", "cards, ci, doctor, ladder, memory, quality, queues, quick, rays, speed, thesis, tune, workgroups"]),
            (("--profile", "fast"), ["--profile", "shared"]),
        ]:
            with self.subTest(words):
                self.assert_refused(*TINY, *words, says=says)


if __name__ == "__main__":
    unittest.main()
