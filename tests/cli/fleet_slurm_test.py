"""--fleet, of a run and of a picture, in a real Slurm of four virtual nodes (scripts/experiments/slurm.sh): good and bad ends, and
going on after them."""

import json
import os
import re
import shutil
import subprocess
import sys
import time
import unittest

from ptbench import BINARY, SOURCE, CliTest

sys.path.insert(0, str(SOURCE / "scripts/experiments"))
import fleet_cuts  # noqa: E402

TOOLS = ("slurmctld", "slurmd", "srun", "scancel", "squeue", "munged", "unshare")
SRUN = ("srun", "--no-kill", "--wait=0", "--kill-on-bad-exit=0")
# Eight cases of some 0.1 s.
SPP = [str(1000 + i) for i in range(8)]
PLAN = ("-d", "pocl:1", "--kernel", "pt", "--size", "32", "--spp", ",".join(SPP), "--path-length", "2", "--wg", "implicit",
        "--samples", "1", "--warmup", "0", "--timeout", "60", "--max-total-time", "0", "--fleet", "F", "-q")
# Some seconds of a core.
PICTURE = ("render", "-d", "pocl:1", "--kernel", "pt", "--size", "64", "--spp", "6000", "--path-length", "5", "-o", "x.pfm")
ALL_NODES = ("-N4", "--ntasks-per-node=1")
cluster = None
restarted = []  # nodes, after a power cut


def why_not():
    missing = [tool for tool in TOOLS if not shutil.which(tool)]
    if missing:
        reason = f"not installed: {', '.join(missing)}"
        if os.environ.get("PTB_STRICT"):
            raise AssertionError(reason)
        return reason
    if os.geteuid() != 0:
        return "a Slurm of one's own needs root"
    tried = subprocess.run(["unshare", "--uts", "--mount", "hostname", "n1"], capture_output=True, text=True, check=False)
    return "" if tried.returncode == 0 else f"no namespaces here: {tried.stderr.strip()}"


def setUpModule():
    global cluster
    reason = why_not()
    if reason:
        raise unittest.SkipTest(reason)
    cluster = subprocess.Popen([SOURCE / "scripts/experiments/slurm.sh", "--nodes", "4", "bash", "-c", "echo $SLURM_CONF; exec cat"],
                               stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    os.environ["SLURM_CONF"] = cluster.stdout.readline().strip()


def tearDownModule():
    for node in restarted:
        node.terminate()
        node.wait()
    if cluster:
        cluster.communicate()


class Slurm(CliTest):
    def setUp(self):
        super().setUp()
        self.addCleanup(self.end_jobs)

    def end_jobs(self):
        subprocess.run(["scancel", "--user", "root"], check=False)
        self.wait_until(lambda: not self.jobs(), "jobs stayed")

    def start(self, *words, plan=PLAN):
        return subprocess.Popen([*SRUN, *words, BINARY, *plan], cwd=self.scratch.work, env=self.scratch.environment(),
                                stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def srun(self, *words, plan=PLAN):
        process = self.start(*words, plan=plan)
        out, err = process.communicate(timeout=60)
        return process.returncode, out, err

    def wait_until(self, happens, otherwise, patience_s=60):
        deadline = time.monotonic() + patience_s
        while not happens():
            self.assertLess(time.monotonic(), deadline, otherwise)
            time.sleep(0.05)

    @staticmethod
    def jobs():
        return subprocess.run(["squeue", "-h"], capture_output=True, text=True, check=True).stdout

    def assert_nothing_is_left(self):
        self.wait_until(lambda: not self.jobs(), "a job stayed in the queue")
        self.wait_until(lambda: not self.scratch.processes(), "processes stayed")
        shutil.rmtree(self.scratch.root / "tmp")  # what killed processes leave
        (self.scratch.root / "tmp").mkdir()

    def give_power(self, node):
        restarted.append(subprocess.Popen([SOURCE / "scripts/experiments/slurm_node.sh", node],
                                          stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL))
        idle = ["sinfo", "-h", "-n", node, "-t", "idle", "-o", "%D"]
        self.wait_until(lambda: subprocess.run(idle, capture_output=True, text=True, check=True).stdout == "1\n",
                        f"{node} does not come back")


class Run(Slurm):
    def records(self, node):
        """Those that are whole, by SPP."""
        file = self.scratch.work / f"F/nodes/{node}.jsonl"
        lines = file.read_text().split("\n")[1:-1] if file.exists() else []
        return {record["params"]["spp"]: record for record in map(json.loads, lines) if record["status"] != "skipped"}

    def all_records(self):
        return {node: self.records(node) for node in ("n1", "n2", "n3", "n4")}

    def assert_whole(self, *before):
        """Every case once, and none anew that was there before."""
        result = self.scratch.result("F")
        self.assertEqual([(case["params"]["device"], str(case["params"]["spp"])) for case in result["cases"]],
                         [(f"n{n}/pocl:1", spp) for n in range(1, 5) for spp in SPP])
        after = self.all_records()
        for records in before:
            for node, kept in records.items():
                for spp, record in kept.items():
                    self.assertEqual(after[node][spp], record, f"{node} measured {spp} again")

    def test_after_scancel_and_a_power_cut_it_goes_on_where_it_was(self):
        cancelled = self.start(*ALL_NODES)
        self.wait_until(lambda: all(len(records) >= 2 for records in self.all_records().values()), "nothing is measured")
        subprocess.run(["scancel", "--user", "root"], check=True)
        cancelled.communicate(timeout=60)
        self.assert_nothing_is_left()
        kept = self.all_records()

        cut = self.start(*ALL_NODES)
        self.wait_until(lambda: len(self.records("n2")) > len(kept["n2"]), "n2 does not go on")
        fleet_cuts.cut_power("n2")
        kept_by_n2 = {"n2": self.records("n2")}
        cut.communicate(timeout=60)
        self.assert_nothing_is_left()
        report = self.run_ok("report", "F", code=6).stdout
        self.assertIn("3 of 4 nodes", report)
        self.assertIn("missing: n2\n", report)
        self.assertIn("srun -N1 -w n2 ", report)

        self.give_power("n2")
        code, out, err = self.srun("-N1", "-w", "n2")
        self.assertEqual(code, 0, err)
        self.assertIn("4 of 4 nodes", out)
        self.assert_nothing_is_left()
        self.assert_whole(kept, kept_by_n2)

    def small_ptbench(self):
        """A program of that name that measures one small case instead of the config `cards`."""
        program = self.scratch.root / "bin/ptbench"
        program.parent.mkdir()
        small = [word if word != ",".join(SPP) else "1" for word in PLAN if word not in ("--fleet", "F")]
        program.write_text(f"#!/usr/bin/env python3\nimport os, sys\nwords = sys.argv[1:]\nif '--config' in words:\n"
                           f"    at = words.index('--config')\n    words[at:at + 2] = {small!r}\n"
                           f"os.execv({BINARY!r}, [{BINARY!r}, *words])\n")
        program.chmod(0o755)
        return program

    def test_the_commands_of_the_document(self):
        text = (SOURCE / "bench/fleet/README.md").read_text()
        path = f"{self.small_ptbench().parent}:{os.environ['PATH']}"
        ran = []
        for line in re.search(r"```sh\n(.*?)```", text, re.S)[1].splitlines():
            name = line.split()[0]
            if name in ("flux", "for") or not shutil.which(name, path=path):
                continue  # ssh and flux need more than this machine
            line = line.replace("mpirun -N 1 --host n1,n2", "mpirun --allow-run-as-root -n 1")
            run = subprocess.run(["bash", "-c", line], cwd=self.scratch.work, env=self.scratch.environment(PATH=path), text=True,
                                 capture_output=True, check=False, timeout=60)
            self.assertEqual(run.returncode, 0, f"{line}\n{run.stdout}{run.stderr}")
            ran.append(name)
        self.assertLessEqual({"srun", "sbatch", "ptbench"}, set(ran))
        hosts = {host["node"] for host in json.loads((self.scratch.work / "fleet/result.json").read_text())["hosts"]}
        self.assertLessEqual({"n1", "n2", "n3", "n4"}, hosts)
        self.assert_nothing_is_left()

    def test_two_tasks_a_node_by_mistake_measure_once(self):
        code, out, err = self.srun("-N4", "--ntasks-per-node=2")
        self.assertEqual(code, 2, err)
        for node in ("n1", "n2", "n3", "n4"):
            self.assertIn(f"--fleet: {node} is being measured by ", err)
        self.assertIn("4 of 4 nodes", out)
        self.assertIn("expected", self.scratch.result("F")["run"])
        self.assert_nothing_is_left()
        self.assert_whole()


class Picture(Slurm):
    plan = (*PICTURE, "--fleet", "F")

    def setUp(self):
        super().setUp()
        self.run_ok(*PICTURE, "-q")
        self.picture = self.scratch.work / "x.pfm"
        self.alone = self.picture.read_bytes()
        self.picture.unlink()

    def claims(self):
        """Nodes that claimed parts, a word a chunk."""
        return [file.read_text().strip() for file in (self.scratch.work / "F/chunks").glob("[0-9]*")]

    def assert_whole(self):
        self.assert_nothing_is_left()
        self.assertEqual(self.picture.read_bytes(), self.alone)
        ranges = json.loads((self.scratch.work / "x.pfm.ranges.json").read_text())
        return {device["device"] for device in ranges["devices"]}

    def test_after_scancel_and_a_power_cut_it_goes_on_where_it_was(self):
        cancelled = self.start(*ALL_NODES, plan=self.plan)
        self.wait_until(lambda: set(self.claims()) == {"n1", "n2", "n3", "n4"}, "a node does not begin")
        subprocess.run(["scancel", "--user", "root"], check=True)
        cancelled.communicate(timeout=60)
        self.assert_nothing_is_left()
        self.assertFalse(self.picture.exists())

        cut = self.start(*ALL_NODES, plan=self.plan)
        self.wait_until(lambda: "n2" in self.claims(), "n2 does not go on")
        fleet_cuts.cut_power("n2")
        _, said = cut.communicate(timeout=60)
        self.assert_nothing_is_left()
        self.assertRegex(said, r"% of the picture are in F: the rest is of n2; who ends last writes it\n")
        self.assertFalse(self.picture.exists())

        self.give_power("n2")
        code, _, said = self.srun("-N1", "-w", "n2", plan=self.plan)
        self.assertEqual(code, 0, said)
        self.assertRegex(said, r"n2: made [\d.]+ % of the picture\nwritten: x.pfm ")
        self.assertEqual(self.assert_whole(), {f"n{n}/pocl:1" for n in range(1, 5)})

    def test_two_tasks_a_node_by_mistake_make_it_once(self):
        code, _, said = self.srun("-N4", "--ntasks-per-node=2", plan=self.plan)
        self.assertEqual(code, 2, said)
        for node in ("n1", "n2", "n3", "n4"):
            self.assertEqual(said.count(f"error: --fleet: another process of {node} makes its part of the picture"), 1, said)
        self.assert_whole()


if __name__ == "__main__":
    unittest.main()
