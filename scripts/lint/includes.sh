#!/usr/bin/env bash
# The rooms' borders: includes go kernels/shared <- core <- bench <- tests and never back; core reads no clock and prints
# nothing; kernels include kernels. That every header compiles alone is headers_alone.py's.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

failures=0
forbid() { # WHY PATTERN PATH...
    local found
    if found=$(grep -rnE --include='*.cpp' --include='*.h' --include='*.inl' --include='*.cl' "$2" "${@:3}"); then
        printf '%s:\n%s\n' "$1" "$found" >&2
        failures=$((failures + 1))
    fi
}

library=(core/file core/image core/input core/integrator core/mesh core/ocl core/oracle core/render core/scene core/source core/tree)
mapfile -t library < <(find "${library[@]}" -type f ! -name '*_main.cpp')
forbid 'core knows neither bench nor tests' '#include "(bench|tests)/' core
forbid 'bench knows no tests' '#include "tests/' bench
forbid 'core reads no clock' 'std::chrono|#include <(chrono|ctime|time.h)>|clock_gettime|gettimeofday' core
forbid 'core prints nothing' 'std::(cout|cerr|printf|puts)|[^_n]printf\(|fmt::print|#include <iostream>' "${library[@]}"
forbid 'kernels include kernels' '#include "(core|bench|tests)/' kernels
forbid 'only shared structs of the kernels reach the host' '#include "(lib|pt|thesis)/' core bench

[ "$failures" -eq 0 ]
