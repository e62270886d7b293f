#!/usr/bin/env python3
"""How kernels scale over the cores of a CPU under PoCL: medians of `ptbench` with 1, 2, 4, ... threads, in turn.

usage: scaling.py PTBENCH [ROUNDS]      3 rounds; cores as this process may use them

A column of threads has the time in ms and the share of linear scaling; PoCL 5 and newer take the number of threads from
POCL_CPU_MAX_CU_COUNT, older ones from POCL_MAX_PTHREAD_COUNT.
"""

import json
import os
import statistics
import subprocess
import sys
import tempfile

WORK = (("thesis", 1, 128, 10), ("pt", 16, 256, 10), ("pt", 16, 256, 100), ("pt", 32, 256, 10), ("pt", 32, 256, 100),
        ("pt", 32, 1024, 100), ("pt_nee", 32, 256, 100))


def time_ms(ptbench, threads, kernel, lanes, size, spp):
    """Median of the samples, or NaN where the case has no time."""
    count = str(threads)
    environment = {**os.environ, "POCL_MAX_PTHREAD_COUNT": count, "POCL_CPU_MAX_CU_COUNT": count}
    with tempfile.TemporaryDirectory() as folder:
        command = [ptbench, "-q", "-d", "cpu", "--kernel", kernel, "--lanes", str(lanes), "--size", str(size), "--spp", str(spp),
                   "--wg", "64", "--no-tune", "--max-time", "2", "--out", os.path.join(folder, "run"), "--json", "-"]
        ran = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    statistics_of = json.loads(ran.stdout)["cases"][0]["statistics"] if ran.stdout else None
    return statistics_of["median_ns"] / 1e6 if statistics_of else float("nan")


def counts():
    """1, 2, 4, ... up to the cores."""
    cores = len(os.sched_getaffinity(0))
    return [n for n in (1, 2, 4, 8, 16, 32, 64, 128) if n < cores] + [cores]


def main(argv):
    if len(argv) not in (2, 3):
        sys.exit(__doc__)
    rounds = int(argv[2]) if len(argv) == 3 else 3
    threads = counts()
    print("| kernel, lanes, size, SPP | " + " | ".join(f"{n} thread{'s' if n > 1 else ''}" for n in threads) + " |")
    print("| --- |" + " ---: |" * len(threads))
    for work in WORK:
        times = {n: [] for n in threads}
        for _ in range(rounds):
            for n in threads:
                times[n].append(time_ms(argv[1], n, *work))
        medians = [statistics.median(times[n]) for n in threads]
        cells = (f"{ms:.4g} ms, {100 * medians[0] / (n * ms):.0f} %" for n, ms in zip(threads, medians))
        kernel, lanes, size, spp = work
        print(f"| {kernel}, {lanes}, {size}x{size}, {spp} | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main(sys.argv)
