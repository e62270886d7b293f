#!/usr/bin/env python3
"""counted.py RENDER_ONCE KERNEL SCENE [PATH_LENGTH [WORD...]]: what the instrumented build of a kernel counts with one lane a work-item,
against the instructions that Oclgrind sees in the measured build of the same small render: the latter may be 0.1 %
more. Work of no use is not counted: `pt` makes camera rays for samples that there are not, and begins searches for them,
which are taken off here. WORDs choose a variant."""
import os
import re
import shutil
import subprocess
import sys

MORE = 0.001
PIXELS, SPP = 35, 4
# Instructions of vectors count as one: THESIS_WIDTH does so too. A call of dot stands for 7 operations, one
# of normalize for those, a root, a division and a product with a vector.
FLOPS = {"fadd": 1, "fsub": 1, "fmul": 1, "call llvm.fmuladd.f32()": 2, "call llvm.fmuladd.v4f32()": 2,
         "call _Z3dotDv4_fS_()": 7, "call _Z9normalizeDv4_f()": 8}
ROOTS = {"call _Z11native_sqrtf()": 1, "call _Z4sqrtf()": 1, "call _Z9normalizeDv4_f()": 1}
DIVISIONS = {"fdiv": 1, "call _Z9normalizeDv4_f()": 1}
# Copies of materials and tallies are calls. The queue's atomic counter is not counted.
BYTES = {"load global": r"\((\d+) bytes\)", "store global": r"\((\d+) bytes\)"}
COPIED_BYTES = {"call llvm.memcpy.p0i8.p1i8.i64()": 48, "call llvm.memcpy.p1i8.p0i8.i64()": 48}
CAMERA_RAY = {"flops": 22, "roots": 1, "divisions": 1, "bytes": 0}
# A search that a lane begins when there is no work left, past the two spheres of mesh_room; in a quantised tree, more.
IDLE_SEARCH = {"flops": 13 + 2 * 16 + 15, "roots": 2, "divisions": 4, "bytes": 0}
IDLE_ON_GRID = {"flops": 21, "roots": 0, "divisions": 0, "bytes": 0}


def rendered(render_once, kernel, scene, path_length, *options):
    command = ["oclgrind", "--inst-counts", "--build-options", "-cl-opt-disable -DTHESIS_WIDTH=1u",
               render_once, kernel, "1", scene, str(SPP), path_length, *options]
    said = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    assert "Oclgrind" in said, "the render was not Oclgrind's"
    return said


def take_off(total, work, times):
    for key, number in work.items():
        total[key] -= number * times


def seen(said, on_grid):
    """Operations and bytes of all kernels but those that make rays, before anything is timed or counted."""
    said = re.sub(r"^Instructions executed for kernel '\w+_make':\n(?:.*\n)*?(?=\S|\Z)", "", said, flags=re.M)
    lines = re.findall(r"^ +(\d+) - ((?:load |store )?[^ \n]+(?: [^ \n(]+\(\))?)(.*)$", said, re.M)
    total = dict.fromkeys(("flops", "roots", "divisions", "bytes"), 0)
    for times, name, rest in lines:
        for key, table in (("flops", FLOPS), ("roots", ROOTS), ("divisions", DIVISIONS), ("bytes", COPIED_BYTES)):
            total[key] += int(times) * table.get(name, 0)
        if name in BYTES:
            total["bytes"] += int(re.search(BYTES[name], rest)[1])
        if name == "call refill()":
            take_off(total, CAMERA_RAY, int(times) - PIXELS * SPP)
    calls = {name: int(times) for times, name, _ in lines if name.startswith("call ")}
    begun, ended = (sum(calls.get(f"call {name}()", 0) for name in names)
                    for names in (("begin_search", "begin_meeting"), ("end_search", "has_seen")))
    idle = begun - ended if "call search_begin()" in calls else 0
    take_off(total, IDLE_SEARCH, idle)
    if on_grid:
        take_off(total, IDLE_ON_GRID, idle)
    return total


def counted(said):
    return {name: int(number) for number, name in re.findall(r"(\d+) (\w+)", re.search("counted: (.*)", said)[1])}


def main(render_once, kernel, scene, path_length="16", *variant):
    if not shutil.which("oclgrind"):
        print("no oclgrind here", file=sys.stderr)
        return 1 if os.environ.get("PTB_STRICT") else 77
    instructions = seen(rendered(render_once, kernel, scene, path_length, *variant), "bvh=bvh2q" in variant)
    counts = counted(rendered(render_once, kernel, scene, path_length, " -DPTB_COUNT", *variant))
    failures = 0
    for name, number in instructions.items():
        ratio = number / counts[name] if counts[name] else float(number == 0)
        fits = 1 <= ratio <= 1 + MORE
        failures += not fits
        print(f"{kernel} {scene}: {name}: {number} seen, {counts[name]} counted, {100 * ratio - 100:+.2f} %"
              f"{'' if fits else ' WRONG'}")
    return failures > 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
