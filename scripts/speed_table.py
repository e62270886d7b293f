#!/usr/bin/env python3
"""How many times faster `pt` is than `thesis`, device by device, from a result file of the config `speed`.

usage: speed_table.py RESULT.json
"""

import json
import sys


def rates(record):
    """Samples and segments a second, in millions."""
    median_ns = record["statistics"]["median_ns"]
    work = record["work"]
    return [1e3 * work[name] / median_ns for name in ("samples", "segments")]


def rows(cases):
    base = {}
    for record in cases:
        p = record["params"]
        key = tuple(p[axis] for axis in ("device", "scene", "size", "spp", "path_length", "work_group"))
        if record["status"] != "ok":
            yield [*key[:4], p["kernel"], p["lanes"], record["status"], record["reason"], "", "", ""]
            continue
        speed = rates(record)
        if p["kernel"] == "thesis":
            base[key] = speed
        of_thesis = [f"{ours / theirs:.2f}" for ours, theirs in zip(speed, base[key])] if key in base else ["-", "-"]
        per_sample = record["work"]["segments"] / record["work"]["samples"]
        yield [*key[:4], p["kernel"], record["work"]["lanes"], f"{speed[0]:.4g}", f"{speed[1]:.4g}",
               f"{per_sample:.3f}", *of_thesis]


def main(argv):
    if len(argv) != 2:
        sys.exit(__doc__)
    with open(argv[1], encoding="utf-8") as file:
        result = json.load(file)
    print("| device | scene | size | SPP | kernel | lanes | Msamples/s | Msegments/s | segments a sample "
          "| samples/s of thesis' | segments/s of thesis' |")
    print("| --- | --- | --- | ---: | --- | ---: | ---: | ---: | ---: | ---: | ---: |")
    for row in rows(result["cases"]):
        print("| " + " | ".join(map(str, row)) + " |")


if __name__ == "__main__":
    main(sys.argv)
