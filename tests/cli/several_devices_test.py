"""Axes `devices`, one picture by several, and `together`, several at work at the same time."""

import csv
import unittest

from ptbench import SOURCE, TINY, CliTest, changed, ended
from validate_schema import schema_errors

BOTH = ("--all-devices", *TINY, "--out", "out", "-q")
SCHEMA = SOURCE / "configs/schema/result.schema.json"


class SeveralDevices(CliTest):
    def records(self, *words, code=0):
        self.run_ok(*BOTH, *words, code=code)
        self.assertEqual(schema_errors(SCHEMA, self.scratch.work / "out/result.json"), "")
        return self.scratch.result()["cases"]

    def test_a_picture_of_several_devices_is_measured_and_has_the_bits_of_one(self):
        records = self.records("-a", "devices=[1,all]", "--csv", "x.csv")
        self.assertEqual([(r["params"]["device"], r["params"]["devices"]) for r in records],
                         [("pocl:0", "1"), ("pocl:0", "2"), ("pocl:1", "1")])
        self.assertEqual([ended(r) for r in records], ["ok"] * 3, [r["reason"] for r in records])
        alone, shared, _ = records
        self.assertEqual(shared["work"]["film_hash"], alone["work"]["film_hash"])
        self.assertEqual(shared["work"]["segments"], alone["work"]["segments"])
        self.assertEqual((shared["shared"]["devices"], shared["statistics"]["timer"]), (["pocl:0", "pocl:1"], "host"))
        self.assertTrue(0 < shared["shared"]["efficiency"] and 0 < shared["shared"]["speedup"], shared["shared"])
        self.assertIsNone(alone["shared"])
        self.assertEqual(self.scratch.result()["warnings"], [w for w in self.scratch.result()["warnings"] if "picture" not in w])
        with open(self.scratch.work / "x.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["devices"] for row in rows], ["1", "2", "1"])
        self.assertEqual([row["speedup"] != "" for row in rows], [False, True, False])

    def test_what_several_devices_cannot_do_is_unsupported(self):
        words = changed(BOTH, kernel="pt,thesis", path_length=5)
        self.run_ok(*words, "-a", "(devices,together)=[(2,no),(3,no),(2,all)]", code=None)
        reasons = [(r["status"], r["reason"]) for r in self.scratch.result()["cases"] if r["status"] != "ok"]
        self.assertIn(("unsupported", "devices 3: there are 2 CPUs in this run"), reasons)
        self.assertEqual(reasons.count(("unsupported", "devices 2: all of them work on one picture; allowed: together no")), 2)
        self.assertIn("several devices cannot share its pictures", "".join(reason for _, reason in reasons))
        self.assertEqual({status for status, _ in reasons} - {"unstable"}, {"unsupported"})

    def test_all_devices_work_at_the_same_time_each_at_its_own_case(self):
        records = self.records("--together", "no,all")
        self.assertEqual([(r["params"]["device"], r["params"]["together"]) for r in records],
                         [("pocl:0", "no"), ("pocl:0", "all"), ("pocl:1", "no"), ("pocl:1", "all")])
        self.assertEqual([ended(r) for r in records], ["ok"] * 4, [r["reason"] for r in records])
        self.assertEqual(len({r["work"]["film_hash"] for r in records[:2]}), 1, "company changes no bit")
        self.assertEqual(self.scratch.processes(), [])

    def test_cpus_are_not_beside_gpus_unless_asked(self):
        records = self.records("--together", "gpus", code=None)
        self.assertEqual([r["status"] for r in records], ["unsupported"] * 2)
        self.assertEqual(records[0]["reason"], "together gpus: pocl:0 is a CPU; all: every device of the run")

    def test_what_measures_one_device_at_a_time_refuses_several(self):
        for axis in ("devices=2", "together=all"):
            self.scratch.write("two.json", {"series": [dict([axis.split("=")])]})
            for words in (("ab", "--config", "two.json"), ("tune", "--config", "two.json"), ("--no-isolate", "--config", "two.json"),
                          ("render", "-o", "x.png", "-a", axis)):
                with self.subTest(axis=axis, words=words):
                    self.assert_refused(*words, says=axis.replace("=", " ") + ": ")
        for words in (("ab",), ("tune",), ("render", "-o", "x.png")):
            self.assert_refused(*words, "--together", "all", says='--together')


if __name__ == "__main__":
    unittest.main()
