#!/usr/bin/env python3
"""How far `pt` is from figures that it did not compute (tests/data): renders a scene in independent batches and
prints the image mean, its error, the z-scores of 8 x 8-pixel blocks, and the path segments of a sample.

usage: truth.py PTBENCH DEVICE {thesis|free_light} SPP [BATCHES]     SPP of each batch; 16 batches
"""

import array
import json
import math
import os
import statistics
import subprocess
import sys
import tempfile

DATA = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "tests", "data")
TRUTH = {"thesis": "thesis_128_pl128_blocks.json", "free_light": "free_light_64_pl128_mitsuba_blocks.json"}


def read_pfm(path):
    """Rows from the top, three floats a pixel."""
    with open(path, "rb") as file:
        assert file.readline() == b"PF\n"
        width, height = map(int, file.readline().split())
        assert float(file.readline()) < 0, "little-endian"
        values = array.array("f", file.read())
    row = 3 * width
    return [values[y * row:(y + 1) * row] for y in reversed(range(height))]


def blocks_of(rows, edge):
    """Means of blocks, channels last, in reading order, flat."""
    count = range(0, len(rows), edge)
    return [statistics.fmean(rows[y + j][3 * (x + i) + c] for j in range(edge) for i in range(edge))
            for y in count for x in count for c in range(3)]


def common(scene, size):
    return ["--scene", scene, "--kernel", "pt", "--size", str(size), "--path-length", "128"]


def batch(ptbench, device, scene, truth, spp, seed, folder):
    path = os.path.join(folder, "batch.pfm")
    subprocess.run([ptbench, "render", "-q", "-d", device, *common(scene, truth["size"]), "--spp", str(spp),
                    "--seed", str(seed), "-o", path], check=True, stdout=subprocess.DEVNULL)
    return blocks_of(read_pfm(path), truth["block"])


def segments_per_sample(ptbench, device, scene, truth, spp, folder):
    """Counted by the kernel, in a validated and timed run of one batch's work."""
    run = [ptbench, "-q", "-d", device, *common(scene, truth["size"]), "--spp", str(spp), "-a", "work_group=implicit",
           "--samples", "1", "--warmup", "0", "--out", os.path.join(folder, "run"), "--json", "-"]
    record = json.loads(subprocess.run(run, check=True, capture_output=True).stdout)["cases"][0]
    return record["work"]["segments"] / record["work"]["samples"], record["validation"]


def compare(batches, truth):
    """Mean and standard error of every block over the batches, and z against the truth's."""
    flat = [value for row in truth["mean"] for block in row for value in block]
    errors = [value for row in truth["standard_error"] for block in row for value in block]
    z = []
    for ours, mean, error in zip(zip(*batches), flat, errors):
        own = statistics.stdev(ours) / math.sqrt(len(ours))
        if own > 0 or error > 0:
            z.append((statistics.fmean(ours) - mean) / math.hypot(own, error))
    return z


def main(argv):
    if len(argv) not in (5, 6) or argv[3] not in TRUTH:
        sys.exit(__doc__)
    ptbench, device, scene, spp = argv[1], argv[2], argv[3], int(argv[4])
    with open(os.path.join(DATA, TRUTH[scene]), encoding="utf-8") as file:
        truth = json.load(file)
    with tempfile.TemporaryDirectory() as folder:
        count = int(argv[5]) if len(argv) == 6 else 16
        batches = [batch(ptbench, device, scene, truth, spp, seed + 1, folder) for seed in range(count)]
        segments, validation = segments_per_sample(ptbench, device, scene, truth, spp, folder)
    print(f"{scene}: {count * spp * truth['size'] ** 2 / 1e6:.1f} million samples on {device}")
    for c, name in enumerate("RGB"):
        means = [statistics.fmean(blocks[c::3]) for blocks in batches]
        mean, error = statistics.fmean(means), statistics.stdev(means) / math.sqrt(count)
        true, true_error = truth["image_mean"][c], truth["image_mean_standard_error"][c]
        print(f"  {name} {mean:.6f} +- {error:.6f}, truth {true:.6f} +- {true_error:.6f}: "
              f"{100 * (mean / true - 1):+.3f} %, {(mean - true) / math.hypot(error, true_error):+.2f} standard errors")
    z = compare(batches, truth)
    print(f"  {len(z)} block means: z rms {math.sqrt(statistics.fmean(v * v for v in z)):.3f}, "
          f"largest {max(map(abs, z)):.2f} (Student's, {count - 1} degrees)")
    print(f"  {segments:.3f} segments a sample" + (f", truth {truth['segments_per_sample']:.3f}: "
          f"{100 * (segments / truth['segments_per_sample'] - 1):+.2f} %" if "segments_per_sample" in truth else ""))
    print(f"  own validation: worst block |z| {validation['max_abs_z']:.2f} of {validation['z_limit']:.2f}")


if __name__ == "__main__":
    main(sys.argv)
