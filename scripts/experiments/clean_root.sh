#!/usr/bin/env bash
# Installs ptbench's package into a Debian root that has nothing else, and runs it there: without a driver, then with
# PoCL. Root and a network are needed; about three minutes. usage: clean_root.sh ptbench_*.deb
set -euo pipefail
package=$(realpath "$1")
root=$(mktemp -d)
trap 'umount -q -l "$root/proc" "$root/sys" || true; rm -rf "$root"' EXIT

mmdebstrap --quiet --variant=apt bookworm "$root"
cp "$package" "$root/ptbench.deb"
inside() { chroot "$root" env HOME=/root DEBIAN_FRONTEND=noninteractive "$@"; }
mount -t proc proc "$root/proc"
mount --rbind --make-rslave /sys "$root/sys" # where PoCL looks for memory
cp /etc/resolv.conf "$root/etc/"
inside apt-get -qq update
inside apt-get install -qq --no-install-recommends -y /ptbench.deb >/dev/null 2>&1

code=0
inside ptbench --all-devices || code=$?
echo "without a driver: exit code $code"
inside apt-get install -qq --no-install-recommends -y pocl-opencl-icd >/dev/null 2>&1
inside ptbench --kernel pt --size 32 --spp 4 --path-length 5 --wg implicit --out /out --quiet
echo "with PoCL: done"
[ "$code" -eq 77 ]
