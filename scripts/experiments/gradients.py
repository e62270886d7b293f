#!/usr/bin/env python3
"""What gradients are worth: gbdpt and its reconstructions beside bdpt, or gpt beside pt_nee, at equal time.

usage: gradients.py PTBENCH [--kernel gbdpt] [--device cpu] [--size 512] [--spp 16] [--rounds 3] [--scenes eclipse,gap,thesis]

relMSE is that of renders of their own seeds against the mean of REFERENCE_SEEDS weighted reconstructions by gbdpt of four
times the samples each, whose own error is some 1/32 of its and not taken off. On CPUs time is the process' CPU time, less that of
2 samples a pixel, so the reconstruction's is in it but for what these two take too (told apart by `none`); on others the
render's own, which has no builds in it. Prints a Markdown table."""
import argparse
import os
import re
import resource
import statistics
import subprocess
import tempfile

import numpy

PATH_LENGTH = "8"
REFERENCE_SEEDS = 8
START_SPP = 2
BASE = {"gbdpt": "bdpt", "gpt": "pt_nee"}
RECONSTRUCTIONS = ("none", "weighted", "l2", "l1")


class Renders:
    def __init__(self, options, folder):
        self.options, self.file = options, f"{folder}/picture.pfm"

    def picture(self, scene, kernel, reconstruction, spp, seed):
        """The picture, and the seconds that it took."""
        chosen = ["-a", f"reconstruction={reconstruction}"] if reconstruction else []
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        said = subprocess.run([self.options.ptbench, "render", "-d", self.options.device, "--kernel", kernel, "--scene", scene, "--size",
                        str(self.options.size), "--spp", str(spp), "--seed", str(seed), "--path-length", PATH_LENGTH, *chosen,
                        "-o", self.file], check=True, capture_output=True, text=True)
        spent = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
        if self.options.device != "cpu":
            spent = float(re.search(r" SPP in ([\d.e-]+) s", said.stdout + said.stderr)[1])
        with open(self.file, "rb") as file:
            file.readline()
            width, height = map(int, file.readline().split())
            file.readline()
            return numpy.frombuffer(file.read(), "<f4").reshape(height, width, 3).astype(float), spent


def rel_mse(picture, reference, best):
    """Of the share `best` of the pixels, those of the smallest errors."""
    medians = numpy.median(reference.reshape(-1, 3), axis=0)
    errors = numpy.zeros(reference.shape[:2])
    for c in range(3):
        squares = (picture[..., c] - reference[..., c]) ** 2
        scale = reference[..., c] ** 2 + 0.01 * medians[c] ** 2
        errors += numpy.divide(squares, scale, out=numpy.zeros_like(squares), where=scale > 0) / 3
    kept = numpy.sort(errors.ravel())[:int(round(best * errors.size))]
    return kept.mean()


def print_scene(renders, options, scene):
    reference = sum(renders.picture(scene, "gbdpt", "weighted", 4 * options.spp, 1000 + i)[0]
                    for i in range(REFERENCE_SEEDS)) / REFERENCE_SEEDS
    base = (BASE[options.kernel], None)
    rows = (base, *((options.kernel, reconstruction) for reconstruction in RECONSTRUCTIONS))
    found = {row: [] for row in rows}
    for i in range(-1, options.rounds):  # the first compiles
        for kernel, reconstruction in rows:
            picture, seconds = renders.picture(scene, kernel, reconstruction, options.spp, 2 + i)
            if options.device == "cpu":
                seconds -= renders.picture(scene, kernel, "none" if reconstruction else None, START_SPP, 2 + i)[1]
            if i >= 0:
                found[kernel, reconstruction].append((seconds, rel_mse(picture, reference, 1), rel_mse(picture, reference, 0.99)))
    medians = {row: [statistics.median(column) for column in zip(*values)] for row, values in found.items()}
    base_s, base_every, base_best = medians[base]
    for (kernel, reconstruction), (seconds, every, best) in medians.items():
        gains = [base_s * base_every / (seconds * every), base_s * base_best / (seconds * best)]
        print(f"| {scene} | {kernel} | {reconstruction or ''} | {seconds / base_s:.2f} | {every:.3g} | {gains[0]:.3g} "
              f"| {best:.3g} | {gains[1]:.3g} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ptbench")
    parser.add_argument("--kernel", default="gbdpt", choices=BASE)
    parser.add_argument("--device", default="cpu")
    parser.add_argument("--size", type=int, default=512)
    parser.add_argument("--spp", type=int, default=16)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--scenes", default="eclipse,gap,thesis")
    options = parser.parse_args()
    options.ptbench = os.path.abspath(options.ptbench)
    base = BASE[options.kernel]
    print(f"| scene | kernel | reconstruction | time, x {base} | relMSE, all pixels | efficiency, x {base} | best 99 % | x {base} |")
    print("| --- | --- | --- | ---: | ---: | ---: | ---: | ---: |")
    with tempfile.TemporaryDirectory() as folder:
        for scene in options.scenes.split(","):
            print_scene(Renders(options, folder), options, scene)


if __name__ == "__main__":
    main()
