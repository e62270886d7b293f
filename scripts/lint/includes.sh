#!/usr/bin/env bash
# The rooms' borders: includes go kernels/shared <- core <- bench <- tests and never back; core reads no clock and prints
# nothing; kernels include kernels; every header compiles alone.
# usage: includes.sh BUILD_FOLDER
set -euo pipefail
build=$(cd "$1" && pwd)
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
export build

failures=0
forbid() { # WHY PATTERN PATH...
    local found
    if found=$(grep -rnE --include='*.cpp' --include='*.h' --include='*.inl' --include='*.cl' "$2" "${@:3}"); then
        printf '%s:\n%s\n' "$1" "$found" >&2
        failures=$((failures + 1))
    fi
}

library=(core/file core/image core/input core/integrator core/ocl core/oracle core/render core/scene core/source)
mapfile -t library < <(find "${library[@]}" -type f ! -name '*_main.cpp')
forbid 'core knows neither bench nor tests' '#include "(bench|tests)/' core
forbid 'bench knows no tests' '#include "tests/' bench
forbid 'core reads no clock' 'std::chrono|#include <(chrono|ctime|time.h)>|clock_gettime|gettimeofday' core
forbid 'core prints nothing' 'std::(cout|cerr|printf|puts)|[^_n]printf\(|fmt::print|#include <iostream>' "${library[@]}"
forbid 'kernels include kernels' '#include "(core|bench|tests)/' kernels
forbid 'only shared structs of the kernels reach the host' '#include "(lib|pt|thesis)/' core bench

compile_alone() { # HEADER: with the flags that the build uses for its room
    local flags
    flags=$(python3 - "$build/compile_commands.json" "$1" <<'PYTHON'
import json, re, shlex, sys
room = "/" + sys.argv[2].split("/")[0] + "/"
commands = [c for c in json.load(open(sys.argv[1])) if room in c["file"] and c["file"].endswith(".cpp")]
words = shlex.split(commands[0]["command"])
kept, skip = [], False
for word in words:
    if skip:
        kept.append(word)
        skip = False
    elif word in ("-I", "-isystem"):
        kept.append(word)
        skip = True
    elif re.match(r"-(I|isystem|D|std=)", word):
        kept.append(word)
print("\n".join(kept))
PYTHON
    )
    mapfile -t flags <<<"$flags"
    # Not the main file itself, or GCC would speak of the pragma.
    if ! g++ "${flags[@]}" -Ikernels -I. -fsyntax-only -Wall -Wextra -Werror -x c++ - <<<"#include \"$1\""; then
        echo "$1 does not compile alone" >&2
        return 1
    fi
}
export -f compile_alone
# shellcheck disable=SC2016 # the inner shell expands it
if ! find core bench kernels/shared -name '*.h' ! -path '*/tests/*' -print0 |
    xargs -0 -n 1 -P "$(nproc)" bash -c 'compile_alone "$0"'; then
    failures=$((failures + 1))
fi

[ "$failures" -eq 0 ]
