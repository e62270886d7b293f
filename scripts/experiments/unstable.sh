#!/usr/bin/env bash
# How many rows that are over 5 % off are called unstable, and how many that are right, on simulated samples; prints a
# table (Markdown). Takes seconds. `unstable.sh SEED` repeats it with other random numbers.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

cmake --build build/release --target unstable_experiment >&2
exec build/release/bin/unstable_experiment "$@"
