#!/usr/bin/env python3
"""How large a page of 1,000 cases x 200 samples with eight pictures is, and how soon Chromium has it usable.

usage: page_size.py RESULT.json     (of a run with --samples 200, its pictures beside it; build/release/bin/ptbench
                                     makes the page)

Cases and pictures are those of the result, again and again, each time with a case's samples in another order, so that
nothing compresses because it was copied: the page holds as much noise as clocks really have."""

import copy
import json
import pathlib
import random
import shutil
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/cli"))
from browser import Browser  # noqa: E402

CASES, SAMPLES, DEVICES = 1000, 200, 8


def large(result, draw):
    timed = [case for case in result["cases"] if len(case["samples"]) >= SAMPLES]
    made = copy.deepcopy(result)
    made["devices"] = [{**result["devices"][i % len(result["devices"])], "key": f"gpu:{i}", "name": f"Device number {i}"}
                       for i in range(DEVICES)]
    made["cases"] = []
    for i in range(CASES):
        case = copy.deepcopy(timed[i % len(timed)])
        case["params"] |= {"device": f"gpu:{i % DEVICES}", "work_group": str(1 + i // DEVICES) if i >= 48 else "implicit",
                           "spp": 2 ** (i // DEVICES % 6)}
        case["samples"] = draw.sample(case["samples"], SAMPLES)
        times = sorted(sample["kernel_ns"] for sample in case["samples"])
        case["statistics"] |= {"n": SAMPLES, "median_ns": statistics.median(times), "ci_low_ns": times[86],
                               "ci_high_ns": times[113], "mean_ns": statistics.mean(times), "min_ns": times[0],
                               "max_ns": times[-1], "q1_ns": times[50], "q3_ns": times[150]}
        made["cases"].append(case)
    pictures = [picture["file"] for picture in result["pictures"]]
    made["pictures"] = [{"params": made["cases"][i]["params"], "file": f"gpu-{i}.png"} for i in range(DEVICES)]
    return made, pictures


def main():
    source = pathlib.Path(sys.argv[1])
    result, pictures = large(json.loads(source.read_text()), random.Random(1))
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for i, picture in enumerate(result["pictures"]):
            shutil.copy(source.parent / pictures[i % len(pictures)], folder / picture["file"])
        (folder / "result.json").write_text(json.dumps(result))
        subprocess.run([ROOT / "build/release/bin/ptbench", "report", folder / "result.json", "--html", folder / "page.html"],
                       check=True)
        print(f"{CASES} cases x {SAMPLES} samples, {DEVICES} pictures: result {(folder / 'result.json').stat().st_size} bytes, "
              f"page {(folder / 'page.html').stat().st_size} bytes")
        browser = Browser()
        browser.look(1280, "light")
        ready = "document.documentElement.classList.contains('ready')"
        times = [browser.open(folder / "page.html", ready) for _ in range(5)]
        print(f"usable (tables sorted and filtered, data unpacked, charts drawn) after "
              f"{min(times):.2f} to {max(times):.2f} s; complaints: {len(browser.complaints())}")
        browser.close()


main()
