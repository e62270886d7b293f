#!/usr/bin/env bash
# clang-tidy, with the checks of .clang-tidy, over the program's own .cpp files; any finding fails.
# usage: tidy.sh BUILD_FOLDER [FILE...]
set -euo pipefail
build=$(cd "$1" && pwd)
shift
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

tidy=''
for name in clang-tidy-14 clang-tidy; do
    if command -v "$name" >/dev/null; then tidy=$name && break; fi
done
if [ -z "$tidy" ]; then
    echo "no clang-tidy here" >&2
    [ -z "${PTB_STRICT-}" ] && exit 77 # ctest: skipped
    exit 1
fi

files=("$@")
if [ ${#files[@]} -eq 0 ]; then
    while IFS= read -r file; do
        if grep -qF "/$file\"" "$build/compile_commands.json"; then files+=("$file"); fi
    done < <(find core bench -name '*.cpp' | sort)
fi
# GCC's precompiled headers are not for clang.
commands=$(mktemp -d)
trap 'rm -r "$commands"' EXIT
sed -E 's| -Winvalid-pch -include [^ ]*cmake_pch.hxx||' "$build/compile_commands.json" >"$commands/compile_commands.json"
# Warnings are GCC's business; what clang does not know of GCC's flags is nobody's.
printf '%s\0' "${files[@]}" |
    xargs -0 -n 2 -P "$(nproc)" "$tidy" -p "$commands" --quiet --extra-arg=-Wno-everything
echo "${#files[@]} files"
