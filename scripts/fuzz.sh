#!/usr/bin/env bash
# Fuzzes the readers of text that nobody vouches for, one after the other: scripts/fuzz.sh [seconds each] [target...]
# Needs clang with libclang-rt-dev. What it finds lies in build/fuzz/found/ and fails the script; what it reaches
# is kept in build/fuzz/reached/, and `scripts/fuzz.sh minimise` takes the least of it into the tree's corpus.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
corpus=tests/fuzz/corpus reached=build/fuzz/reached found=build/fuzz/found
limits=(-rss_limit_mb=1024 -malloc_limit_mb=512 -timeout=10 -max_len=16384)

build() {
    cmake --preset fuzz >/dev/null
    nice cmake --build --preset fuzz -j2
}

# Adds to the tree's corpus the smallest of the fewest files that reach every edge, 5 kB of them.
minimise() { # TARGET
    local least=$reached/$1.least size file room=5000
    rm -rf "$least" && mkdir "$least"
    "build/fuzz/bin/fuzz_$1" -set_cover_merge=1 -use_counters=0 "${limits[@]}" "$least" "$corpus/$1" "$reached/$1"
    while read -r size file; do
        room=$((room - size))
        if [ "$room" -lt 0 ]; then break; fi
        cp "$file" "$corpus/$1/"
    done < <(find "$least" -type f -size +15c -printf '%s %p\n' | sort -n)
}

# The schemas' words.
words() {
    grep -oh '"[^"\\]*"' configs/schema/*.json | sort -u | sed 's/^"\(.*\)"$/"\\"\1\\""/'
}

build
mkdir -p "$found"
words >build/fuzz/words
seconds=${1:-600}
targets=("${@:2}")
if [ ${#targets[@]} -eq 0 ]; then targets=(result journal config scene mesh protocol); fi
failures=0
for target in "${targets[@]}"; do
    mkdir -p "$reached/$target"
    if [ "$seconds" = minimise ]; then minimise "$target" && continue; fi
    echo "== $target"
    nice "build/fuzz/bin/fuzz_$target" -max_total_time="$seconds" "${limits[@]}" -artifact_prefix="$found/$target-" \
        -print_final_stats=1 -verbosity=0 -dict=build/fuzz/words "$reached/$target" "$corpus/$target" ||
        failures=$((failures + 1))
done
[ "$failures" -eq 0 ]
