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

# The flags that the build uses for a room.
flags_of() { # ROOM
    python3 - "$build/compile_commands.json" "/$1/" <<'PYTHON'
import json, re, shlex, sys
command = next(c for c in json.load(open(sys.argv[1])) if sys.argv[2] in c["file"] and c["file"].endswith(".cpp"))
words = shlex.split(command["command"])
for word, following in zip(words, words[1:]):
    if word in ("-I", "-isystem"):
        print(word, following, sep="\n")
    elif re.match(r"-(I.|isystem.|D|std=)", word):
        print(word)
PYTHON
}
flags=$(mktemp -d)
trap 'rm -r "$flags"' EXIT
for room in core bench; do flags_of "$room" >"$flags/$room"; done
cp "$flags/core" "$flags/kernels"
export flags

compile_alone() { # HEADER
    local words
    mapfile -t words <"$flags/${1%%/*}"
    # Not the main file itself, or GCC would speak of the pragma.
    if ! g++ "${words[@]}" -Ikernels -I. -fsyntax-only -Wall -Wextra -Werror -x c++ - <<<"#include \"$1\""; then
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
