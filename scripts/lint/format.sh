#!/usr/bin/env bash
# clang-format says nothing about any C++ file. `scripts/lint/format.sh --fix` lets it have its way.
# Kernels are laid out by hand.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

# Versions lay code out differently; this one is in Debian 12 and in Ubuntu 22.04 and 24.04.
format=clang-format-14
if ! command -v $format >/dev/null; then
    echo "no $format here" >&2
    [ -z "${PTB_STRICT-}" ] && exit 77 # ctest: skipped
    exit 1
fi
arguments=(--dry-run -Werror)
if [ "${1-}" = --fix ]; then arguments=(-i); fi
find core bench tests scripts \( -name '*.cpp' -o -name '*.h' -o -name '*.inl' \) -print0 | xargs -0 $format "${arguments[@]}"
