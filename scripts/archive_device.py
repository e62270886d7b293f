#!/usr/bin/env python3
"""Measures all of one device that the archive compares: configs and meshes, in about ten minutes; or of equal ones together.

usage: archive_device.py PTBENCH VENDOR/NAME [-d DEVICE[,DEVICE...]] [--seconds N] [--runs quick,speed,...] [--folder ARCHIVE]

Runs what stands in RUNS, or in RUNS_TOGETHER for several devices, all of it in about N seconds [500] and what compiling takes,
on DEVICE [0] of `ptbench list`; on a GPU at its sizes. Leaves result.json of each, and the picture of `quick`, in results/archive/VENDOR/NAME/RUN, cut as
results/README.md says, and the device's line in README.md. scripts/archive.py checks it all and makes the page."""

import argparse
import json
import os
import pathlib
import shlex
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
MESHES = "-a scene=[flake,hair,knot,terrain] --kernel pt --path-length 10 --spp 16 --wg implicit"
SHORT = "--max-time 2"
RUNS = {  # share of the time in percent, words, and those of a CPU or a GPU beside
    "quick": (12, "--config quick", "", ""),
    "thesis": (14, "--config thesis", "", ""),
    "speed": (10, "--config speed --peaks --max-time 5", "", "--size 1024"),
    "memory": (5, f"--config memory {SHORT}", "", "--size 1024"),
    "queues": (7, f"--config queues {SHORT}", "", ""),
    "quality": (10, f"--config quality {SHORT}", "", "--size 1024"),
    "workgroups": (10, f"--config workgroups {SHORT}", "", "--size 1024"),
    "ladder": (18, f"--config ladder --spp [4:256:x8] {SHORT}", "", "--size 1024"),
    "meshes": (8, f"{MESHES} {SHORT}", "--size 128", "--size 1024"),
    "rays": (6, f"--config rays {SHORT}", "", "--size 2048"),
}
RUNS_TOGETHER = {
    "cards": (50, "--config cards", "--size 64", ""),
    "one-picture": (50, f"--kernel pt,pt_nee,bdpt --path-length 8 --spp [256,4096] -a devices=[1,2,all] --wg implicit {SHORT}", "--size 64",
                    "--size 1024"),
}
CHOOSES = ("POCL_DEVICES", "RUSTICL_ENABLE", "CUDA_VISIBLE_DEVICES")  # devices


def are_gpus(ptbench, devices):
    """Of keys, or of numbers in the list."""
    listed = json.loads(subprocess.run([ptbench, "list", "-q", "--json"], check=True, capture_output=True, text=True).stdout)["devices"]
    names = {name: each for at, each in enumerate(listed) for name in (str(at), each["key"])}
    unknown = [device for device in devices if device not in names]
    if unknown:
        sys.exit(f"-d: found {unknown[0]}; allowed: {', '.join(each['key'] for each in listed)}")
    return all(names[device]["type"] == "GPU" for device in devices)


def words_of(run, options, gpu):
    share, words, of_cpu, of_gpu = (RUNS | RUNS_TOGETHER)[run]
    return [*shlex.split(f"{words} {of_gpu if gpu else of_cpu}"), "-d", options.device, "--no-tune",
            "--max-total-time", f"{options.seconds * share / 100:.0f}", "--out", run]


def cut(file, pictures):
    """Leaves nothing of where ptbench and drivers lay, and no name of a picture that does not stay."""
    result = json.loads(file.read_text(encoding="utf-8"))
    result["run"]["argv"][0] = "ptbench"
    result["run"]["folder"] = "."
    for device in result["devices"]:
        device["icd"] = f"/etc/OpenCL/vendors/{pathlib.Path(device['icd']).name}"
    result["broken_icds"] = []
    result["pictures"] = [picture for picture in result["pictures"] if pictures]
    file.write_text(json.dumps(result, indent=2, ensure_ascii=False) + "\n", encoding="utf-8")
    return result


def measure(ptbench, folder, words, pictures):
    """The run's result, alone in its folder."""
    run = words[-1]
    shutil.rmtree(folder / run, ignore_errors=True)
    ran = subprocess.run([ptbench, *words], cwd=folder, check=False, stdout=subprocess.DEVNULL)
    file = folder / run / "result.json"
    if not file.exists():
        sys.exit(f"{run}: exit code {ran.returncode}, and no result")
    result = cut(file, pictures)
    kept = {"result.json", *(picture["file"] for picture in result["pictures"])}
    for other in file.parent.iterdir():
        if other.name not in kept:
            other.unlink()
    timed = sum(case["statistics"] is not None for case in result["cases"])
    print(f"{run}: {timed} of {len(result['cases'])} cases have a time, exit code {ran.returncode}, {result['run']['wall_s']:.0f} s", flush=True)
    return result


def line(options, result):
    device, host, count = result["devices"][0], result["host"], len(options.device.split(","))
    chosen = "".join(f"{name}={os.environ[name]} " for name in CHOOSES if name in os.environ)
    return (f"| `{options.name}` | {f'{count} of ' if count > 1 else ''}{device['name']}, {device['compute_units']} compute units; {device['platform']} "
            f"{device['driver_version']}, {host['os']} | `{chosen}scripts/archive_device.py build/release/bin/ptbench {options.name} "
            f"-d {options.device} --seconds {options.seconds}` |\n")


def put_line(readme, name, text):
    """In place of the device's own, or as the last of the table."""
    lines = readme.read_text(encoding="utf-8").splitlines(keepends=True)
    rows = [at for at, each in enumerate(lines) if each.startswith("| ")]
    own = [at for at in rows if lines[at].startswith(f"| `{name}` |")]
    lines[own[0] if own else rows[-1] + 1:own[0] + 1 if own else rows[-1] + 1] = [text]
    readme.write_text("".join(lines), encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ptbench", type=pathlib.Path)
    parser.add_argument("name")
    parser.add_argument("-d", "--device", default="0")
    parser.add_argument("--seconds", type=int, default=500)
    parser.add_argument("--runs")
    parser.add_argument("--folder", type=pathlib.Path, default=ROOT / "results/archive")
    options = parser.parse_args()
    ptbench, folder = options.ptbench.resolve(), options.folder.resolve() / options.name
    folder.mkdir(parents=True, exist_ok=True)
    devices = options.device.split(",")
    gpu = are_gpus(ptbench, devices)
    runs = options.runs.split(",") if options.runs else list(RUNS if len(devices) == 1 else RUNS_TOGETHER)
    for run in runs:
        result = measure(ptbench, folder, words_of(run, options, gpu), run == next(iter(RUNS)))
    put_line(options.folder / "README.md", options.name, line(options, result))


if __name__ == "__main__":
    main()
