#!/usr/bin/env python3
"""Markdown tables of scenes with meshes.

usage: meshes.py PTBENCH DEVICE segments|growth|splits|balls [MOST]

segments: those of a sample in the shipped scenes, beside the host tracer's references; no time is taken
growth:   time a segment, time of the build and bytes from a thousand triangles to MOST [10 million]
splits:   what ways of building the tree are worth, in closed rooms and in the open; counted with --peaks
balls:    the thesis' scene with its balls as triangles, finer and finer up to detail MOST [5], beside the spheres"""

import json
import math
import pathlib
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "scripts"))
from pictures import read_pfm  # noqa: E402

SCENES = ROOT / "configs/scenes"
CLOSED, OPEN = ("knot", "flake", "menger", "hair", "slivers"), ("cornell", "terrain")
USUAL = ("--kernel", "pt", "--path-length", "10", "--size", "128", "--wg", "implicit")
TIMED = ("--spp", "8", "--max-time", "2", "--warmup", "0")
SPLITS = ("spatial", "sah", "spatial_xyz", "sah_xyz")


def cases(ptbench, device, *words):
    """Records of a run; those without a time say why, and are none."""
    with tempfile.TemporaryDirectory() as folder:
        command = [ptbench, "-q", "-d", device, *USUAL, *words, "--no-tune", "--out", f"{folder}/run", "--json", "-"]
        run = subprocess.run(command, check=False, stdout=subprocess.PIPE)
        records = json.loads(run.stdout)["cases"]
    for record in records:
        if record["reason"]:
            print(f"{record['params']['scene']}: {record['status']}: {record['reason']}", file=sys.stderr)
    return records


def row(*cells):
    print("| " + " | ".join(map(str, cells)) + " |", flush=True)


def header(*names):
    row(*names)
    row(*["---"] + ["---:"] * (len(names) - 1))


def segments(ptbench, device, _most):
    header("scene", "triangles", "samples, millions", "segments a sample", "the host tracer's", "difference")
    for record in cases(ptbench, device, "--spp", "1", "-a", f"scene=[{','.join(CLOSED + OPEN)}]", "--skip-time"):
        found, tree = record["validation"], record["tree"]
        mean, right = found["segments_per_sample"], found["reference_segments_per_sample"]
        row(record["params"]["scene"], tree["triangles"], f"{found['samples'] / 1e6:.1f}", f"{mean:.4f}", f"{right:.4f}",
            f"{100 * (mean / right - 1):+.3f} %")


def grown(folder, scene, shape, detail):
    """A shipped scene with another number of triangles, and a name of its own: the reference is of another picture."""
    text = json.loads((SCENES / f"{scene}.json").read_text(encoding="utf-8"))
    text["name"] = f"{scene}_{detail}"
    for mesh in text["meshes"]:
        if mesh.get("shape") == shape:
            mesh["detail"] = detail
    file = pathlib.Path(folder) / f"{scene}_{detail}.json"
    file.write_text(json.dumps(text), encoding="utf-8")
    return str(file)


def growth(ptbench, device, most):
    header("scene", "triangles", "bvh", "ns a segment", "build, ms", "ms a million", "bytes a triangle", "SAH", "depth")
    with tempfile.TemporaryDirectory() as folder:
        for scene, shape, factor, details in (("terrain", "terrain", 2, range(5, 13)), ("flake", "flake", 6560, range(0, 6))):
            for detail in details:
                if factor * 4 ** detail > most:
                    break
                for record in cases(ptbench, device, *TIMED, "--scene", grown(folder, scene, shape, detail)):
                    tree, time = record["tree"], record["statistics"]
                    row(scene, tree["triangles"], tree["layout"], f"{1e3 / time['msegments_per_s']:.0f}" if time else "-",
                        f"{tree['build_ms']:.1f}", f"{1e6 * tree['build_ms'] / tree['triangles']:.0f}",
                        f"{tree['bytes'] / tree['triangles']:.1f}", f"{tree['sah_cost']:.1f}", tree["depth"])


def splits(ptbench, device, _most):
    header("scene", "", "bvh_split", "nodes a ray", "triangles a ray", "SAH", "references a triangle", "time a segment")
    for scene in CLOSED + OPEN:
        first = None
        for record in cases(ptbench, device, *TIMED, "--scene", scene, "-a", f"bvh_split=[{','.join(SPLITS)}]", "--peaks"):
            tree, counted, time = record["tree"], record["counted"], record["statistics"]
            if not time:
                continue
            first = first or time["msegments_per_s"]
            row(scene, "closed" if scene in CLOSED else "open", record["params"]["bvh_split"],
                f"{counted['nodes_per_ray']:.2f}", f"{counted['triangles_per_ray']:.2f}", f"{tree['sah_cost']:.1f}",
                f"{tree['references'] / tree['triangles']:.2f}", f"{first / time['msegments_per_s']:.2f}")


def tessellated(folder, detail):
    """The thesis' scene, its balls as triangles; its walls, of which the camera sees a few degrees, stay spheres."""
    text = json.loads((SCENES / "thesis.json").read_text(encoding="utf-8"))
    balls = [sphere for sphere in text["spheres"] if sphere["radius"] < 1000]
    text["spheres"] = [sphere for sphere in text["spheres"] if sphere["radius"] >= 1000]
    text["meshes"] = [{"shape": "sphere", "detail": detail, "material": ball["material"],
                       "transform": {"scale": ball["radius"], "translate": ball["centre"]}} for ball in balls]
    file = pathlib.Path(folder) / f"thesis_{detail}.json"
    file.write_text(json.dumps(text), encoding="utf-8")
    return str(file)


def picture(ptbench, device, folder, scene, seed):
    file = f"{folder}/x.pfm"
    words = ("--kernel", "pt_nee", "--path-length", "10", "--size", "64", "--spp", "400", "--seed", str(seed))
    subprocess.run([ptbench, "render", "-q", "-d", device, "--scene", scene, *words, "-o", file], check=True)
    return [value for line in read_pfm(file) for value in line]


def difference(one, other):
    """Of the image means in percent, and of pixels as the root of their mean square over the mean."""
    mean = statistics.fmean(other)
    rms = math.sqrt(statistics.fmean((a - b) ** 2 for a, b in zip(one, other)))
    return 100 * (statistics.fmean(one) / mean - 1), rms / mean


def balls(ptbench, device, most):
    header("balls of", "triangles", "image mean", "pixels, rms")
    with tempfile.TemporaryDirectory() as folder:
        spheres = picture(ptbench, device, folder, "thesis", 1)
        for detail in range(0, int(min(most, 9)) + 1):
            mean, rms = difference(picture(ptbench, device, folder, tessellated(folder, detail), 2), spheres)
            row(f"detail {detail}", 4 * 8 * 4 ** detail, f"{mean:+.2f} %", f"{rms:.4f}")
        mean, rms = difference(picture(ptbench, device, folder, "thesis", 2), spheres)
        row("spheres, other random numbers", "-", f"{mean:+.2f} %", f"{rms:.4f}")


def main(ptbench, device, table, most=None):
    tables = {"segments": (segments, 0), "growth": (growth, 1e7), "splits": (splits, 0), "balls": (balls, 5)}
    make, usual = tables[table]
    make(ptbench, device, float(most) if most else usual)


if __name__ == "__main__":
    if len(sys.argv) not in (4, 5) or sys.argv[3] not in ("segments", "growth", "splits", "balls"):
        sys.exit(__doc__)
    main(*sys.argv[1:])
