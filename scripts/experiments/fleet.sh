#!/usr/bin/env bash
# How often a fleet's report calls a good card slow, and how often it finds a slow one, on simulated times; prints a table
# (Markdown). Takes ten seconds. `fleet.sh SEED` repeats it with other random numbers.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

cmake --build build/release --target fleet_experiment >&2
exec build/release/bin/fleet_experiment "$@"
