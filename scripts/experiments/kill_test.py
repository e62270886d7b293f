#!/usr/bin/env python3
"""Kills ptbench, or its worker, with SIGKILL at random moments, and goes on with --resume.

After each kill: the journal parses; it has every case whose end was printed; the resumed run measures what is missing
and nothing else; every planned case has one record; no process is left. Prints a table; any breach ends it with code 1.

usage: kill_test.py [--binary build/release/bin/ptbench] [--kills 50] [--seed 1]
"""

import argparse
import collections
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

# 16 cases on PoCL's two devices, of some 0.2 s each.
PLAN = ("-d", "cpu", "--kernel", "pt", "--size", "64", "--spp", "150,200,250,300", "--path-length", "5", "--wg",
        "8,16", "--max-time", "0.3", "--timeout", "60")
VICTIMS = ("coordinator", "worker")


class Breach(Exception):
    """What must never happen."""


def ensure(condition, what):
    if not condition:
        raise Breach(what)


def children(pid, *words):
    """Processes started by `pid` whose command line has all the words."""
    found = []
    for folder in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            parent = int((folder / "stat").read_text().rpartition(")")[2].split()[1])
            command = (folder / "cmdline").read_text().split("\0")
        except OSError:
            continue  # it has just ended
        if parent == pid and all(word in command for word in words):
            found.append(int(folder.name))
    return found


def alive(pid):
    try:
        return (pathlib.Path("/proc") / str(pid) / "stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def key(record):
    return json.dumps(record["params"], sort_keys=True)


def read_journal(file):
    """The records; a last line that was cut short is none."""
    lines = file.read_text().split("\n")
    json.loads(lines[0])
    return [json.loads(line) for line in lines[1:-1]]


def printed(text):
    """How many cases were said to have ended."""
    return len(re.findall(r"^\[\d+/\d+\] ", text, re.M))


class Trial:
    """Runs in a folder of their own."""

    def __init__(self, binary, folder):
        self.binary, self.folder = str(pathlib.Path(binary).resolve()), pathlib.Path(folder)
        self.journal = self.folder / "out/journal.jsonl"
        (self.folder / "tmp").mkdir()

    def start(self, *words):
        environment = {"POCL_DEVICES": "pthread basic", **os.environ, "TMPDIR": str(self.folder / "tmp")}
        with open(self.folder / "stderr", "w", encoding="utf-8") as stderr:
            return subprocess.Popen([self.binary, *words], cwd=self.folder, env=environment,
                                    stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=stderr)

    def stderr(self):
        return (self.folder / "stderr").read_text()

    def done(self):
        """Cases whose end was printed so far."""
        return printed(self.stderr())

    def whole_run(self):
        """When each case of a run that nobody disturbs was done, in seconds, and the cases."""
        process = self.start(*PLAN, "--out", "out")
        ends = moments.ends_of(process, self.done)
        ensure(process.returncode == 0, f"the undisturbed run ends with {process.returncode}: {self.stderr()}")
        return ends, [key(record) for record in read_journal(self.journal)]

    def kill(self, victim, moment):
        """Starts a run and kills; False if there was nothing to kill any more. The run has ended then."""
        process = self.start(*PLAN, "--out", "out")
        moments.wait_for_moment(process, self.done, moment)
        workers = children(process.pid, "worker")
        targets = [process.pid] if victim == "coordinator" else children(process.pid, "worker", "--device")[:1]
        hit = process.poll() is None and bool(targets)
        for pid in targets if hit else []:
            os.kill(pid, signal.SIGKILL)
        code = process.wait()
        if hit and victim == "coordinator":
            ensure(code == -signal.SIGKILL, f"killed, but ended with {code}")
        self.wait_for_end_of(workers)
        return hit

    def wait_for_end_of(self, workers):
        deadline = time.monotonic() + 10
        while any(map(alive, workers)):
            ensure(time.monotonic() < deadline, f"workers outlive their coordinator: {workers}")
            time.sleep(0.05)

    def check_journal(self):
        """The records that are safe."""
        records = read_journal(self.journal)
        ensure(self.done() <= len(records), "a case whose end was printed is not in the journal")
        return records

    def resume(self, planned, kept):
        """Goes on to the end; `kept` are the journal's records."""
        code = self.start("--resume", "out/journal.jsonl").wait()
        result = json.loads((self.folder / "out/result.json").read_text())
        ensure([key(record) for record in result["cases"]] == planned, "not one record for each planned case")
        statuses = collections.Counter(record["status"] for record in result["cases"])
        ensure(set(statuses) <= {"ok", "unstable", "crash"} and statuses["crash"] <= 1, f"statuses {dict(statuses)}")
        ensure(code == min(statuses["crash"], 1), f"the resumed run ends with {code}: {self.stderr()}")
        before = {key(record): record for record in kept}
        ensure(all(record == before.get(key(record), record) for record in result["cases"]), "a record has changed")
        measured = self.done()
        ensure(measured == len(planned) - len(kept), f"{measured} cases measured, {len(planned) - len(kept)} missing")
        ensure(sorted(map(key, read_journal(self.journal))) == sorted(planned), "the journal is not whole")
        return statuses["crash"], measured


def one_kill(binary, victim, moment, planned):
    """What came of it: cases kept, measured again, and records of crashes; None where nothing was hit or written."""
    with tempfile.TemporaryDirectory(prefix="ptbench-kill-") as folder:
        trial = Trial(binary, folder)
        if not trial.kill(victim, moment) or not trial.journal.exists():
            ensure(trial.journal.exists() or trial.done() == 0, "cases without a journal")
            return None
        kept = trial.check_journal()
        crashes, measured = trial.resume(planned, kept)
        ensure(victim == "worker" or crashes == 0, "a worker crashed by itself")
        return len(kept), measured, crashes


def reference(binary):
    with tempfile.TemporaryDirectory(prefix="ptbench-kill-") as folder:
        return Trial(binary, folder).whole_run()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--binary", default="build/release/bin/ptbench")
    parser.add_argument("--kills", type=int, default=50)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    chance = random.Random(arguments.seed)
    ends, planned = reference(arguments.binary)
    print(f"{len(planned)} cases, {ends[-1]:.1f} s undisturbed; {arguments.kills} kills, seed {arguments.seed}\n")
    rows = {victim: collections.Counter() for victim in VICTIMS}
    done = 0
    while done < arguments.kills:
        victim = VICTIMS[done % 2]
        outcome = one_kill(arguments.binary, victim, moments.any_moment(chance, ends), planned)
        if outcome is None:
            rows[victim]["nothing to kill, or no journal yet"] += 1
            continue
        done += 1
        row = rows[victim]
        row["kills"] += 1
        for name, value in zip(("kept", "measured after", "crash records"), outcome):
            row[name] += value
    columns = ("kills", "kept", "measured after", "crash records", "nothing to kill, or no journal yet")
    print(f"| killed | {' | '.join(columns)} |\n| --- |{' ---: |' * len(columns)}")
    for victim, row in rows.items():
        print(f"| {victim} | {' | '.join(str(row[name]) for name in columns)} |")
    print("\nno breach")


if __name__ == "__main__":
    try:
        main()
    except Breach as breach:
        sys.exit(f"breach: {breach}")
