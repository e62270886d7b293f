#!/usr/bin/env python3
"""How many rows that are over 5 % off are called unstable, and how many that are right, on this machine: measures
alternately alone and beside a compiler that runs over and over on one CPU.

A row is right if it is within 5 % of the shortest median of its case in all rounds. What else runs here is in the rows
"alone", too: only a quiet machine shows what they are by themselves.

usage: unstable.py PTBENCH ROUNDS [OPTION OF ptbench...]
"""

import collections
import contextlib
import json
import os
import signal
import subprocess
import sys
import tempfile

LIMIT = 0.05
SOURCE = "#include <regex>\nint main() { return std::regex_match(\"a\", std::regex(\"a\")); }\n"


@contextlib.contextmanager
def compiling():
    """A compiler on the first CPU, in a process group of its own, until the end of the block."""
    loop = "while :; do printf '%s' \"$1\" | c++ -O2 -x c++ -c -o /dev/null -; done"
    with subprocess.Popen(["taskset", "-c", str(min(os.sched_getaffinity(0))), "sh", "-c", loop, "sh", SOURCE],
                          start_new_session=True) as process:
        try:
            yield
        finally:
            os.killpg(process.pid, signal.SIGKILL)


def rows(ptbench, options):
    """Of one run: {case: (median, status)}."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([ptbench, "-q", *options, "--out", folder, "--json", folder + "/rows.json"], check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        with open(folder + "/rows.json", encoding="utf-8") as file:
            cases = json.load(file)["cases"]
    return {json.dumps(case["params"]): (case["statistics"]["median_ns"], case["status"])
            for case in cases if case["statistics"]}


def main(ptbench, rounds, *options):
    found = collections.defaultdict(list)
    for _ in range(int(rounds)):
        found["alone"].append(rows(ptbench, options))
        with compiling():
            found["beside a compiler"].append(rows(ptbench, options))
    shortest = {}
    for each in [run for runs in found.values() for run in runs]:
        for case, (median, _) in each.items():
            shortest[case] = min(median, shortest.get(case, median))
    print("| measured | wrong rows | unstable | right rows | unstable |\n| --- | ---: | ---: | ---: | ---: |")
    for how, runs in found.items():
        count = collections.Counter((median > (1 + LIMIT) * shortest[case], status == "unstable")
                                    for run in runs for case, (median, status) in run.items())
        print(f"| {how} | {count[True, True] + count[True, False]} | {count[True, True]} | "
              f"{count[False, True] + count[False, False]} | {count[False, True]} |")


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
