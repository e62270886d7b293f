#!/usr/bin/env bash
# triangles.sh DEVICE SCENE...: Gsegments/s of `pt` in scenes of triangles, and what other waits of a warp's lanes are worth (P:
# how many that are done go on together, Q: how many keep the others at nodes), no waits, and other trees. DEVICE is a key as
# `ptbench list` has it; SCENE a file. Prints a table (Markdown); takes minutes.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

if [ $# -lt 2 ]; then
    echo "usage: triangles.sh DEVICE SCENE..." >&2
    exit 2
fi
[ -n "${TRIANGLES_EXPERIMENT-}" ] || cmake --build build/release --target triangles_experiment >&2
binary=$(realpath "${TRIANGLES_EXPERIMENT-build/release/bin/triangles_experiment}")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

with() { # NAME SED FILE
    cp -r kernels "$folder/$1"
    sed -i "$2" "$folder/$1/$3"
    if cmp -s "kernels/$3" "$folder/$1/$3"; then
        echo "nothing to change in kernels/$3 for $1" >&2
        exit 1
    fi
}

cp -r kernels "$folder/usual"
for waits in 1,14 4,14 8,14 14,14 11,1 11,8 11,12 11,18; do
    with "P${waits%,*}_Q${waits#*,}" "s/\(define SEARCH_DONE\) .*/\1 ${waits%,*}u/; s/\(define SEARCH_AT_NODES\) .*/\1 ${waits#*,}u/" scene/search.h
done
with no_waits 's/ifdef SCENE_PAUSES/ifdef SCENE_PAUSES_NEVER/' scene/meet.h
scenes=()
for scene in "${@:2}"; do scenes+=("$(realpath "$scene")"); done
cd "$folder"
"$binary" "$1" "${scenes[@]}" -- usual P*_Q* no_waits
