#!/usr/bin/env python3
"""Makes docs/thesis.md again: runs the commands that stand in it, and puts what came of them under each.

usage: thesis.py PTBENCH [-d DEVICE] [--document FILE]

A command runs once, however often it stands there, on DEVICE in place of the one it names. What was made lies between
`<!-- made: KIND -->` and `<!-- end -->`; its pictures in ../results/pictures, as seen from the document."""

import argparse
import csv
import json
import math
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[1]
PICTURES = "../results/pictures"
STEP = re.compile(r"```sh\n(?P<commands>(?:(?!```).*\n)+)```\n|<!-- made: (?P<kind>\w+) -->\n(?P<made>(?s:.*?))<!-- end -->")


def table(head, rows, words=1):
    """Markdown, whose first columns are of words, the others of numbers."""
    lines = [head, ["---"] * words + ["---:"] * (len(head) - words), *rows]
    return "".join(f"| {' | '.join(map(str, line))} |\n" for line in lines)


def flags(command):
    """Of `ptbench render`: values by flags, axes by their names."""
    words = shlex.split(command)[2:]
    named = dict(zip(words[::2], words[1::2], strict=True))
    axes = [words[i + 1] for i, word in enumerate(words) if word == "-a"]
    named.pop("-a", None)
    return named | dict(axis.split("=") for axis in axes)


def told_apart(commands):
    """What each picture is: the values that others beside it do not share."""
    every = [flags(command) for command in commands]
    return [", ".join(f"{name.removeprefix('--')} {value}" for name, value in each.items()
                      if name != "-o" and any(other.get(name) != value for other in every)) for each in every]


def pictures_of(commands):
    """Files that are rendered."""
    return [flags(command)["-o"] for command in commands if command.startswith("ptbench render")]


class Made:
    """Runs commands in a scratch folder, each once."""

    def __init__(self, ptbench, device, folder, pictures):
        self.ptbench, self.device, self.folder, self.pictures = pathlib.Path(ptbench).resolve(), device, pathlib.Path(folder), pictures
        self.said = {}
        self.begin = time.monotonic()

    def run(self, command):
        words = shlex.split(command)[1:]
        if self.device:
            words[words.index("-d") + 1] = self.device
        print(command, file=sys.stderr, flush=True)
        ran = subprocess.run([self.ptbench, *words], cwd=self.folder, check=False, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                             text=True)
        if ran.returncode:
            sys.exit(f"{command}\n{ran.stderr}exit code {ran.returncode}")
        self.said[command] = ran.stderr

    def run_all(self, commands):
        for command in commands:
            if command not in self.said:
                self.run(command)

    def output(self, command, name):
        words = shlex.split(command)
        return (self.folder / words[words.index("--out") + 1] / name).read_text(encoding="utf-8")

    def rows(self, command):
        return list(csv.DictReader(self.output(command, "result.csv").splitlines()))


def device_line(made, _commands):
    """When, by what and on what: of the first run of the document."""
    result = json.loads(next(made.output(command, "result.json") for command in made.said if "--out" in command))
    run, device = result["run"], result["devices"][0]
    dirty = ", changed" if run["git_dirty"] else ""
    load = result["host"]["load_1min"]
    busy = "" if load is None else f"; before, the machine's load was {load:.1f}"
    seconds = time.monotonic() - made.begin
    return (f"Made on {run['started_at'][:10]} by ptbench {run['tool_version']} ({run['git_sha'][:12]}{dirty}) on "
            f"{device['name']}, {device['compute_units']} compute units, driver {device['driver_version']}, in {seconds:.0f} s{busy}.\n")


def pictures(made, commands):
    said = [re.search(r"\((.*)\)", made.said[command])[1] for command in commands]
    files = pictures_of(commands)
    made.pictures.mkdir(parents=True, exist_ok=True)
    for file in files:
        shutil.copy(made.folder / file, made.pictures / file)
    titles = told_apart(commands)
    shown = [f"![{title}]({PICTURES}/{file})" for title, file in zip(titles, files)]
    return table(titles, [shown, said], words=len(titles))


def number(text, digits=3):
    """Of a CSV cell, which may be empty."""
    return "-" if text == "" else f"{float(text):.{digits}g}" if abs(float(text)) < 10 ** digits else f"{float(text):.0f}"


def times(rows):
    """Of Table 1: what a row begins with, and its times in ms by SPP, for each device and kernel."""
    found = {}
    for row in rows:
        ms = found.setdefault(tuple(row[name] for name in ("vendor", "type", "device", "kernel")), {})
        if row["time_ms"] != "":
            ms[int(row["spp"])] = row["time_ms"]
    return list(found.items())


def published():
    text = json.loads((ROOT / "results/thesis-2016.json").read_text(encoding="utf-8"))
    return times(row | {"device": f"{row['device']} ({text['year']})", "kernel": text["kernel"]} for row in text["rows"])


def archived(made):
    for file in sorted((ROOT / "results/archive").glob("*/*/thesis/result.json")):
        shown = subprocess.run([made.ptbench, "report", file, "--csv", "-"], check=True, capture_output=True, text=True).stdout
        yield from times(csv.DictReader(shown.splitlines()))


def gain(base, ms):
    """How many times as fast, at the most samples that both have."""
    shared = max(base.keys() & ms.keys(), default=None)
    return number(float(base[shared]) / float(ms[shared])) if shared else "-"


def table_1(made, commands):
    rows = [*published(), *archived(made), *times(made.rows(commands[-1]))]
    base = rows[0][1]
    head = ["vendor", "type", "device", "kernel", *(f"ms, SPP {spp}" for spp in base), "times as fast as the first"]
    return table(head, [[*words, *(number(ms.get(spp, ""), 4) for spp in base), gain(base, ms)] for words, ms in rows], words=4)


def trees(made, commands):
    head = ["scene", "bvh_split", "nodes a ray", "triangles a ray", "SAH", "triangles", "references", "build, ms", "Msegments/s"]
    columns = ("nodes_per_ray", "triangles_per_ray", "tree_sah_cost", "tree_triangles", "tree_references", "tree_build_ms", "msegments_per_s")
    return table(head, [[row["scene"], f"`{row['bvh_split']}`", *(number(row[name], 4) for name in columns)]
                        for row in made.rows(commands[-1])], words=2)


def efficiency(made, commands):
    """Noise and time of kernels, beside those of the first."""
    rows = made.rows(commands[-1])
    worth = [float(row["efficiency"] or "nan") for row in rows]
    return table(["kernel", "SPP", "ms", "relMSE", "times as efficient"],
                 [[f"`{row['kernel']}`", row["spp"], number(row["time_ms"], 4), number(row["rel_mse"]),
                   number("" if math.isnan(each / worth[0]) else each / worth[0])] for row, each in zip(rows, worth)])


KINDS = {"device": device_line, "pictures": pictures, "table_1": table_1, "trees": trees, "efficiency": efficiency}


def steps(text):
    """The document's blocks of commands, and its marks with the commands of the block above."""
    commands = []
    for step in STEP.finditer(text):
        if step["kind"] is None:
            commands = [line for line in step["commands"].splitlines() if line.startswith("ptbench")]
        yield step, commands


def remade(made, text):
    for _, commands in steps(text):
        made.run_all(commands)
    pieces, at = [], 0
    for step, commands in steps(text):
        if step["kind"]:
            pieces += [text[at:step.start("made")], "\n", KINDS[step["kind"]](made, commands), "\n"]
            at = step.end("made")
    return "".join(pieces) + text[at:]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ptbench")
    parser.add_argument("-d", "--device")
    parser.add_argument("--document", type=pathlib.Path, default=ROOT / "docs/thesis.md")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        made = Made(options.ptbench, options.device, folder, options.document.parent / PICTURES)
        options.document.write_text(remade(made, options.document.read_text(encoding="utf-8")), encoding="utf-8")


if __name__ == "__main__":
    main()
