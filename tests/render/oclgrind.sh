#!/usr/bin/env bash
# oclgrind.sh RENDER_ONCE KERNEL LANES SCENE [AXIS=VALUE...]: a small render under Oclgrind, which must find no race, no use of
# uninitialised values and no access out of bounds.
set -euo pipefail

if ! command -v oclgrind >/dev/null; then
    echo "no oclgrind here" >&2
    [ -z "${PTB_STRICT-}" ] && exit 77 # ctest: skipped
    exit 1
fi
log=$(mktemp)
trap 'rm -f "$log"' EXIT
# Unoptimised: Oclgrind 21.10 does not know the rotations that the optimiser makes.
said=$(oclgrind --build-options -cl-opt-disable --data-races --uninitialized --max-errors 20 --log "$log" "$@")
echo "$said"
if [[ $said != *Oclgrind* ]]; then
    echo "the render was not Oclgrind's" >&2
    exit 1
fi
cat "$log" >&2
[ ! -s "$log" ]
