#!/usr/bin/env python3
"""What paths from both ends are worth: pt, pt_nee, pt_lt and bdpt at equal time, on scenes whose lamps are hard to find.

usage: both_ends.py PTBENCH [--device cpu] [--size 128] [--spp 512] [--cpu-time ROUNDS] [--scenes thesis,eclipse,...]

Noise and time are those of a run of ptbench. On a busy machine take CPU time instead: medians of interleaved renders,
less those of 4 samples a pixel. Prints a Markdown table; a wrong image ends it with exit code 1."""
import argparse
import json
import resource
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

KERNELS = ("pt", "pt_nee", "pt_lt", "bdpt")
SCENES = "thesis,eclipse,gap,caustic,lamp_in_glass"
PATH_LENGTH = "8"
START_SPP, TIMED_SPP = 4, 200


def measured(options, scene, folder):
    """Records of the kernels, by their names."""
    file = Path(folder) / "result.json"
    once = ["--samples", "1", "--warmup", "0"] if options.cpu_time else []
    subprocess.run([options.ptbench, "-d", options.device, "--kernel", ",".join(KERNELS), "--scene", scene,
                    "--size", str(options.size), "--spp", str(options.spp), "--path-length", PATH_LENGTH, "--wg", "implicit",
                    "--no-tune", "--json", str(file), "--out", folder, "-q", *once], check=False, stdout=subprocess.DEVNULL)
    records = {record["params"]["kernel"]: record for record in json.loads(file.read_text())["cases"]}
    for kernel, record in records.items():
        if record["statistics"] is None:
            sys.exit(f"{scene}, {kernel}: {record['status']}: {record['reason']}")
    return records


def cpu_s(options, kernel, scene, spp, folder):
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    subprocess.run([options.ptbench, "render", "-d", options.device, "--kernel", kernel, "--scene", scene, "--size",
                    str(options.size), "--spp", str(spp), "--path-length", PATH_LENGTH, "-o", f"{folder}/picture.ppm"],
                   check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def cpu_times(options, scene, folder):
    """CPU seconds of a render of options.spp, by kernel."""
    times = {kernel: [] for kernel in KERNELS}
    for _ in range(options.cpu_time):
        for kernel in KERNELS:
            spent = cpu_s(options, kernel, scene, START_SPP + TIMED_SPP, folder) - cpu_s(options, kernel, scene, START_SPP, folder)
            times[kernel].append(spent * options.spp / TIMED_SPP)
    return {kernel: statistics.median(of_kernel) for kernel, of_kernel in times.items()}


def print_scene(options, scene, folder):
    records = measured(options, scene, folder)
    seconds = (cpu_times(options, scene, folder) if options.cpu_time else
               {kernel: record["statistics"]["median_ns"] * 1e-9 for kernel, record in records.items()})
    for kernel, record in records.items():
        samples = record["work"]["samples"]
        cells = [scene, kernel, f"{samples / seconds[kernel] / 1e6:.4g}"]
        for pixels in ("all", "best_99"):
            noise = {name: records[name]["efficiency"][pixels] for name in KERNELS}
            own = noise[kernel]
            cells.append(f"{own['rel_mse']:.3g} +- {100 * own['standard_error'] / own['rel_mse']:.0f} %")
            for other in ("pt", "pt_nee"):
                gain = noise[other]["rel_mse"] * seconds[other] / (own["rel_mse"] * seconds[kernel])
                cells.append(f"{gain:.3g}")
        print("| " + " | ".join(cells) + " |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ptbench")
    parser.add_argument("--device", default="cpu")
    parser.add_argument("--size", type=int, default=128)
    parser.add_argument("--spp", type=int, default=512)
    parser.add_argument("--cpu-time", type=int, default=0, metavar="ROUNDS")
    parser.add_argument("--scenes", default=SCENES)
    options = parser.parse_args()
    unit = "Msamples/s of a core" if options.cpu_time else "Msamples/s"
    print(f"| scene | kernel | {unit} | relMSE | x pt | x pt_nee | relMSE, best 99 % | x pt | x pt_nee |")
    print("| --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |")
    with tempfile.TemporaryDirectory() as folder:
        for scene in options.scenes.split(","):
            print_scene(options, scene, folder)


if __name__ == "__main__":
    main()
