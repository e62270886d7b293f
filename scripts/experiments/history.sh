#!/usr/bin/env bash
# What `ptbench report --history` marks in simulated histories of 30 runs: wrong marks, found changes, and how soon; prints
# a table (Markdown). Takes a minute. `history.sh SEED` repeats it with other random numbers.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

cmake --build build/release --target history_experiment >&2
exec build/release/bin/history_experiment "$@"
