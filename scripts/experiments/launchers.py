#!/usr/bin/env python3
"""What real launchers leave behind: runs ptbench behind each of those that are here (srun, mpirun) through good runs, two workers,
Ctrl-C, a driver that hangs and a queue, and looks for jobs and workers that stayed. Ends with 1 where one did.
usage: launchers.py PTBENCH [FAULT_LAYER]; with Slurm: slurm.sh launchers.py ..."""

import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time

LAUNCHERS = {"srun": ("srun -n1", "srun -n2"),
             "mpirun": ("mpirun --allow-run-as-root -n 1", "mpirun --allow-run-as-root --oversubscribe --stdin all -n 2")}
TINY = ("-d", "0", "--kernel", "pt", "--size", "64", "--path-length", "2", "--wg", "implicit", "--samples", "1", "--warmup", "0")


def workers():
    """Processes that have a nonce, or that did and are now waited for."""
    found = []
    for file in pathlib.Path("/proc").glob("[0-9]*/cmdline"):
        try:
            words = file.read_bytes().split(b"\0")
        except OSError:  # it has just ended
            continue
        if b"--nonce" in words:
            found.append(b" ".join(words).decode().strip())
    return found


def jobs():
    if not shutil.which("squeue"):
        return []
    return subprocess.run(["squeue", "-h"], capture_output=True, text=True, check=True).stdout.splitlines()


def left(patience_s=2):
    """What is still there; a controller hears of a job's end a moment later."""
    end = time.monotonic() + patience_s
    while (there := workers() + jobs()) and time.monotonic() < end:
        time.sleep(0.05)
    return there


def wait_until(happens):
    while not happens():
        time.sleep(0.05)


def trial(name, expected, ptbench, launcher, *words, says="", interrupted=False, **variables):
    with tempfile.TemporaryDirectory() as out:
        process = subprocess.Popen([ptbench, *TINY, *words, "--out", out, "--launcher", launcher], stderr=subprocess.PIPE,
                                   stdout=subprocess.DEVNULL, text=True, env={**os.environ, **variables})
        begin = time.monotonic()
        if interrupted:
            wait_until(lambda: process.poll() is not None or any("--device" in each for each in workers()))
            begin = time.monotonic()
            process.send_signal(signal.SIGINT)
        _, said = process.communicate(timeout=120)
        took_s = time.monotonic() - begin
    stayed = left()
    good = process.returncode == expected and says in said and not stayed
    last_words = said.strip().split("\n")[-1][-100:]
    print(f"{'good' if good else 'BAD '}  {launcher.split()[0]:7} {name:12} exit {process.returncode}  {took_s:5.2f} s  {last_words}")
    for each in stayed:
        print("      left:", each)
    return good


def trials(ptbench, layer, one, two):
    yield trial("good run", 0, ptbench, one, "--spp", "2")
    yield trial("two workers", 2, ptbench, two, "--spp", "2", says="found two workers")
    yield trial("Ctrl-C", 130, ptbench, one, "--spp", "100000000", "--max-total-time", "0", interrupted=True)
    if layer:
        yield trial("time-out", 1, ptbench, one, "--spp", "2", "--timeout", "3", OPENCL_LAYERS=layer, PTB_FAULT="hang call=clEnqueueNDRangeKernel")


def trial_in_a_queue(ptbench, one):
    """The one node is taken for a while."""
    with subprocess.Popen(["srun", "-n1", "--exclusive", "sleep", "6"]):
        wait_until(jobs)
        return trial("queue", 0, ptbench, one + " --exclusive", "--spp", "2", says="queued and waiting for resources")


def main():
    ptbench, layer = sys.argv[1], (sys.argv[2:] or [""])[0]
    good = [result for name, (one, two) in LAUNCHERS.items() if shutil.which(name) for result in trials(ptbench, layer, one, two)]
    if shutil.which("srun"):
        good.append(trial_in_a_queue(ptbench, LAUNCHERS["srun"][0]))
    if not good:
        sys.exit("neither srun nor mpirun is here")
    sys.exit(not all(good))


if __name__ == "__main__":
    main()
