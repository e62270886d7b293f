#!/usr/bin/env bash
# rays.sh [KERNEL_DIR [KERNEL_DIR]]: rays through trees of triangles against Embree's, or two folders of kernels against
# each other; prints a table (Markdown). Wants libembree-dev. Takes minutes.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

cmake -DPTBENCH_EMBREE=ON build/release >/dev/null
cmake --build build/release --target rays_experiment >&2
exec env POCL_MAX_PTHREAD_COUNT=1 build/release/bin/rays_experiment "$@"
