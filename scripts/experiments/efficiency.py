"""How efficient renderers are that take turns: 1 / (relMSE x s), relMSE the mean over pixels and channels of
variance / (mean^2 + 0.01 median^2), mean and median of a picture that is told.

Every run has a seed of its own; in a run all programs take turns. Variances come from the differences between runs' pictures,
for all programs alike. Time is CPU time of the whole process, user and system, at the larger SPP of two less that at the smaller
one: so neither start nor compiling counts. A first run is thrown away, since it may compile."""

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
from pictures import read_pfm  # noqa: E402

TRIMMED = 0.01


def read_values(path):
    """All rows of a PFM file one after the other."""
    return [value for row in read_pfm(path) for value in row]


class Program:
    """One that renders, the SPP of its pictures and those that it is timed at, and what its runs gave."""

    def __init__(self, name, command, spp, times, read=read_values):
        self.name, self.command, self.spp, self.times, self.read = name, command, spp, times, read
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
        self.pictures.append(self.read(path))

    def forget(self):
        self.pictures, self.seconds_per_spp = [], []


def kernel(asked, name, scene, size, path_length):
    """A kernel of ptbench."""
    def command(seed, spp, path):
        return [asked.ptbench, "render", "-q", "-d", asked.device, "--scene", scene, "--kernel", name, "--size", str(size),
                "--path-length", str(path_length), "--spp", str(spp), "--seed", str(seed), "-o", path, *asked.options]
    return Program(name, command, asked.spp, asked.times)


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


def race(programs, runs):
    with tempfile.TemporaryDirectory() as folder:
        for seed in range(runs + 1):
            for program in programs:
                if seed == 1:
                    program.forget()
                program.run(seed, folder)
            print(f"run {seed} of {runs}", file=sys.stderr)


def print_table(programs, mean):
    """A row each, and how many times as efficient as the first."""
    print("| renderer | CPU ms a sample per pixel | times as fast | relMSE of a sample, all pixels | best 99 % "
          "| efficiency, all pixels | best 99 % | image mean (R, G, B), % of the reference's |")
    print("| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |")
    for row in rows(programs, mean):
        print("| " + " | ".join(row) + " |")
