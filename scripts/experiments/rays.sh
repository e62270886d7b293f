#!/usr/bin/env bash
# rays.sh [SCENE...] [-- KERNEL_DIR [KERNEL_DIR]]: rays through trees of triangles against Embree's, or two folders of kernels
# against each other; prints a table (Markdown). A SCENE is a file; without any, the shipped ones. Wants libembree-dev. Takes
# minutes.
# rays.sh --tinybvh FOLDER [-d DEVICE] [SCENE...]: on an OpenCL device against tinybvh's own OpenCL kernels, which lie in FOLDER
# with tiny_bvh.h. DEVICE is a key as `ptbench list` has it (pocl:0).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

tinybvh='' device=pocl:0
if [ "${1-}" = --tinybvh ]; then
    tinybvh=$(realpath "${2-}")
    shift 2
    if [ "${1-}" = -d ]; then
        device=${2-}
        shift 2
    fi
fi
scenes=()
while [ $# -gt 0 ] && [ "$1" != -- ]; do
    scenes+=("$1")
    shift
done
[ ${#scenes[@]} -gt 0 ] || for name in flake knot menger hair slivers; do scenes+=("configs/scenes/$name.json"); done

if [ -n "$tinybvh" ]; then
    cmake "-DPTBENCH_TINYBVH=$tinybvh" build/release >/dev/null
    cmake --build build/release --target tinybvh_experiment >&2
    exec build/release/bin/tinybvh_experiment "$device" "$tinybvh" "${scenes[@]}"
fi
cmake -DPTBENCH_EMBREE=ON build/release >/dev/null
cmake --build build/release --target rays_experiment >&2
exec env POCL_MAX_PTHREAD_COUNT=1 build/release/bin/rays_experiment "${scenes[@]}" "$@"
