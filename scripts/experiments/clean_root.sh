#!/usr/bin/env bash
# Tries ptbench in a root of a Debian release that has nothing else.
#   clean_root.sh bookworm ptbench_*.deb          the package: without a driver, then with PoCL; three minutes
#   clean_root.sh trixie [options of ctest]       a clone of this tree: the README's two commands; an hour of two cores
# Root, a network and debootstrap are needed; the mirror and the settings of apt are this machine's.
set -euo pipefail
release=$1
shift
tree=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
root=$(mktemp -d)
trap 'umount -q -R -l "$root/proc" "$root/sys" "$root/dev" || true; rm -rf --one-file-system "$root"' EXIT

# The mirror that most of apt's indices come from.
mirror() {
    # shellcheck disable=SC2016 # apt's word, not the shell's
    apt-get indextargets --format '$(SITE)' | sort | uniq -c | sort -rn | awk 'NR == 1 { print $2 }'
}

make_root() {
    debootstrap --variant=minbase "$release" "$root" "$(mirror)" >/dev/null
    cp -r /etc/apt/apt.conf.d "$root/etc/apt/"
    cp /etc/resolv.conf "$root/etc/"
    mount -t proc proc "$root/proc"
    mount --rbind --make-rslave /sys "$root/sys" # where PoCL looks for memory
    mount --rbind --make-rslave /dev "$root/dev"
    inside apt-get -qq update
}

inside() {
    chroot "$root" env -i HOME=/root PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 \
        DEBIAN_FRONTEND=noninteractive "$@"
}

install() {
    inside apt-get install -qq --no-install-recommends -y "$@" >/dev/null 2>&1
}

try_package() { # FILE
    local code=0
    cp "$1" "$root/ptbench.deb"
    install /ptbench.deb
    inside ptbench --all-devices || code=$?
    echo "without a driver: exit code $code"
    install pocl-opencl-icd
    inside ptbench --kernel pt --size 32 --spp 4 --path-length 5 --wg implicit --out /out --quiet
    echo "with PoCL: done"
    [ "$code" -eq 77 ]
}

try_clone() { # CTEST_OPTION...
    git clone --quiet "$tree" "$root/ptbench"
    inside /ptbench/scripts/bench.sh --kernel pt --size 32 --spp 4 --path-length 5 --wg implicit --out /out
    inside /ptbench/scripts/test.sh "$@"
}

make_root
case "${1-}" in
    *.deb) try_package "$1" ;;
    *) try_clone "$@" ;;
esac
