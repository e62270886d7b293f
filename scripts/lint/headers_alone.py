#!/usr/bin/env python3
"""Compiles every header of core, bench and kernels/shared alone, with the includes and definitions of the build.

usage: headers_alone.py BUILD/compile_commands.json     from the tree's root

A header that reaches all of a base below, however far, sees it precompiled: what it needs of it, it has by its includes, and
those are compiled alone as well. The rest of its includes is read as it stands."""

import functools
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

# The last of these that fits is taken.
BASES = (("string", "vector"), ("filesystem", "string", "vector"), ("core/ocl/opencl.h", "filesystem", "string", "vector"),
         ("core/input/json.h",))
COMPILE = ("-fsyntax-only", "-Wall", "-Wextra", "-Werror", "-x", "c++", "-")


def build_flags(database):
    """Where the build looks for includes, and what it defines, for a file of bench."""
    command = next(c["command"] for c in json.loads(pathlib.Path(database).read_text(encoding="utf-8"))
                   if "/bench/" in c["file"] and c["file"].endswith(".cpp"))
    words = shlex.split(command)
    flags = ["-Ikernels", "-I."]
    for word, following in zip(words, words[1:]):
        if word in ("-I", "-isystem"):
            flags += [word, following]
        elif re.match(r"-(I.|isystem.|D|std=)", word):
            flags.append(word)
    return flags


@functools.cache
def reached(header):
    """What a header includes, and what those of ours do in turn."""
    names = re.findall(r'^#include ["<]([^>"]+)', pathlib.Path(header).read_text(encoding="utf-8"), re.M)
    ours = [file for name in names for file in (name, f"kernels/{name}") if os.path.exists(file)]
    return frozenset(names).union(*map(reached, ours))


def precompile(number, flags, folder):
    header = folder / f"{number}.h"
    header.write_text("".join(f"#include <{name}>\n" for name in BASES[number]))
    subprocess.run(["g++", *flags, "-Wall", "-Wextra", "-x", "c++-header", header, "-o", f"{header}.gch"], check=True)


def compile_alone(header, flags, folder):
    """What the compiler says against it; nothing otherwise."""
    fitting = [number for number, base in enumerate(BASES) if reached(header).issuperset(base)]
    base = ["-Winvalid-pch", "-include", folder / f"{fitting[-1]}.h"] if fitting else []
    # Not the main file itself, or GCC would speak of the pragma.
    ran = subprocess.run(["g++", *flags, *base, *COMPILE], input=f'#include "{header}"\n', capture_output=True, text=True)
    return f"{ran.stderr}{header} does not compile alone" if ran.returncode else ""


def main(database):
    flags = build_flags(database)
    headers = sorted(str(file) for room in ("core", "bench", "kernels/shared") for file in pathlib.Path(room).rglob("*.h"))
    with tempfile.TemporaryDirectory() as name, ThreadPoolExecutor(os.cpu_count()) as pool:
        folder = pathlib.Path(name)
        list(pool.map(lambda number: precompile(number, flags, folder), range(len(BASES))))
        faults = [fault for fault in pool.map(lambda header: compile_alone(header, flags, folder), headers) if fault]
    print(f"{len(headers)} headers, {len(faults)} do not compile alone")
    sys.exit("\n".join(faults) or 0)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
