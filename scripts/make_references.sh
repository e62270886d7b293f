#!/bin/sh
# Makes results/references: the exact commands. Run from the repository's root; takes about 55 minutes of one core.
# usage: scripts/make_references.sh [FOLDER OF ptbench_reference] [THREADS] [SCENE [KERNEL]]
set -eu
bin=${1:-build/release/bin}
threads=${2:-1}
scene_alone=${3:-} kernel_alone=${4:-}

make_one() { # scene kernel path_length spp
    [ "${scene_alone:-$1} ${kernel_alone:-$2}" = "$1 $2" ] || return 0
    echo "$1 $2, path length $3, $4 spp" >&2
    "$bin/ptbench_reference" --scene "configs/scenes/$1.json" --kernel "$2" --path-length "$3" --spp "$4" \
        --size 128 --seed 1 --threads "$threads" --out results/references
}

for scene in thesis free_light; do
    for kernel in pt thesis; do
        make_one "$scene" "$kernel" 2 8000
        make_one "$scene" "$kernel" 5 4000
    done
done
make_one thesis pt 8 4000
make_one free_light pt 8 4000
for scene in caustic eclipse gap lamp_in_glass; do
    make_one "$scene" pt 8 8000
done
make_one thesis pt 128 6000
make_one thesis thesis 128 4000
make_one free_light pt 128 4000
make_one free_light thesis 128 4000
make_one lamps pt 2 8000
make_one lamps pt 5 4000
make_one lamps pt 128 4000
for scene in thesis free_light lamps; do
    for path_length in 5 128; do
        make_one "$scene" direct "$path_length" 4000
        make_one "$scene" whitted "$path_length" 2000
    done
done
for path_length in 5 128; do # every sample is the same
    make_one furnace pt "$path_length" 64
done
make_one furnace direct 5 64
make_one furnace whitted 5 64
make_one cornell pt 10 4000
make_one terrain pt 10 4000
for scene in flake knot menger; do
    make_one "$scene" pt 10 1000
done
make_one hair pt 10 512
make_one slivers pt 10 128
for scene in cornell knot; do
    make_one "$scene" direct 10 1000
    make_one "$scene" whitted 10 500
done
