#!/usr/bin/env bash
# clang-tidy, with the checks of .clang-tidy, over the program's own .cpp files; any finding fails.
# usage: tidy.sh BUILD_FOLDER [FILE...]; no test runs it: all takes some minutes of two cores.
set -euo pipefail
build=$(cd "$1" && pwd)
shift
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

tidy=''
for name in clang-tidy clang-tidy-14; do
    if command -v "$name" >/dev/null; then tidy=$name && break; fi
done
if [ -z "$tidy" ]; then
    echo "no clang-tidy here" >&2
    [ -z "${PTB_STRICT-}" ] && exit 77 # ctest: skipped
    exit 1
fi

# What the build compiles of core and bench; with PTBENCH_UNITY that is a folder at a time, which is much faster, but sees no
# unused using-declarations.
files=("$@")
if [ ${#files[@]} -eq 0 ]; then
    mapfile -t files < <(sed -nE 's|^ *"file": "(.*)",?$|\1|p' "$build/compile_commands.json" |
        grep -E "^($PWD/(core|bench)/|$build/(core|bench)/.*/Unity/)" | grep -v cmake_pch | sort -u)
fi
if [ ${#files[@]} -eq 0 ]; then
    echo "$build compiles nothing of core and bench" >&2
    exit 1
fi
# GCC's precompiled headers are not for clang.
commands=$(mktemp -d)
trap 'rm -r "$commands"' EXIT
sed -E 's| -Winvalid-pch -include [^ ]*cmake_pch.hxx||' "$build/compile_commands.json" >"$commands/compile_commands.json"
# A folder's compilation includes .cpp files on purpose.
# Warnings are GCC's business; what clang does not know of GCC's flags is nobody's.
printf '%s\0' "${files[@]}" |
    xargs -0 -n 1 -P "$(nproc)" "$tidy" -p "$commands" --quiet \
        --checks=-bugprone-suspicious-include --extra-arg=-Wno-everything
echo "${#files[@]} compilations"
