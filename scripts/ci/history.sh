#!/usr/bin/env bash
# Adds a run of this tree to a folder of results, and shows how times have changed over all of them. For any CI on Debian
# or Ubuntu that keeps the folder from run to run:
#   scripts/ci/history.sh FOLDER [options of `ptbench run`]
# Leaves FOLDER/DATE-REVISION.json, and the history as FOLDER/index.html and FOLDER/history.md; the latter is appended to
# $GITHUB_STEP_SUMMARY where that is set. Exits as the run does.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
# shellcheck source=scripts/packages.sh
. "$root/scripts/packages.sh"
if [ $# -eq 0 ]; then
    echo "usage: history.sh FOLDER [options of ptbench run]" >&2
    exit 2
fi
folder=$1
shift
if [ $# -eq 0 ]; then set -- --config ci; fi
mkdir -p "$folder"

install_missing "$PACKAGES_TO_BUILD"
build_ptbench "$root"
ptbench=$root/build/release/bin/ptbench
name=$(date -u +%Y-%m-%dT%H%M%SZ)-$(git -C "$root" rev-parse --short HEAD)
outputs=$(mktemp -d)
trap 'rm -rf "$outputs"' EXIT

code=0
"$ptbench" "$@" --out "$outputs/run" --json "$folder/$name.json" || code=$?
reported=0
"$ptbench" report --history "$folder" --html "$folder/index.html" --md "$folder/history.md" || reported=$?
if [ "$code" -eq 0 ]; then code=$reported; fi
if [ -n "${GITHUB_STEP_SUMMARY-}" ] && [ -e "$folder/history.md" ]; then cat "$folder/history.md" >>"$GITHUB_STEP_SUMMARY"; fi
exit "$code"
