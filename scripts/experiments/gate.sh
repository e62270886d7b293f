#!/usr/bin/env bash
# How often `ptbench ab` cries wolf and how often it sees a wolf, on simulated timings; prints a table (Markdown).
# Takes half a minute. `gate.sh SEED` repeats it with other random numbers.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

cmake --build build/release --target gate_experiment >&2
exec build/release/bin/gate_experiment "$@"
