#!/usr/bin/env python3
"""How efficient `bdpt` is beside SmallVCM's bidirectional path tracer, on scenes that both can express: see efficiency.py.

usage: smallvcm_race.py PTBENCH FOLDER OF SmallVCM [--scene eclipse] [--kernels bdpt] [--path-length 8] [--runs 16] [--spp 16]
                        [--times 16,256] [--smallvcm-times 4,16] [--reference-spp 16384] [-d DEVICE]
                        [OPTION OF ptbench render...]

    git clone https://github.com/SmallVCM/SmallVCM
    scripts/experiments/smallvcm_race.py build/release/bin/ptbench SmallVCM --scene eclipse

SCENE is one of configs/scenes, of balls and without glow, or `box`: SmallVCM's own default, a Cornell box of triangles with a
mirror and a glass ball, whose lamp is the floor of a small box. SmallVCM is compiled as its Makefile does (g++ -O3 -fopenmp) with
smallvcm_race.cpp, which gives it lights in the shape of balls, asked by area. Two threads each. SmallVCM's paths end by roulette;
those of the kernels do with -a roulette=albedo.

The reference is a long render of `bdpt`. What the pictures differ by from it is told as a mean, and as the rms of the means of
8 x 8 blocks, in standard errors over the runs."""

import argparse
import json
import math
import os
import statistics
import subprocess
import sys
import tempfile

from efficiency import FOLDER, ROOT, Program, kernel, pair, print_table, race, read_values
from pictures import read_pfm

SIZE, BLOCK = 128, 8

LOW, HIGH, LEFT, RIGHT, NEAR, FAR = -1.28002, 1.28002, -1.27029, 1.28975, -1.25549, 1.30455
LID, RADIUS, GREY = 1.26002, 0.5, 0.803922


def box():
    """The scene of SmallVCM's kDefault."""
    corners = [(x, y, z) for y in (FAR, NEAR) for z, (a, b) in ((LOW, (LEFT, RIGHT)), (HIGH, (RIGHT, LEFT))) for x in (a, b)]
    small = [(x, y, z) for y in (0.25, -0.25) for z, (a, b) in ((LID, (-0.25, 0.25)), (HIGH, (0.25, -0.25))) for x in (a, b)]
    def mesh(points, material, *faces):
        return {"vertices": points, "faces": faces, "material": material}
    aside = 2 * (RIGHT - LEFT) / 7
    position, forward = (-0.0439815, -4.12529, 0.222539), (0.00688625, 0.998505, -0.0542161)
    return {
        "name": "box",
        "camera": {"position": position, "look_at": [p + f for p, f in zip(position, forward)],
                   "up": [3.73896e-4, 0.0542148, 0.998529], "fov_deg": 45},
        "materials": {"grey": {"type": "matte", "albedo": [GREY] * 3},
                      "green": {"type": "matte", "albedo": [0.156863, GREY, 0.172549]},
                      "red": {"type": "matte", "albedo": [GREY, 0.152941, 0.152941]},
                      "lamp": {"type": "emitter", "radiance": [25.0333] * 3},
                      "mirror": {"type": "mirror", "reflectance": [1, 1, 1]},
                      "glass": {"type": "dielectric", "ior": 1.6}},
        "spheres": [{"centre": [x, (NEAR + FAR) / 2, LOW + RADIUS], "radius": RADIUS, "material": material}
                    for x, material in ((LEFT + aside, "mirror"), (RIGHT - aside, "glass"))],
        "meshes": [mesh(corners, "grey", (0, 4, 5), (5, 1, 0), (0, 1, 2), (2, 3, 0), (2, 6, 7), (7, 3, 2)),
                   mesh(corners, "green", (3, 7, 4), (4, 0, 3)), mesh(corners, "red", (1, 5, 6), (6, 2, 1)),
                   mesh(small, "grey", (0, 2, 1), (2, 0, 3), (3, 4, 7), (4, 3, 0), (1, 6, 5), (6, 1, 2), (4, 5, 6), (6, 7, 4)),
                   mesh(small, "lamp", (0, 5, 4), (5, 0, 1))]}


def written(scene, folder):
    """The path of a scene file, its meshes beside it."""
    meshes = []
    for number, mesh in enumerate(scene["meshes"]):
        name = f"mesh{number}.obj"
        with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
            file.writelines("v {} {} {}\n".format(*point) for point in mesh["vertices"])
            file.writelines("f {} {} {}\n".format(*(corner + 1 for corner in face)) for face in mesh["faces"])
        meshes.append({"file": name, "material": mesh["material"]})
    path = os.path.join(folder, "scene.json")
    with open(path, "w", encoding="utf-8") as file:
        json.dump({**scene, "meshes": meshes}, file)
    return path


def told(scene):
    """The scene in words, for smallvcm_race.cpp."""
    def material(name):
        of = scene["materials"][name]
        black, white = [0, 0, 0], [1, 1, 1]
        mirror = of.get("reflectance", white if of["type"] == "dielectric" else black)
        return [*of.get("albedo", black), *mirror, of.get("ior", -1), *of.get("radiance", black)]
    camera = scene["camera"]
    forward = [a - b for a, b in zip(camera["look_at"], camera["position"])]
    lines = [["camera", *camera["position"], *forward, *camera["up"], camera["fov_deg"]]]
    lines += [["ball", *material(ball["material"]), *ball["centre"], ball["radius"]] for ball in scene["spheres"]]
    lines += [["triangle", *material(mesh["material"]), *(x for corner in face for x in mesh["vertices"][corner])]
              for mesh in scene.get("meshes", []) for face in mesh["faces"]]
    return "\n".join(" ".join(map(str, line)) for line in lines)


def smallvcm(asked, scene, folder):
    binary, words = os.path.join(folder, "smallvcm_race"), os.path.join(folder, "scene.txt")
    subprocess.run(["g++", "-O3", "-fopenmp", "-w", f"-I{os.path.join(asked.smallvcm, 'src')}",
                    os.path.join(FOLDER, "smallvcm_race.cpp"), "-o", binary], check=True)
    with open(words, "w", encoding="utf-8") as file:
        file.write(told(scene))

    def command(seed, spp, path):
        return ["sh", "-c", f'"$0" "$@" < {words}', binary, str(SIZE), str(asked.path_length), str(spp), str(1000 * seed), "2", path]
    def read(path):
        """Its files have the top row first, where PFM has the last."""
        return [value for row in reversed(read_pfm(path)) for value in row]
    return Program("SmallVCM bpt", command, asked.spp, asked.smallvcm_times, read)


def blocks(picture):
    """Means of blocks of pixels, over the channels."""
    sums = {}
    for i, value in enumerate(picture):
        pixel = i // 3
        block = pixel // SIZE // BLOCK, pixel % SIZE // BLOCK
        sums[block] = sums.get(block, 0) + value / (3 * BLOCK * BLOCK)
    return sums


def deviation(program, mean):
    """Of the means of blocks from the reference's: their mean in per cent, and their rms in standard errors over the runs."""
    true, found = blocks(mean), [blocks(picture) for picture in program.pictures]
    values = {block: [picture[block] for picture in found] for block in true}
    z = [(statistics.fmean(of_block) - true[block]) / (statistics.stdev(of_block) / math.sqrt(len(of_block)))
         for block, of_block in values.items()]
    total = sum(statistics.fmean(of_block) for of_block in values.values()) / sum(true.values()) - 1
    return f"{program.name}: mean {100 * total:+.3f} %, blocks' rms {math.sqrt(statistics.fmean(x * x for x in z)):.2f} standard errors"


def arguments(argv):
    parser = argparse.ArgumentParser(usage=__doc__, allow_abbrev=False)
    parser.add_argument("ptbench")
    parser.add_argument("smallvcm")
    parser.add_argument("-d", "--device", default="cpu")
    parser.add_argument("--scene", default="eclipse")
    parser.add_argument("--kernels", type=lambda text: text.split(","), default=["bdpt"])
    parser.add_argument("--path-length", type=int, default=8)
    parser.add_argument("--runs", type=int, default=16)
    parser.add_argument("--spp", type=int, default=16)
    parser.add_argument("--times", type=pair, default=(16, 256))
    parser.add_argument("--smallvcm-times", type=pair, default=(4, 16))
    parser.add_argument("--reference-spp", type=int, default=16384)
    asked, asked.options = parser.parse_known_args(argv)
    return asked


def main(argv):
    asked = arguments(argv)
    with tempfile.TemporaryDirectory() as folder:
        if asked.scene == "box":
            scene = box()
            file = written(scene, folder)
        else:
            file = os.path.join(ROOT, "configs/scenes", asked.scene + ".json")
            with open(file, encoding="utf-8") as text:
                scene = json.load(text)
        programs = [smallvcm(asked, scene, folder), *(kernel(asked, name, file, SIZE, asked.path_length) for name in asked.kernels)]
        reference = os.path.join(folder, "reference.pfm")
        kernel(asked, "bdpt", file, SIZE, asked.path_length).render(10**6, asked.reference_spp, reference)
        mean = read_values(reference)
        race(programs, asked.runs)
    print(f"{asked.scene}, {SIZE} x {SIZE}, path length {asked.path_length}, {asked.runs} runs of {asked.spp} SPP\n")
    print_table(programs, mean)
    print()
    for program in programs:
        print(deviation(program, mean))


if __name__ == "__main__":
    main(sys.argv[1:])
