"""--fleet: nodes that share a folder; here each is this machine under another name."""

import copy
import json
import math
import random
import signal
import time
import unittest

from ptbench import ONE, SOURCE, CliTest, changed
from validate_schema import schema_errors

SMALL = (*changed(ONE, spp="1,2"), "--fleet", "F", "-q")
SCHEMA = SOURCE / "configs/schema/result.schema.json"


class FleetTest(CliTest):
    def node(self, name, *words, expect="n[1-2]", **options):
        return self.run_ok(*(words or SMALL), SLURMD_NODENAME=name, SLURM_JOB_NODELIST=expect, **options)

    def file(self, name):
        return self.scratch.work / "F" / name

    def journal(self, node):
        return [json.loads(line) for line in self.file(f"nodes/{node}.jsonl").read_text().splitlines()]

    def write_journal(self, node, lines):
        self.file(f"nodes/{node}.jsonl").write_text("".join(json.dumps(line) + "\n" for line in lines))

    def report(self, *words, code=0):
        return self.run_ok("report", "F", *words, code=code)


class Measuring(FleetTest):
    def test_each_node_measures_once_and_the_last_one_merges(self):
        first = self.node("n2")
        self.assertEqual(first.stdout.splitlines(), ["n2: 1 devices, 2 of 2 cases: 2 ok"])
        self.assertFalse(self.file("result.json").exists())
        last = self.node("n1")
        self.assertIn("fleet: config quick, 2 of 2 nodes, 2 devices, 4 of 4 cases", last.stdout)
        merged = self.file("result.json").read_bytes()
        result = json.loads(merged)
        self.assertEqual(schema_errors(SCHEMA, self.file("result.json")), "")
        self.assertEqual([(case["params"]["device"], case["params"]["spp"]) for case in result["cases"]],
                         [("n1/pocl:1", 1), ("n1/pocl:1", 2), ("n2/pocl:1", 1), ("n2/pocl:1", 2)])
        hashes = [case["work"]["film_hash"] for case in result["cases"]]
        self.assertEqual(hashes[:2], hashes[2:], "equal devices make equal images")
        self.assertNotEqual(hashes[0], hashes[1], "other images are told apart")
        self.assertRegex(hashes[0], "^[0-9a-f]{16}$")
        before = self.file("nodes/n2.jsonl").read_bytes()
        self.file("result.json").unlink()
        self.node("n2")
        self.assertEqual(self.file("nodes/n2.jsonl").read_bytes(), before, "nothing is measured twice")
        self.assertEqual(self.file("result.json").read_bytes(), merged, "the same bytes whoever merges")
        self.file("result.json").unlink()
        self.report()
        self.assertEqual(self.file("result.json").read_bytes(), merged)
        rows = self.run_ok("report", "F/result.json", "--csv", "-").stdout.splitlines()
        self.assertEqual(len(rows), 5, "any other format is that of the result file")

    def test_goes_on_where_a_power_cut_left_it(self):
        self.node("n1", expect="n1")
        whole = self.file("nodes/n1.jsonl").read_text().splitlines(keepends=True)
        header = json.loads(whole[0])
        header["run"]["finished_at"] = ""
        self.file("nodes/n1.jsonl").write_text(json.dumps(header) + "\n" + whole[1] + whole[2][:200])
        missing = self.report(code=6).stdout
        self.assertIn("missing: n1\n", missing)
        self.assertIn("n1: 1 of 2 cases are measured", missing)
        self.node("n1", expect="n1")
        after = self.journal("n1")
        self.assertEqual(after[1], json.loads(whole[1]))
        self.assertEqual([record["params"]["spp"] for record in after[1:]], [1, 2])

    def test_nodes_that_never_came_are_named(self):
        words = (*SMALL, "--expect", "n1,n[3-5],login")
        self.node("n1", *words)
        report = self.report(code=6).stdout
        self.assertIn("1 of 5 nodes", report)
        self.assertIn("missing: login,n[3-5]\n", report)
        self.assertIn("  n3: it never came\n", report)
        self.assertRegex(report, r"to go on: srun -N4 -w login,n\[3-5\] .*ptbench --fleet F\n")

    def test_the_plan_is_enough_for_those_who_come_later(self):
        self.node("n1")
        self.node("n2", "--fleet", "F", "-q")
        self.assertIn("2 of 2 nodes", self.report().stdout)

    def test_a_page_and_a_csv_have_every_device(self):
        for node in ("n1", "n2"):
            self.node(node)
        self.report("--html", "page.html", "--csv", "cards.csv", "--md", "fleet.md")
        page = (self.scratch.work / "page.html").read_text()
        for node in ("n1", "n2"):
            self.assertIn(f"<td>{node}/pocl:1<td>", page)
        self.assertEqual(len((self.scratch.work / "cards.csv").read_text().splitlines()), 3)
        self.assertIn("| device |", (self.scratch.work / "fleet.md").read_text())
        self.assert_refused("report", "F", "--json", "-", says=["of a fleet there are --html", "F/result.json"])


class Refused(FleetTest):
    def test_a_second_process_of_a_living_node_and_not_of_a_dead_one(self):
        long = (*changed(ONE, spp="1,100000000"), "--max-total-time", "0", "--fleet", "F", "-q")
        process = self.scratch.start(*long, SLURMD_NODENAME="n1", SLURM_JOB_ID="42")
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        deadline = time.monotonic() + 30
        while not self.file("nodes/n1.jsonl").exists() or len(self.file("nodes/n1.jsonl").read_text().splitlines()) < 2:
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.05)
        said = self.node("n1", *long, code=2).stderr
        self.assertIn(f"--fleet: n1 is being measured by process {process.pid} of job 42", said)
        self.assertIn("--ntasks-per-node=1", said)
        self.assertFalse(self.file("nodes/n1.refused").exists())
        process.send_signal(signal.SIGKILL)
        process.wait()
        while self.scratch.processes():
            time.sleep(0.05)
        for file in (self.scratch.root / "tmp").iterdir():
            for each in file.iterdir():  # what a killed process leaves
                each.unlink()
            file.rmdir()
        again = self.scratch.start(*long, SLURMD_NODENAME="n1")
        self.addCleanup(again.communicate)
        self.addCleanup(again.kill)
        while str(again.pid) not in self.file("nodes/n1.jsonl").read_text().splitlines()[0]:
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.05)
        again.send_signal(signal.SIGINT)
        again.communicate(timeout=30)
        self.assertEqual(again.returncode, 130)
        self.assertEqual(self.journal("n1")[1]["params"]["spp"], 1)
        self.assertEqual(self.journal("n1")[0]["run"]["finished_at"], "")

    def test_other_options_kernels_and_versions(self):
        self.node("n1")
        refused = self.node("n2", *changed(SMALL, spp="1,3"), code=7).stderr
        self.assertIn("option series (there ", refused)
        self.assertIn("option series", self.file("nodes/n2.refused").read_text())
        report = self.report(code=6).stdout
        self.assertIn("missing: n2\n", report)
        self.assertIn("option series", report)
        self.scratch.write("kernels/pt/pt.cl", (SOURCE / "kernels/pt/pt.cl").read_text() + "/* faster */\n")
        self.assertIn("kernel pt (there ", self.node("n2", *SMALL, "--kernel-dir", "kernels", code=7).stderr)
        plan = json.loads(self.file("plan.json").read_text())
        plan["facts"]["ptbench"] = "0.0 old"
        self.file("plan.json").write_text(json.dumps(plan))
        self.assertIn("ptbench (there 0.0 old", self.node("n2", code=7).stderr)

    def test_a_node_that_gets_in_is_refused_no_more(self):
        self.node("n1")
        self.node("n2", *changed(SMALL, spp="1,3"), code=7)
        self.node("n2")
        self.assertFalse(self.file("nodes/n2.refused").exists())
        self.assertIn("2 of 2 nodes", self.report().stdout)

    def test_another_driver_on_a_node_and_no_device_there(self):
        self.node("n1")
        lines = self.journal("n1")
        lines[0]["devices"][0]["driver_version"] = "old"
        self.write_journal("n1", lines)
        self.assertIn("driver of pocl:1 (there ", self.node("n1", code=7).stderr)
        self.node("n2", code=77, OCL_ICD_VENDORS=str(self.scratch.work))
        self.assertIn("n2: no OpenCL device found", self.report(code=6).stdout)

    def test_what_makes_no_sense_beside_it(self):
        for words in (("--out", "o"), ("--json", "-"), ("--launcher", "env"), ("--save-baseline", "b")):
            self.assert_refused(*SMALL, *words, says=["--fleet", words[0]])
        self.assert_refused(*ONE, "--confirm", says="--fleet")
        self.assert_refused(*ONE, "--expect", "n1", says="--fleet")
        self.assert_refused(*SMALL, "--expect", "n[1", says='--expect: found "n[1"')
        self.assert_refused("--fleet", "nowhere", "--confirm", says="nowhere has no plan.json")


class Equals(FleetTest):
    """Eight nodes, of which one was measured and the others are made of its journal."""

    def setUp(self):
        super().setUp()
        self.nodes = [f"n{i}" for i in range(1, 9)]
        self.node("n1", expect="n[1-8]")
        self.like = self.journal("n1")
        self.chance = random.Random(1)
        for node in self.nodes:
            self.write(node)

    def lines(self, node, slower=0.0):
        lines = copy.deepcopy(self.like)
        lines[0]["host"]["node"] = node
        for record in lines[1:]:
            record["statistics"]["median_ns"] = 1e6 * math.exp(slower + self.chance.gauss(0, 0.002))
        return lines

    def write(self, node, slower=0.0, change=None):
        lines = self.lines(node, slower)
        if change:
            change(lines)
        self.write_journal(node, lines)

    def test_a_wrong_image_is_named(self):
        def dim(lines):
            lines[2]["work"]["film_hash"] = "0" * 16
        self.write("n5", change=dim)
        report = self.report(code=4).stdout
        self.assertRegex(report, r"n5/pocl:1 .*wrong image: pt thesis spp 2")
        self.assertIn("exclude: n5\n", report)

    def test_what_differs_from_most_is_told(self):
        def drift(lines):
            lines[0]["devices"][0]["ecc"] = False
            lines[0]["host"]["kernel"] = "Linux 1.0"
        self.write("n3", change=drift)
        report = self.report().stdout
        self.assertIn("drift: ECC is off on n3 (1 devices), unknown on most", report)
        self.assertIn("drift: kernel is Linux 1.0 on n3", report)

    def test_an_interrupted_confirmation_says_what_it_measured(self):
        self.write("n6", slower=0.12)
        self.report()
        with self.scratch.start("--fleet", "F", "--confirm", SLURMD_NODENAME="n6") as process:
            for line in process.stderr:
                if line.startswith("[3/5]"):
                    process.send_signal(signal.SIGINT)
            said = process.stdout.read()
        self.assertEqual(process.returncode, 130)
        self.assertEqual(said, "n6: 2 sessions measured, then interrupted; 2 of 40 are there\n")

    def test_a_slow_card_is_suspected_confirmed_and_called_slow(self):
        self.write("n6", slower=0.12)
        report = self.report().stdout
        self.assertRegex(report, r"n6/pocl:1 .*suspect, to be confirmed +\+1[23]\.\d %")
        self.assertRegex(report, r"to confirm: srun -N8 -w n\[1-8\] --ntasks-per-node=1 .*ptbench --fleet F --confirm\n")
        said = self.run_ok("--fleet", "F", "--confirm", "-q", SLURMD_NODENAME="n6").stdout
        self.assertEqual(said, "n6: 5 sessions measured; 5 of 40 are there\n")
        said = self.run_ok("--fleet", "F", "--confirm", "-q", SLURMD_NODENAME="n6").stdout
        self.assertEqual(said, "n6: 0 sessions measured; 5 of 40 are there\n", "nothing is measured twice")
        (folder,) = self.file("confirm").iterdir()
        session = json.loads((folder / "n6.pocl-1.1.jsonl").read_text().splitlines()[0])
        self.assertEqual(session["host"]["node"], "n6")
        for node in self.nodes:
            for number in range(1, 6):
                lines = self.lines(node, 0.12 if node == "n6" else 0.0)
                (folder / f"{node}.pocl-1.{number}.jsonl").write_text("".join(json.dumps(line) + "\n" for line in lines))
        report = self.report(code=3).stdout
        self.assertRegex(report, r"n6/pocl:1 .* slow +\+1[23]\.\d % +\+1[12]\.\d %")
        self.assertIn("exclude: n6\n", report)
        self.assertNotIn("to confirm", report)
        self.report("--html", "page.html", code=3)
        page = (self.scratch.work / "page.html").read_text()
        self.assertEqual(page.count("<circle"), 8, "a dot a card")
        self.assertEqual(page.count('<circle class="bad"'), 1)
        (folder / "n6.pocl-1.3.jsonl").unlink()
        self.assertIn("4 sessions", self.report().stdout, "what is not whole decides nothing")

    def test_what_failed_on_a_card_is_its_finding(self):
        def crash(lines):
            lines[1]["status"], lines[1]["reason"] = "crash", "killed by SIGSEGV (11)"
            lines[1]["statistics"] = lines[1]["work"] = None
        self.write("n2", change=crash)
        self.assertRegex(self.report(code=1).stdout, r"n2/pocl:1 .* crash ")


if __name__ == "__main__":
    unittest.main()
