#!/usr/bin/env python3
"""Markdown tables of results/axes.md: for each axis, how long its values take, device by device.

usage: axis_table.py RESULT.json...     of the configs memory, queues, quality and workgroups

A cell is the time over that of the axis' first value in the same run, all else equal: 2 is twice as long."""

import json
import re
import sys

AXES = ("scene_memory", "film_memory", "queue", "dispatch", "pixel_filter", "rng", "build", "work_group")
SAID = ("spp", "size")


def outcome(record, first):
    if record["statistics"] is None:
        return record["status"]
    ns = record["statistics"]["median_ns"]
    text = f"{ns / 1e6:.4g} ms" if first is None else f"{ns / first:.3g}"
    overlap = record["work"].get("overlap")
    return text if overlap is None else f"{text} (overlap {100 * overlap:.0f} %)"


def series(cases, axis):
    """Lists of cases that differ in this axis alone, more than one in each."""
    groups = {}
    for record in cases:
        rest = tuple((key, value) for key, value in record["params"].items() if key != axis)
        groups.setdefault(rest, []).append(record)
    return [group for group in groups.values() if len(group) > 1]


def title(result, record, axis):
    device = next(d for d in result["devices"] if d["key"] == record["params"]["device"])
    usual = ("auto", "implicit", "in_order", "ndrange", "buffer", "jitter", "default")
    more = [f"{key} {value}" for key, value in record["params"].items()
            if key in AXES and key != axis and value not in usual]
    said = " ".join(f"{key} {record['params'][key]}" for key in SAID)
    return ", ".join([re.split("-(?:AMD|Intel)", device["name"])[0] if device["type"] == "CPU" else device["name"],
                      f"{record['params']['kernel']} {said}", *more])


def columns(results, axis):
    """Of each series: its title, and its cells by the axis' values."""
    for result in results:
        for group in series(result["cases"], axis):
            first = group[0]["statistics"] and group[0]["statistics"]["median_ns"]
            cells = {r["params"][axis]: outcome(r, first if i else None) for i, r in enumerate(group)}
            yield title(result, group[0], axis), cells


def main(files):
    results = []
    for file in files:
        with open(file, encoding="utf-8") as opened:
            results.append(json.load(opened))
    for axis in AXES:
        shown = list(columns(results, axis))
        values = list(dict.fromkeys(value for _, cells in shown for value in cells))
        if not shown:
            continue
        print(f"| {axis} | " + " | ".join(values) + " |")
        print("| --- |" + " ---: |" * len(values))
        for name, cells in shown:
            print(f"| {name} | " + " | ".join(cells.get(value, "") for value in values) + " |")
        print()


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    main(sys.argv[1:])
