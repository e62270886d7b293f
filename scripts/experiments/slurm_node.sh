#!/usr/bin/env bash
# slurm_node.sh NAME: a node of slurm.sh's cluster, until it is ended. What runs on it has a hostname of its own, by whose
# namespace (/proc/PID/ns/uts) all of it is found; and it may lack a folder that others have, as the mounts are its own.
set -euo pipefail
# shellcheck disable=SC2016 # the inner shell's
exec unshare --uts --mount bash -c 'hostname "$1" && exec slurmd -D -N "$1"' node "$1"
