#!/usr/bin/env bash
# oclgrind.sh RENDER_ONCE KERNEL LANES SCENE: a small render under Oclgrind, which must find no race and
# no access out of bounds. (Uninitialised reads are not asked for: it does not follow filled buffers.)
set -euo pipefail

if ! command -v oclgrind >/dev/null; then
    echo "no oclgrind here" >&2
    [ -z "${PTB_STRICT-}" ] && exit 77 # ctest: skipped
    exit 1
fi
log=$(mktemp)
trap 'rm -f "$log"' EXIT
# Oclgrind does not know the rotations that the optimiser makes of shifts, so it gets the kernels as written.
said=$(oclgrind --build-options -O0 --data-races --max-errors 20 --log "$log" "$@")
echo "$said"
if [[ $said != *Oclgrind* ]]; then
    echo "the render was not Oclgrind's" >&2
    exit 1
fi
cat "$log" >&2
[ ! -s "$log" ]
