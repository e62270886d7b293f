#!/usr/bin/env bash
# From a fresh clone to a table of every OpenCL device: installs what is missing, builds ptbench, runs it.
#   scripts/bench.sh [options of `ptbench run`]         measures, on all devices unless -d chooses
#   scripts/bench.sh list|render|compare|... [options]  any other command of ptbench
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# shellcheck source=scripts/packages.sh
. "$root/scripts/packages.sh"

install_missing "$PACKAGES_TO_BUILD"
build_ptbench "$root"

ptbench=$root/build/release/bin/ptbench
case "${1-}" in
    run) shift ;;
    '' | -*) ;;
    *) exec "$ptbench" "$@" ;;
esac
for word in "$@"; do
    case "$word" in -d* | --device | --device=*) exec "$ptbench" "$@" ;; esac
done
exec "$ptbench" --all-devices "$@"
