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

Variances are of pictures of --spp, times those between the SPP of --times: see efficiency.py."""

import argparse
import os
import sys

from efficiency import FOLDER, ROOT, Program, kernel, pair, print_table, race
from pictures import read_exr

SIZE, PATH_LENGTH = 128, 128


def mitsuba(asked):
    def command(seed, spp, path):
        return [sys.executable, os.path.join(FOLDER, "mitsuba_render.py"), scene_file(asked.scene), str(SIZE), str(spp),
                str(PATH_LENGTH), str(seed), path, asked.variant, *asked.rr_depth]
    return Program(f"Mitsuba path, {asked.variant}", command, asked.spp, asked.mitsuba_times)


def scene_file(scene):
    return os.path.join(ROOT, "configs/scenes", scene + ".json")


def reference_mean(scene):
    path = os.path.join(ROOT, "results/references", f"{scene}_pt_{SIZE}x{SIZE}_pl{PATH_LENGTH}.exr")
    return [value for row in read_exr(path)["mean"] for value in row]


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
    programs = [mitsuba(asked), *(kernel(asked, name, asked.scene, SIZE, PATH_LENGTH) for name in asked.kernels)]
    race(programs, asked.runs)
    print(f"{asked.scene}, {SIZE} x {SIZE}, path length {PATH_LENGTH}, {asked.runs} runs of {asked.spp} SPP\n")
    print_table(programs, reference_mean(asked.scene))


if __name__ == "__main__":
    main(sys.argv[1:])
