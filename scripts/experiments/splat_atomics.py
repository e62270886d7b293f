#!/usr/bin/env python3
"""What it costs that splats of `bdpt` add up to the same bits always: CPU time beside kernels whose splats are floats.

usage: splat_atomics.py PTBENCH [--scenes thesis,eclipse,...] [--size 128] [--spp 200] [--rounds 9] [-d DEVICE]
                        [OPTION OF ptbench render...]

Float atomics compare and swap, as OpenCL C 1.2 has no other. Plain sums, of whole numbers or floats, lose some: no picture of
theirs is right, nor one of floats shown, since the host reads whole numbers. Times are medians of interleaved renders less those
of 4 samples a pixel; by each scene the ratios to whole numbers by atomics, the medians of those within a round."""
import argparse
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

KERNELS = Path(__file__).resolve().parent.parent.parent / "kernels"
SCENES = "thesis,eclipse,gap,lamp_in_glass"
PATH_LENGTH, START_SPP = "8", 4

WHOLE = "static inline void splat_add(volatile __global long* sum, long value) { (void)atom_add(sum, value); }"
CALL = "splat_add(&place->radiance[{}], (long){}[lane]);"
PLAIN = "static inline void splat_add(volatile __global long* sum, long value) { *sum += value; }"
FLOAT = """static inline void splat_add(volatile __global long* sum, float value) {
    volatile __global float* place = (volatile __global float*)sum;
    *place += value;
}"""
SWAP = """static inline void splat_add(volatile __global long* sum, float value) {
    volatile __global uint* place = (volatile __global uint*)sum;
    uint before = *place, seen;
    while ((seen = atomic_cmpxchg(place, before, as_uint(as_float(before) + value))) != before) before = seen;
}"""
# Name, what replaces the sum, whether it takes floats.
VARIANTS = (("whole numbers by atomics", None, False), ("floats by atomics", SWAP, True),
            ("whole numbers, plain", PLAIN, False), ("floats, plain", FLOAT, True))


def replaced(text, right, wrong):
    if text.count(right) != 1:
        sys.exit(f"engine/splat.h has no such text any more, or more than once: {right}")
    return text.replace(right, wrong)


def kernels(folder, function, floats):
    """A folder of kernels with this sum."""
    shutil.copytree(KERNELS, folder)
    file = folder / "engine/splat.h"
    text = file.read_text()
    if function:
        text = replaced(text, WHOLE, function)
    if floats:
        for channel, name in enumerate(("red", "green", "blue")):
            call = CALL.format(channel, name)
            text = replaced(text, call, call.replace("(long)", ""))
    file.write_text(text)


def cpu_s(options, scene, spp, folder):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([options.ptbench, "render", "-q", "-d", options.device, "--kernel", "bdpt", "--scene", scene, "--size",
                    str(options.size), "--spp", str(spp), "--path-length", PATH_LENGTH, "--kernel-dir", folder, "-o",
                    f"{folder}/picture.ppm", *options.others], check=True, stdout=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def print_scene(options, scene, folders):
    times = {folder: [] for folder in folders}
    for turn in range(options.rounds + 1):
        for folder in folders:
            spent = cpu_s(options, scene, START_SPP + options.spp, folder) - cpu_s(options, scene, START_SPP, folder)
            if turn > 0: # the first compiles
                times[folder].append(spent)
    base = times[folders[0]]
    cells = [scene, f"{options.size ** 2 * options.spp / statistics.median(base) / 1e6:.2f}"]
    for folder in folders[1:]:
        cells.append(f"{statistics.median(own / whole for own, whole in zip(times[folder], base)):.3f}")
    print("| " + " | ".join(cells) + " |", flush=True)


def main():
    parser = argparse.ArgumentParser(usage=__doc__, allow_abbrev=False)
    parser.add_argument("ptbench")
    parser.add_argument("--scenes", default=SCENES)
    parser.add_argument("--size", type=int, default=128)
    parser.add_argument("--spp", type=int, default=200)
    parser.add_argument("--rounds", type=int, default=9)
    parser.add_argument("-d", "--device", default="cpu")
    options, options.others = parser.parse_known_args()
    print("| scene | Msamples/s of a core | " + " | ".join(name for name, _, _ in VARIANTS[1:]) + " |")
    print("| --- |" + " ---: |" * len(VARIANTS))
    with tempfile.TemporaryDirectory() as scratch:
        folders = [Path(scratch) / str(number) for number in range(len(VARIANTS))]
        for folder, (_, function, floats) in zip(folders, VARIANTS):
            kernels(folder, function, floats)
        for scene in options.scenes.split(","):
            print_scene(options, scene, folders)


if __name__ == "__main__":
    main()
