#!/usr/bin/env python3
"""Time and memory that the report of a large fleet takes: 125 nodes of 8 cards, 20 cases each, made of one small fleet's journal.
usage: fleet_size.py [--binary build/release/bin/ptbench] [--nodes 125] [--samples 30] [--keep FOLDER]"""

import argparse
import copy
import json
import math
import os
import pathlib
import random
import subprocess
import tempfile
import time

CARDS, CASES = 8, 20


def first_node(binary, folder):
    """The journal of a node that measured one device, on PoCL."""
    spp = ",".join(str(i + 1) for i in range(CASES))
    words = ["-d", "pocl:0", "--kernel", "pt", "--size", "16", "--spp", spp, "--path-length", "2", "--wg", "implicit", "--samples", "1",
             "--warmup", "0", "--fleet", folder, "-q"]
    subprocess.run([binary, *words], env={**os.environ, "SLURMD_NODENAME": "n000"}, check=True, stdout=subprocess.DEVNULL)
    lines = [json.loads(line) for line in (folder / "nodes/n000.jsonl").read_text().splitlines()]
    (folder / "nodes/n000.jsonl").unlink()
    return lines[0], lines[1:]


def card(record, key, samples, chance):
    record = copy.deepcopy(record)
    record["params"]["device"] = key
    time_ns = 1e8 * math.exp(chance.gauss(0, 0.01))
    record["statistics"]["median_ns"] = time_ns
    sample = record["samples"][0]
    record["samples"] = [{**sample, "kernel_ns": int(time_ns * math.exp(chance.gauss(0, 0.01)))} for _ in range(samples)]
    record["gpu"] = {"clock_mhz": 1980, "memory_clock_mhz": 2619, "temperature_c": 55, "power_w": 650.5, "throttle": ["power cap"]}
    return record


def write_node(folder, name, header, records, samples, chance):
    header = copy.deepcopy(header)
    header["host"]["node"] = header["host"]["hostname"] = name
    (device,) = header["devices"]
    header["devices"] = [{**device, "key": f"nvidia:{i}", "uuid": f"{chance.getrandbits(128):032x}", "pci": f"0000:{16 * i:02x}:00.0",
                          "serial": str(chance.getrandbits(40))} for i in range(CARDS)]
    with open(folder / f"nodes/{name}.jsonl", "w", encoding="utf-8") as out:
        out.write(json.dumps(header, separators=(",", ":")) + "\n")
        for i in range(CARDS):
            for record in records:
                out.write(json.dumps(card(record, f"nvidia:{i}", samples, chance), separators=(",", ":")) + "\n")


def measured(command):
    """Seconds and peak memory of a process in MB, and what it printed."""
    begin = time.monotonic()
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    out = process.stdout.read()
    _, _, usage = os.wait4(process.pid, 0)
    return time.monotonic() - begin, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024, out


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--binary", default="build/release/bin/ptbench")
    parser.add_argument("--nodes", type=int, default=125)
    parser.add_argument("--samples", type=int, default=30)
    parser.add_argument("--keep")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="ptbench-fleet-") as scratch:
        folder = pathlib.Path(arguments.keep or scratch) / "fleet"
        header, records = first_node(arguments.binary, folder)
        chance = random.Random(1)
        for i in range(arguments.nodes):
            write_node(folder, f"n{i:03}", header, records, arguments.samples, chance)
        journals = sum(file.stat().st_size for file in (folder / "nodes").iterdir())
        page = folder / "fleet.html"
        for words in (["report", folder], ["report", folder, "--html", page]):
            wall_s, cpu_s, mb, out = measured([arguments.binary, *words])
            print(f"{' '.join(map(str, words[2:])) or 'text'}: {wall_s:.1f} s, {cpu_s:.1f} s of CPU time, {mb:.0f} MB, {len(out.splitlines())} lines")
        print(f"{arguments.nodes * CARDS} cards, {CASES} cases: journals {journals / 1e6:.0f} MB, result.json "
              f"{(folder / 'result.json').stat().st_size / 1e6:.0f} MB, page {page.stat().st_size / 1e6:.2f} MB")


if __name__ == "__main__":
    main()
