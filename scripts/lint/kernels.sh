#!/usr/bin/env bash
# Compiles every kernel alone as strict OpenCL C 1.2, for every lane width and for what scenes and machines switch on.
# Holds that a build that does not count has no token of what counts.
# usage: kernels.sh [FOLDER OF kernels...]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

clang=''
for name in clang clang-{21..13}; do
    if command -v "$name" >/dev/null; then clang=$name && break; fi
done
if [ -z "$clang" ]; then
    echo "no clang here" >&2
    [ -z "${PTB_STRICT-}" ] && exit 77 # ctest: skipped
    exit 1
fi

folders=("${@/#/kernels/}")
[ $# -gt 0 ] || folders=(kernels)

checks=0 failures=0
check() { # FILE OPTIONS...
    checks=$((checks + 1))
    if ! "$clang" -x cl -cl-std=CL1.2 -Xclang -finclude-default-header -fsyntax-only -Wall -Wextra -Werror \
        -Wno-unused-function -Ikernels "${@:2}" "$1"; then
        echo "in $1 with ${*:2}" >&2
        failures=$((failures + 1))
    fi
}

careful=(-DSCENE_CAREFUL_BEGIN=1u -DSCENE_CAREFUL_END=4u -DSCENE_DISTANT_BEGIN=2u -DSCENE_DISTANT_END=3u)
few=(-DSCENE_LONE_LAMP=2 -DSCENE_FEW=9 -DSCENE_OPAQUE=8 -DSCENE_ZERO_X=0x3c -DSCENE_ZERO_Y=0x13 -DSCENE_ZERO_Z=0xf)
while IFS= read -r kernel; do
    for lanes in 1 4 8 16 32; do
        if [[ $lanes -eq 32 && $kernel == */peaks.cl ]]; then continue; fi # it needs built-ins, which end at 16
        if [[ $lanes -gt 1 && $kernel == */rays.cl ]]; then continue; fi   # among triangles rays are alone
        portable=(-target spir64 "-DPTB_LANES=$lanes")
        check "$kernel" "${portable[@]}" -DSCENE_GLOWS -DENGINE_BOUNDED -DSCENE_LONE_LAMP=1 -DENGINE_SPLIT_ATOMICS -DENGINE_PATH_LENGTH=1
        check "$kernel" "${portable[@]}" -DSCENE_FEW=4 -DSCENE_OPAQUE=2 -DSCENE_MANY_LAMPS -DENGINE_ROULETTE -DENGINE_IMAGE_FILM
        check "$kernel" "${portable[@]}" -DSCENE_SIDE_WORDS=3 -DSCENE_SPHERES=2 -DSCENE_SURFACES=2 -DSCENE_GLOWS -DSCENE_MANY_LAMPS -DENGINE_IMAGE_FILM -DPTB_COUNT -DENGINE_ROULETTE
        check "$kernel" "${portable[@]}" -DSCENE_FEW=4 -DSCENE_OPAQUE=2 -DSCENE_LONE_LAMP=2 "${careful[@]}"
        check "$kernel" "${portable[@]}" -DSCENE_MANY_LAMPS "${careful[@]}" -DPTB_COUNT
        check "$kernel" "${portable[@]}" "${few[@]}" -DPTB_PORTABLE
        check "$kernel" "${portable[@]}" -DSCENE_SIDE_WORDS=3 -DSCENE_SPHERES=2 -DSCENE_SURFACES=2 -DENGINE_FILTER=1 -DSCENE_MANY_LAMPS
        check "$kernel" "${portable[@]}" "${few[@]}" -DPTB_STRICT -DSCENE_SPHERES=4 -DSCENE_SURFACES=4 -DPTB_PARK_MILLER
        check "$kernel" "${portable[@]}" -DSCENE_SPHERES=3 -DSCENE_SURFACES=3 -DSCENE_COUNT=40 -DSCENE_FACES=45 -DENGINE_FILTER=2 -DSCENE_LONE_LAMP=2
        # With these the tables become register permutes: for PoCL's compiler and for Intel's.
        x86='-target x86_64-unknown-linux-gnu -DPOCL_DEVICE_ADDRESS_BITS=64'
        for machine in "$x86 -mavx512f -mavx512vl -DPTB_WIDTH=16" "$x86 -mavx2 -mfma -DPTB_WIDTH=8" \
            '-target spir64 -D__INTEL_LLVM_COMPILER -DPTB_WIDTH=16' '-target spir64 -D__INTEL_LLVM_COMPILER -DPTB_WIDTH=8'; do
            # shellcheck disable=SC2086 # several words
            check "$kernel" $machine "-DPTB_LANES=$lanes" "${few[@]}"
            # shellcheck disable=SC2086 # several words
            check "$kernel" $machine "-DPTB_LANES=$lanes" "${few[@]}" -DPTB_COUNT
        done
    done
    for tree in 2 8; do
        meshes=("-DSCENE_TREE=$tree" -DTREE_STACK=16 -DSCENE_MANY_LAMPS)
        check "$kernel" -target spir64 "${meshes[@]}" -DENGINE_ALONE -DSCENE_GLASS
        check "$kernel" -target spir64 "${meshes[@]}" -DSCENE_PAUSES -DSCENE_GLOWS -DENGINE_ROULETTE
        check "$kernel" -target spir64 "${meshes[@]}" -DSCENE_SPHERES=2 -DSCENE_SURFACES=2 -DSCENE_SIDE_WORDS=3 -DPTB_COUNT -DPTB_STRICT
        check "$kernel" -target x86_64-unknown-linux-gnu -mavx2 -mfma -DPOCL_DEVICE_ADDRESS_BITS=64 "${meshes[@]}" -DENGINE_ALONE
    done
    check "$kernel" -target spir64 "${few[@]}" -DSCENE_CARRIED -DSCENE_SURFACES=3 -DENGINE_BATCH=6
    check "$kernel" -target spir64 "${few[@]}" -DSCENE_CARRIED -DSCENE_SURFACES=3 -DENGINE_BATCH=6 -DPTB_COUNT
    if "$clang" -x cl -E -P -Ikernels "$kernel" | grep -i counted; then
        echo "in $kernel without PTB_COUNT" >&2
        failures=$((failures + 1))
    fi
done < <(find "${folders[@]}" -name '*.cl' | sort)

echo "$checks compilations with $clang, $failures failed"
[ "$checks" -gt 0 ] && [ "$failures" -eq 0 ]
