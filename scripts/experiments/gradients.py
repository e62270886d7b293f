#!/usr/bin/env python3
"""What gradients are worth: bdpt beside gbdpt and its reconstructions, at equal CPU time.

usage: gradients.py PTBENCH [--size 512] [--spp 16] [--rounds 3] [--scenes eclipse,gap,thesis]

relMSE is that of renders of their own seeds against the mean of REFERENCE_SEEDS weighted reconstructions of four times the
samples each, whose own error is some 1/32 of theirs and not taken off; time is the process' CPU time, less that of
2 samples a pixel, so the reconstruction's is in it but for what these two take too (told apart by `none`). Prints a
Markdown table."""
import argparse
import os
import resource
import statistics
import subprocess
import tempfile

import numpy

PATH_LENGTH = "8"
REFERENCE_SEEDS = 8
START_SPP = 2
ROWS = (("bdpt", None), ("gbdpt", "none"), ("gbdpt", "weighted"), ("gbdpt", "l2"), ("gbdpt", "l1"))


class Renders:
    def __init__(self, options, folder):
        self.options, self.file = options, f"{folder}/picture.pfm"

    def picture(self, scene, kernel, reconstruction, spp, seed):
        """The picture, and the CPU seconds that it took."""
        chosen = ["-a", f"reconstruction={reconstruction}"] if reconstruction else []
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        subprocess.run([self.options.ptbench, "render", "-d", self.options.device, "--kernel", kernel, "--scene", scene, "--size",
                        str(self.options.size), "--spp", str(spp), "--seed", str(seed), "--path-length", PATH_LENGTH, *chosen,
                        "-q", "-o", self.file], check=True)
        spent = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
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
    for kernel, reconstruction in ROWS:  # compiled
        for spp in (START_SPP, options.spp):
            renders.picture(scene, kernel, reconstruction, spp, 1)
    found = {row: [] for row in ROWS}
    for i in range(options.rounds):
        for kernel, reconstruction in ROWS:
            picture, whole_s = renders.picture(scene, kernel, reconstruction, options.spp, 1 + i)
            _, start_s = renders.picture(scene, kernel, "none" if reconstruction else None, START_SPP, 1 + i)
            found[kernel, reconstruction].append((whole_s - start_s, rel_mse(picture, reference, 1), rel_mse(picture, reference, 0.99)))
    medians = {row: [statistics.median(column) for column in zip(*values)] for row, values in found.items()}
    base = medians[ROWS[0]]
    for (kernel, reconstruction), (seconds, every, best) in medians.items():
        gains = [base[0] * base[1] / (seconds * every), base[0] * base[2] / (seconds * best)]
        print(f"| {scene} | {kernel} | {reconstruction or ''} | {seconds / base[0]:.2f} | {every:.3g} | {gains[0]:.3g} "
              f"| {best:.3g} | {gains[1]:.3g} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ptbench")
    parser.add_argument("--device", default="cpu")
    parser.add_argument("--size", type=int, default=512)
    parser.add_argument("--spp", type=int, default=16)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--scenes", default="eclipse,gap,thesis")
    options = parser.parse_args()
    options.ptbench = os.path.abspath(options.ptbench)
    print("| scene | kernel | reconstruction | time, x bdpt | relMSE, all pixels | efficiency, x bdpt | best 99 % | x bdpt |")
    print("| --- | --- | --- | ---: | ---: | ---: | ---: | ---: |")
    with tempfile.TemporaryDirectory() as folder:
        for scene in options.scenes.split(","):
            print_scene(Renders(options, folder), options, scene)


if __name__ == "__main__":
    main()
