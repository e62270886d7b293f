#!/usr/bin/env python3
"""How efficient kernels are beside Mitsuba 3's `path`: 1 / (relMSE x s), relMSE the mean over pixels and channels of
variance / (mean^2 + 0.01 median^2), mean and median of the stored reference.

usage: mitsuba_race.py PTBENCH [--scene SCENE] [--kernels pt,pt_nee] [--runs 16] [--spp 72] [--times 32,512]
                       [--mitsuba-times 8,72] [--variant llvm_ad_rgb] [--rr-depth 5] [-d DEVICE]
                       [OPTION OF ptbench render...]

Run it by a Python that has Mitsuba:

    python3 -m venv mitsuba && mitsuba/bin/pip install mitsuba
    mitsuba/bin/python scripts/experiments/mitsuba_race.py build/release/bin/ptbench --scene thesis

llvm_ad_rgb wants a newer LLVM than 15: DRJIT_LIBLLVM_PATH=/usr/lib/x86_64-linux-gnu/libLLVM.so.19.1 (of Debian's libllvm19);
scalar_rgb needs nothing. Scenes are those of configs/scenes without glowing walls.

Neither has roulette: --rr-depth 5 gives it to Mitsuba as its scenes usually have it, -a roulette=albedo to the kernels.

Every run has a seed of its own; in a run all programs take turns. Variances come from the differences between runs' pictures
of --spp, for all programs alike. Time is CPU time of the whole process, user and system, at the larger SPP of --times less that
at the smaller one: so neither start nor compiling counts. A first run is thrown away, since it may compile."""

import argparse
import math
import os
import statistics
import subprocess
import sys
import tempfile

FOLDER = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.join(FOLDER, "../..")
sys.path.insert(0, os.path.join(FOLDER, ".."))
from pictures import read_exr, read_pfm  # noqa: E402

SIZE, PATH_LENGTH, TRIMMED = 128, 128, 0.01


class Program:
    """One that renders, the SPP of its pictures and those that it is timed at, and what its runs gave."""

    def __init__(self, name, command, spp, times):
        self.name, self.command, self.spp, self.times = name, command, spp, times
        self.pictures, self.seconds_per_spp = [], []

    def render(self, seed, spp, path):
        """CPU seconds."""
        before = os.times()
        subprocess.run(self.command(seed, spp, path), check=True, stdout=subprocess.DEVNULL)
        after = os.times()
        return after.children_user + after.children_system - before.children_user - before.children_system

    def run(self, seed, folder):
        path = os.path.join(folder, "picture.pfm")
        few, many = self.times
        start = self.render(seed, few, path)
        self.seconds_per_spp.append((self.render(seed, many, path) - start) / (many - few))
        if many != self.spp:
            self.render(seed, self.spp, path)
        self.pictures.append([value for row in read_pfm(path) for value in row])

    def forget(self):
        self.pictures, self.seconds_per_spp = [], []


def mitsuba(asked):
    def command(seed, spp, path):
        return [sys.executable, os.path.join(FOLDER, "mitsuba_render.py"), scene_file(asked.scene), str(SIZE), str(spp),
                str(PATH_LENGTH), str(seed), path, asked.variant, *asked.rr_depth]
    return Program(f"Mitsuba path, {asked.variant}", command, asked.spp, asked.mitsuba_times)


def kernel(asked, name):
    def command(seed, spp, path):
        return [asked.ptbench, "render", "-q", "-d", asked.device, "--scene", asked.scene, "--kernel", name, "--size", str(SIZE),
                "--path-length", str(PATH_LENGTH), "--spp", str(spp), "--seed", str(seed), "-o", path, *asked.options]
    return Program(name, command, asked.spp, asked.times)


def scene_file(scene):
    return os.path.join(ROOT, "configs/scenes", scene + ".json")


def reference_mean(scene):
    path = os.path.join(ROOT, "results/references", f"{scene}_pt_{SIZE}x{SIZE}_pl{PATH_LENGTH}.exr")
    return [value for row in read_exr(path)["mean"] for value in row]


def floor_of(mean):
    """0.01 median^2, channel by channel."""
    return [0.01 * statistics.median(mean[c::3]) ** 2 for c in range(3)]


def relative_variances(program, mean):
    """Of a sample of each pixel, over its channels."""
    floor = floor_of(mean)
    values = [program.spp * statistics.variance(column) / (true * true + floor[i % 3])
              for i, (column, true) in enumerate(zip(zip(*program.pictures), mean))]
    return [statistics.fmean(values[i:i + 3]) for i in range(0, len(values), 3)]


def with_error(pixels):
    """Their mean, and its standard error in per cent."""
    mean = statistics.fmean(pixels)
    return mean, 100 * statistics.stdev(pixels) / math.sqrt(len(pixels)) / mean


def image_mean(program):
    """Of all runs, channel by channel."""
    return [statistics.fmean(value for picture in program.pictures for value in picture[c::3]) for c in range(3)]


def rows(programs, mean):
    found = []
    for program in programs:
        pixels = sorted(relative_variances(program, mean))
        best = pixels[:round(len(pixels) * (1 - TRIMMED))]
        found.append((program, statistics.median(program.seconds_per_spp), with_error(pixels), with_error(best)))
    _, base_time, (base_all, _), (base_best, _) = found[0]
    for program, seconds, (all_, all_error), (best, best_error) in found:
        means = [100 * (ours / statistics.fmean(mean[c::3]) - 1) for c, ours in enumerate(image_mean(program))]
        yield [program.name, f"{1e3 * seconds:.2f}", f"{base_time / seconds:.1f}",
               f"{all_:.3g} +- {all_error:.1f} %", f"{best:.3g} +- {best_error:.1f} %",
               f"{base_all * base_time / (all_ * seconds):.1f}", f"{base_best * base_time / (best * seconds):.1f}",
               ", ".join(f"{each:+.2f}" for each in means)]


def pair(text):
    few, many = map(int, text.split(","))
    if not 0 < few < many:
        raise argparse.ArgumentTypeError(f"{text}: FEW,MANY samples per pixel")
    return few, many


def arguments(argv):
    parser = argparse.ArgumentParser(usage=__doc__, allow_abbrev=False)
    parser.add_argument("ptbench")
    parser.add_argument("-d", "--device", default="cpu")
    parser.add_argument("--scene", default="thesis")
    parser.add_argument("--kernels", type=lambda text: text.split(","), default=["pt", "pt_nee"])
    parser.add_argument("--runs", type=int, default=16)
    parser.add_argument("--spp", type=int, default=72)
    parser.add_argument("--times", type=pair, default=(32, 512))
    parser.add_argument("--mitsuba-times", type=pair, default=(8, 72))
    parser.add_argument("--variant", default="llvm_ad_rgb")
    parser.add_argument("--rr-depth", nargs=1, default=[])
    asked, asked.options = parser.parse_known_args(argv)
    return asked


def main(argv):
    asked = arguments(argv)
    programs = [mitsuba(asked), *(kernel(asked, name) for name in asked.kernels)]
    with tempfile.TemporaryDirectory() as folder:
        for seed in range(asked.runs + 1):
            for program in programs:
                if seed == 1:
                    program.forget()
                program.run(seed, folder)
            print(f"run {seed} of {asked.runs}", file=sys.stderr)
    print(f"{asked.scene}, {SIZE} x {SIZE}, path length {PATH_LENGTH}, {asked.runs} runs of {asked.spp} SPP\n")
    print("| renderer | CPU ms a sample per pixel | times as fast | relMSE of a sample, all pixels | best 99 % "
          "| efficiency, all pixels | best 99 % | image mean (R, G, B), % of the reference's |")
    print("| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |")
    for row in rows(programs, reference_mean(asked.scene)):
        print("| " + " | ".join(row) + " |")


if __name__ == "__main__":
    main(sys.argv[1:])
