#!/usr/bin/env python3
"""Checks every archived result, and makes the archive's index: one page of all of them, by `ptbench report`.

usage: archive.py PTBENCH [FOLDER [INDEX]]     of results/archive, into its index.html

Says every fault and exits with 1, the index untouched, if one of the files may not be there."""

import json
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
SCHEMA = ROOT / "configs/schema/result.schema.json"
MOST_BYTES = 3_500_000
sys.path.insert(0, str(ROOT / "tests/cli"))
from validate_schema import schema_errors  # noqa: E402


def outcome_faults(case):
    """A time stands for a picture that was judged to be right."""
    timed = case["statistics"] is not None
    if timed and case["status"] not in ("ok", "unstable"):
        yield f"a case that is {case['status']} has a time"
    if timed and not (case["validation"] and case["validation"]["valid"]):
        yield "a time without a valid image"
    if not timed and not case["reason"]:
        yield f"a case that is {case['status']} has no time, and says no reason"


def run_faults(run):
    if run["interrupted"]:
        yield "the run was interrupted"
    if run["git_dirty"]:
        yield "ptbench was built from a tree with changes that are not committed"
    for word in [*run["argv"], run.get("folder", "")]:
        if word.startswith(("/", "~")):
            yield f"it names a folder of that machine: {word}"


def file_faults(file):
    """What speaks against a result file in the archive."""
    invalid = schema_errors(SCHEMA, file)
    if invalid:
        return [invalid]
    result = json.loads(file.read_text(encoding="utf-8"))
    faults = list(run_faults(result["run"]))
    for i, case in enumerate(result["cases"]):
        faults += [f"/cases/{i}: {fault}" for fault in outcome_faults(case)]
    pictures = {picture["file"] for picture in result["pictures"]}
    for other in sorted(file.parent.iterdir()):
        if other != file and other.name not in pictures:
            faults.append(f"{other.name} lies there, and the result does not name it")
    return faults


def is_of_one(file):
    devices = json.loads(file.read_text(encoding="utf-8"))["devices"]
    return sum(not device["excluded"] for device in devices) == 1


def device_faults(folder, readme):
    """A device has a picture, and a line in the README. Several that were measured together have theirs where one is alone."""
    if any(is_of_one(file) for file in folder.glob("*/result.json")) and not list(folder.glob("*/*.png")):
        yield "none of its runs has its picture"
    if f"`{folder.parent.name}/{folder.name}`" not in readme:
        yield "README.md has no line for it"


def all_faults(folder, files):
    readme = (folder / "README.md").read_text(encoding="utf-8")
    found = [f"{file}: {fault}" for file in files for fault in file_faults(file)]
    for device in sorted({file.parents[1] for file in files}) if not found else ():
        found += [f"{device}: {fault}" for fault in device_faults(device, readme)]
    misplaced = set(folder.rglob("*.json")) - set(files)
    return found + [f"{file}: not VENDOR/DEVICE/RUN/result.json" for file in sorted(misplaced)]


def main(ptbench, folder=ROOT / "results/archive", index=None):
    folder = pathlib.Path(folder)
    index = pathlib.Path(index or folder / "index.html")
    files = sorted(folder.glob("*/*/*/result.json"))
    faults = all_faults(folder, files) if files else [f"{folder}: no VENDOR/DEVICE/RUN/result.json"]
    if faults:
        sys.exit("\n".join(faults))
    names = [file.relative_to(folder) for file in files]  # a page may not tell where the tree lies
    subprocess.run([pathlib.Path(ptbench).resolve(), "report", *names, "--html", index.resolve()], check=True, cwd=folder)
    size = index.stat().st_size
    print(f"{index}: {len(files)} results, {size} bytes")
    if size > MOST_BYTES:
        sys.exit(f"{index}: more than the {MOST_BYTES} bytes that a tree should hold")


if __name__ == "__main__":
    if not 2 <= len(sys.argv) <= 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
