#!/usr/bin/env bash
# From a fresh clone to a table of every OpenCL device: installs what is missing, builds ptbench, runs it.
#   scripts/bench.sh [options of `ptbench run`]         measures, on all devices unless -d chooses
#   scripts/bench.sh list|render|compare|... [options]  any other command of ptbench
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# shellcheck source=scripts/packages.sh
. "$root/scripts/packages.sh"

build() {
    # A tree that is configured already (by test.sh, by hand) is used as it is.
    if [ ! -f "$root/build/release/build.ninja" ]; then
        echo "Configuring ..." >&2
        (cd "$root" && quietly cmake --preset release -DPTBENCH_TESTS=OFF -DPTBENCH_MICRO=OFF)
    fi
    if [ ! -x "$root/build/release/bin/ptbench" ]; then echo "Building ptbench (a minute or two, once) ..." >&2; fi
    quietly cmake --build "$root/build/release" --target ptbench
}

install_missing "$PACKAGES_TO_BUILD"
build

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
