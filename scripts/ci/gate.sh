#!/usr/bin/env bash
# Is this tree slower than another revision? Builds both, measures them alternately with `ptbench ab`, and exits as it
# does: 0 no, 3 yes (docs/ci.md has the table). For any CI on Debian or Ubuntu:
#   scripts/ci/gate.sh REVISION [options of `ptbench ab`]
# Leaves gate.json (the decision, with all samples) and gate.md in $PTBENCH_GATE_DIR [gate-results], and appends the
# latter to $GITHUB_STEP_SUMMARY where that is set.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
# shellcheck source=scripts/packages.sh
. "$root/scripts/packages.sh"
if [ $# -eq 0 ]; then
    echo "usage: gate.sh REVISION [options of ptbench ab]" >&2
    exit 2
fi
revision=$1
shift
results=${PTBENCH_GATE_DIR:-gate-results}
mkdir -p "$results"

base=$(mktemp -d)
trap 'git -C "$root" worktree remove --force "$base/tree" 2>/dev/null || true; rm -rf "$base"' EXIT
quietly git -C "$root" worktree add --detach "$base/tree" "$revision"
install_missing "$PACKAGES_TO_BUILD"
build_ptbench "$base/tree"
build_ptbench "$root"

code=0
"$root/build/release/bin/ptbench" ab --base "$base/tree/build/release/bin/ptbench" \
    --new "$root/build/release/bin/ptbench" --json "$results/gate.json" --md "$results/gate.md" "$@" || code=$?
if [ -n "${GITHUB_STEP_SUMMARY-}" ] && [ -f "$results/gate.md" ]; then
    cat "$results/gate.md" >>"$GITHUB_STEP_SUMMARY"
fi
exit "$code"
