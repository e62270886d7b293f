"""`ptbench tune`: what is found is stored, serves later runs where nobody names a value, and is named in their records."""

import json
import unittest

from validate_schema import schema_errors
from ptbench import SOURCE, CliTest

WORK = ("-d", "pocl:1", "--kernel", "pt", "--size", "16", "--spp", "2", "--path-length", "2", "--timeout", "60")
RUN = (*WORK, "--samples", "1", "--warmup", "0", "-q", "--out", "out")
STORE = "store/tune.json"


class Tuned(CliTest):
    def tune(self, *words, code=0):
        return self.run_ok("tune", *WORK, "--tune-file", STORE, *words, code=code)

    def stored(self):
        return json.loads((self.scratch.work / STORE).read_text())

    def params(self, *words):
        self.run_ok(*RUN, "--config", "one.json", *words)
        return self.scratch.result()["cases"][0]["params"]

    def test_the_best_serves_later_runs_and_nothing_that_was_named_changes(self):
        shown = self.tune("--lanes", "4,8", "--wg", "16,8x8").stdout
        self.assertRegex(shown, r"\d  best")
        self.assertIn("2 candidates are unsupported here", shown)
        self.assertEqual(schema_errors(SOURCE / "configs/schema/tune.schema.json", self.scratch.work / STORE), "")
        (kernel,) = self.stored()["kernels"]
        best = kernel["best"]
        self.assertIn(best, kernel["ties"])
        self.assertEqual(best["work_group"], "16")

        self.scratch.write("one.json", {"series": [{"spp": 2}]})
        tuned = self.params("--tune-file", STORE)
        self.assertEqual((tuned["lanes"], tuned["lanes_from"]), (best["lanes"], "tune"))
        self.assertEqual((tuned["work_group"], tuned["work_group_from"]), ("16", "tune"))
        result = self.scratch.work / "out/result.json"
        self.assertEqual(json.loads(result.read_text())["run"]["tuned"], [best])
        self.assertEqual(schema_errors(SOURCE / "configs/schema/result.schema.json", result), "")
        self.assertIn("tuned: pt on pocl:1", (self.scratch.work / "out/table.md").read_text())

        # A resumed run keeps the launches that it began with, whatever is stored now.
        self.assertEqual(self.params("--resume", "out/journal.jsonl"), tuned)
        self.run_ok(*RUN, "--config", "one.json", "--no-tune", "--resume", "out/journal.jsonl", code=7)

        for words in (("--tune-file", STORE, "--no-tune"), ("--tune-file", "none.json"),
                      ("--tune-file", STORE, "--lanes", "auto", "--wg", "implicit")):
            with self.subTest(words):
                plain = self.params(*words)
                self.assertEqual((plain["lanes"], plain["work_group"]), ("auto", "implicit"))
                self.assertNotIn("lanes_from", plain)

    def test_what_is_stale_is_not_used_and_says_why(self):
        self.tune("--lanes", "4", "--wg", "16")
        store = self.stored()
        store["kernels"][0]["driver"] = "an older one"
        self.scratch.write(STORE, store)
        result = self.run_ok(*WORK, "--tune-file", STORE, "--dry-run")
        self.assertRegex(result.stderr, r"not used: pt on pocl:1 was tuned for an older one, this is .*`ptbench tune -d pocl:1")
        self.assertNotIn("lanes 4", result.stdout)


class Refusals(CliTest):
    def test_candidates_that_differ_in_their_work(self):
        self.assert_refused("tune", "--spp", "1,2", says=["tune: found", "spp 1", "spp 2", "lanes and work_group alone"])

    def test_a_file_that_is_no_store(self):
        self.scratch.write("notes.json", {"schema": "notes"})
        for words in (("tune",), ("--dry-run",)):
            self.assert_refused(*words, "--tune-file", "notes.json", says=["notes.json", "not what `ptbench tune` stores"])


if __name__ == "__main__":
    unittest.main()
