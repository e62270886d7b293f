#!/usr/bin/env bash
# From a fresh clone to the tests' verdict: installs what is missing, builds everything, runs ctest.
#   scripts/test.sh                  what CI runs; unit and some of cli under sanitizers
#   scripts/test.sh --long           every test (tests/README.md)
#   scripts/test.sh [ctest options]  what the options choose: -L unit, -R layout, ...
# The last lines are ctest's summary; the exit code is ctest's.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# shellcheck source=scripts/packages.sh
. "$root/scripts/packages.sh"

install_missing "$PACKAGES_TO_BUILD_TESTS"
install_missing "$PACKAGES_TO_RUN_TESTS" & # arrive while the tests are built
installing=$!
trap 'wait "$installing" || true' EXIT # never leaves apt alone
cd "$root"

# Everything is built, so folders are compiled at once.
options=(-DPTBENCH_UNITY=ON)
if command -v ccache >/dev/null; then options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache -DPTBENCH_PCH=OFF); fi
strict=()
if [ -n "${PTB_STRICT-}" ]; then strict=(-DCMAKE_CXX_FLAGS=-Werror); fi

case $* in
    '') tests=(--label-exclude '^long$') sanitized=$root/build/asan ;;
    --long) tests=() sanitized=$root/build/asan ;;
    *) tests=("$@") sanitized='' ;;
esac
if [ -n "$sanitized" ]; then quietly cmake --preset asan "${options[@]}"; fi
quietly cmake --preset release -DPTBENCH_TESTS=ON -DPTBENCH_MICRO=ON "-DPTBENCH_SANITIZED_TREE=$sanitized" \
    "${options[@]}" ${strict[@]+"${strict[@]}"}
cmake --build build/release
if [ -n "$sanitized" ]; then cmake --build build/asan --target unit_tests ptbench; fi
wait "$installing"

exec ctest --test-dir build/release --output-on-failure --parallel "$(nproc)" ${tests[@]+"${tests[@]}"}
