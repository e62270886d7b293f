#!/usr/bin/env python3
"""Cuts the power of a random node of four at a random moment of a fleet's measuring, and goes on; so many times. After each: nothing is
lost but cases in progress, nothing is measured twice, the queue is empty, and the result file is the same bytes whoever merges.
usage: slurm.sh --nodes 4 fleet_cuts.py PTBENCH [CUTS] [SEED]"""

import json
import os
import pathlib
import random
import re
import signal
import subprocess
import sys
import tempfile
import time

import moments

HERE = pathlib.Path(__file__).resolve().parent
NODES = ("n1", "n2", "n3", "n4")
SPP = [str(1000 + i) for i in range(8)]
PLAN = ("-d", "cpu", "--kernel", "pt", "--size", "32", "--spp", ",".join(SPP), "--path-length", "2", "--wg", "implicit", "--samples", "1",
        "--warmup", "0", "--max-total-time", "0")


class Breach(Exception):
    """What must never happen."""


def ensure(condition, what):
    if not condition:
        raise Breach(what)


def namespace(pid):
    try:
        return os.readlink(f"/proc/{pid}/ns/uts")
    except OSError:  # it has just ended
        return None


def daemon_of(node):
    for file in pathlib.Path("/proc").glob("[0-9]*/cmdline"):
        try:
            words = file.read_bytes().split(b"\0")
            ours = f"SLURM_CONF={os.environ['SLURM_CONF']}".encode() in (file.parent / "environ").read_bytes()
        except OSError:
            continue
        if ours and words[:4] == [b"slurmd", b"-D", b"-N", node.encode()]:
            return file.parent.name
    return None


def wait_until(happens, otherwise, patience_s=120):
    deadline = time.monotonic() + patience_s
    while not happens():
        ensure(time.monotonic() < deadline, otherwise)
        time.sleep(0.1)


def said_by(*words):
    return subprocess.run(words, capture_output=True, text=True, check=True).stdout


def cut_power(node):
    """SIGKILL to the node's slurmd, and to all that runs beside it under its hostname."""
    home = namespace(daemon_of(node))
    ensure(home, f"{node} has no slurmd")
    for each in pathlib.Path("/proc").glob("[0-9]*"):
        if namespace(each.name) == home:
            os.kill(int(each.name), signal.SIGKILL)
    subprocess.run(["scontrol", "update", f"nodename={node}", "state=down", "reason=power"], check=True)


class Fleet:
    def __init__(self, binary, folder):
        self.binary, self.folder = str(pathlib.Path(binary).resolve()), pathlib.Path(folder)

    def start(self, *words):
        environment = {**os.environ, "TMPDIR": str(self.folder)}
        return subprocess.Popen(["srun", "--no-kill", "--wait=0", "--kill-on-bad-exit=0", "--ntasks-per-node=1", *words, self.binary,
                                 *PLAN, "--fleet", "F"], cwd=self.folder, env=environment, text=True, stdin=subprocess.DEVNULL,
                                stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)

    def records(self):
        """Whole records by node and case, as text."""
        found = {}
        for node in NODES:
            file = self.folder / f"F/nodes/{node}.jsonl"
            for line in file.read_text().split("\n")[1:-1] if file.exists() else []:
                record = json.loads(line)
                if record["status"] != "skipped":
                    key = node, json.dumps(record["params"], sort_keys=True)
                    ensure(key not in found, f"two records of {key}")
                    found[key] = record
        return found

    def done(self):
        return len(self.records())

    def merged(self):
        subprocess.run([self.binary, "report", "F"], cwd=self.folder, stdout=subprocess.DEVNULL, check=True)
        return (self.folder / "F/result.json").read_bytes()


def one_cut(binary, chance, ends, daemons):
    """Records before and after, and cases whose end was printed."""
    with tempfile.TemporaryDirectory(prefix="ptbench-cut-") as scratch:
        fleet = Fleet(binary, scratch)
        run = fleet.start("-N4")
        moments.wait_for_moment(run, fleet.done, moments.any_moment(chance, ends))
        node = chance.choice(NODES)
        cut_power(node)
        _, said = run.communicate(timeout=120)
        wait_until(lambda: not said_by("squeue", "-h"), "a job stayed in the queue")
        before = fleet.records()
        ensure(len(re.findall(r"^\[\d+/\d+\] ", said, re.M)) <= len(before), "a case whose end was printed is not in a journal")
        daemons.append(subprocess.Popen([HERE / "slurm_node.sh", node], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL))
        wait_until(lambda: said_by("sinfo", "-h", "-t", "idle", "-o", "%D") == "4\n", f"{node} does not come back")
        again = fleet.start("-N4")
        _, said = again.communicate(timeout=120)
        ensure(again.returncode == 0, f"going on ends with {again.returncode}: {said}")
        after = fleet.records()
        ensure(all(after[key] == record for key, record in before.items()), "a record was measured twice")
        live = (fleet.folder / "F/result.json").read_bytes()
        ensure(len(json.loads(live)["cases"]) == len(after), "the result file has not every record")
        ensure(fleet.merged() == live, "another merge has other bytes")
        return len(before), len(after)


def main():
    binary, cuts, seed = sys.argv[1], int((sys.argv[2:] or ["50"])[0]), int((sys.argv[3:] or ["1"])[0])
    chance = random.Random(seed)
    daemons = []
    with tempfile.TemporaryDirectory(prefix="ptbench-cut-") as scratch:
        fleet = Fleet(binary, scratch)
        whole = fleet.start("-N4")
        ends = moments.ends_of(whole, fleet.done)
        ensure(whole.returncode == 0, "the undisturbed run failed")
        planned = fleet.done()
    kept = measured = 0
    for _ in range(cuts):
        before, after = one_cut(binary, chance, ends, daemons)
        ensure(after == planned, f"{after} records of {planned}")
        kept, measured = kept + before, measured + after - before
    for daemon in daemons:
        daemon.terminate()
    print(f"{cuts} power cuts in fleets of {planned} cases ({ends[-1]:.1f} s undisturbed): {kept} records kept, {measured} measured after; "
          "no breach")


if __name__ == "__main__":
    try:
        main()
    except Breach as breach:
        sys.exit(f"breach: {breach}")
