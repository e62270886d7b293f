#!/usr/bin/env bash
# How often `ptbench tune` picks one of the best candidates, and at what cost, on simulated timings; prints a table
# (Markdown). Takes seconds. `race.sh SEED` repeats it with other random numbers.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

cmake --build build/release --target race_experiment >&2
exec build/release/bin/race_experiment "$@"
