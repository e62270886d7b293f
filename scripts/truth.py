#!/usr/bin/env python3
"""How far a kernel is from what it did not compute: renders a scene in independent batches and prints the image mean, its
error, the z-scores of 8 x 8-pixel blocks, and the path segments of a sample. The truth is other tracers' figures (tests/data)
where there are any of that picture, else the stored reference (results/references).

usage: truth.py PTBENCH DEVICE SCENE SPP [BATCHES] [--kernel KERNEL] [OPTION OF ptbench...]
                                         SPP of each batch; 16 batches; kernel pt
"""

import argparse
import json
import math
import os
import statistics
import subprocess
import sys
import tempfile

from pictures import read_exr, read_pfm

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..")
FIGURES = {("thesis", "pt"): "thesis_128_pl128_blocks.json", ("free_light", "pt"): "free_light_64_pl128_mitsuba_blocks.json"}
SAME_PICTURE = {"pt_nee": "pt", "pt_lt": "pt", "gpt": "pt", "bdpt": "pt", "gbdpt": "pt"}
PATH_LENGTH, EDGE = 128, 8


def blocks_of(rows, edge):
    """Means of blocks, channels last, in reading order, flat."""
    count = range(0, len(rows), edge)
    return [statistics.fmean(rows[y + j][3 * (x + i) + c] for j in range(edge) for i in range(edge))
            for y in count for x in count for c in range(3)]


def flat(rows):
    return [value for row in rows for block in row for value in block]


def figures(path):
    with open(path, encoding="utf-8") as file:
        read = json.load(file)
    return read | {"mean": flat(read["mean"]), "standard_error": flat(read["standard_error"])}


def stored_reference(path):
    """Its blocks and their standard errors, by the stored variance of one sample."""
    with open(path + ".json", encoding="utf-8") as file:
        facts = json.load(file)
    layers = read_exr(path + ".exr")
    blocks = {name: blocks_of(rows, EDGE) for name, rows in layers.items()}
    pixels = facts["width"] * facts["height"]
    return {"size": facts["width"], "block": EDGE, "segments_per_sample": facts["segments_per_sample"],
            "mean": blocks["mean"], "standard_error": [math.sqrt(v / facts["spp"]) / EDGE for v in blocks["variance"]],
            "image_mean": [statistics.fmean(blocks["mean"][c::3]) for c in range(3)],
            "image_mean_standard_error":
                [math.sqrt(statistics.fmean(blocks["variance"][c::3]) / facts["spp"] / pixels) for c in range(3)]}


def truth_of(scene, kernel):
    """What is known of the picture, and who says so."""
    kernel = SAME_PICTURE.get(kernel, kernel)
    if (scene, kernel) in FIGURES:
        name = FIGURES[scene, kernel]
        return figures(os.path.join(ROOT, "tests/data", name)), name
    name = f"{scene}_{kernel}_128x128_pl{PATH_LENGTH}"
    return stored_reference(os.path.join(ROOT, "results/references", name)), name


def common(asked, size):
    return ["-q", "-d", asked.device, "--scene", asked.scene, "--kernel", asked.kernel, "--size", str(size),
            "--path-length", str(PATH_LENGTH), "--spp", str(asked.spp), *asked.options]


def batch(asked, truth, seed, folder):
    path = os.path.join(folder, "batch.pfm")
    subprocess.run([asked.ptbench, "render", *common(asked, truth["size"]), "--seed", str(seed), "-o", path], check=True,
                   stdout=subprocess.DEVNULL)
    return blocks_of(read_pfm(path), truth["block"])


def timed(asked, truth, folder):
    """The record of a validated and timed run of one batch's work."""
    run = [asked.ptbench, *common(asked, truth["size"]), "-a", "work_group=implicit", "--samples", "1", "--warmup", "0",
           "--out", os.path.join(folder, "run"), "--json", "-"]
    return json.loads(subprocess.run(run, check=False, stdout=subprocess.PIPE).stdout)["cases"][0]


def compare(batches, truth):
    """z of every block over the batches, against the truth's."""
    z = []
    for ours, mean, error in zip(zip(*batches), truth["mean"], truth["standard_error"]):
        own = statistics.stdev(ours) / math.sqrt(len(ours))
        if own > 0 or error > 0:
            z.append((statistics.fmean(ours) - mean) / math.hypot(own, error))
    return z


def print_means(batches, truth):
    for c, name in enumerate("RGB"):
        means = [statistics.fmean(blocks[c::3]) for blocks in batches]
        mean, error = statistics.fmean(means), statistics.stdev(means) / math.sqrt(len(means))
        true, true_error = truth["image_mean"][c], truth["image_mean_standard_error"][c]
        print(f"  {name} {mean:.6f} +- {error:.6f}, truth {true:.6f} +- {true_error:.6f}: "
              f"{100 * (mean / true - 1):+.3f} %, {(mean - true) / math.hypot(error, true_error):+.2f} standard errors")


def print_counts(record, truth):
    segments, validation = record["work"]["segments"] / record["work"]["samples"], record["validation"]
    print(f"  {segments:.3f} segments a sample" + (f", truth {truth['segments_per_sample']:.3f}: "
          f"{100 * (segments / truth['segments_per_sample'] - 1):+.2f} %" if "segments_per_sample" in truth else ""))
    print(f"  own validation: worst block |z| {validation['max_abs_z']:.2f} of {validation['z_limit']:.2f}")


def arguments(argv):
    parser = argparse.ArgumentParser(usage=__doc__, add_help=False, allow_abbrev=False)
    parser.add_argument("ptbench")
    parser.add_argument("device")
    parser.add_argument("scene")
    parser.add_argument("spp", type=int)
    parser.add_argument("batches", type=int, nargs="?", default=16)
    parser.add_argument("--kernel", default="pt")
    asked, asked.options = parser.parse_known_args(argv)
    return asked


def main(argv):
    asked = arguments(argv)
    truth, name = truth_of(asked.scene, asked.kernel)
    with tempfile.TemporaryDirectory() as folder:
        batches = [batch(asked, truth, seed + 1, folder) for seed in range(asked.batches)]
        record = timed(asked, truth, folder)
    print(f"{asked.kernel}, {asked.scene}: {len(batches) * asked.spp * truth['size'] ** 2 / 1e6:.1f} million samples on "
          f"{asked.device}, against {name}")
    print_means(batches, truth)
    z = compare(batches, truth)
    print(f"  {len(z)} block means: z rms {math.sqrt(statistics.fmean(v * v for v in z)):.3f}, "
          f"largest {max(map(abs, z)):.2f} (Student's, {len(batches) - 1} degrees)")
    if not record["validation"]["valid"]:
        sys.exit(f"error: {record['reason']}")
    print_counts(record, truth)


if __name__ == "__main__":
    main(sys.argv[1:])
