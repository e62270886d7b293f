#!/usr/bin/env bash
# slurm.sh [--nodes N] COMMAND...: runs a command beside a Slurm cluster of its own, of one node or more (n1, n2, ...) on this
# machine, without systemd; ends both. Each node has a hostname and mounts of its own (slurm_node.sh).
# Needs root, and Debian's slurmctld slurmd slurm-client munge, installed where /usr/sbin/policy-rc.d exits 101.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
nodes=1
if [ "${1-}" = --nodes ]; then
    nodes=$2
    shift 2
fi
scratch=$(mktemp -d /tmp/ptbench-slurm-XXXXXX)
daemons=()
# The last that was started first: the end of a step is told to slurmctld, by munged's word.
end_all() {
    scancel --user root 2>/dev/null || true
    sleep 1
    for ((i = ${#daemons[@]} - 1; i >= 0; i--)); do
        kill "${daemons[i]}" 2>/dev/null || true
        wait "${daemons[i]}" || true
    done
    rm -rf "$scratch"
}
trap end_all EXIT

mkdir "$scratch"/{munge,spool,state}
chmod 755 "$scratch"
chmod 711 "$scratch/munge"
dd if=/dev/urandom of="$scratch/munge/key" bs=1024 count=1 status=none
chmod 400 "$scratch/munge/key"
host=$(hostname -s)
port=$((20000 + $$ % 2000 * 10)) # another cluster on this machine has others
cat >"$scratch/slurm.conf" <<CONF
ClusterName=ptbench
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$scratch/munge/socket
CryptoType=crypto/munge
SlurmctldPort=$port
StateSaveLocation=$scratch/state
SlurmctldPidFile=$scratch/slurmctld.pid
SlurmdPidFile=$scratch/slurmd-%n.pid
SlurmdSpoolDir=$scratch/spool/%n
SlurmdTimeout=5
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SlurmdParameters=config_overrides
ReturnToService=2
PartitionName=all Nodes=ALL Default=YES State=UP
CONF
for ((i = 1; i <= nodes; i++)); do
    mkdir "$scratch/spool/n$i"
    echo "NodeName=n$i NodeHostname=n$i NodeAddr=127.0.0.1 Port=$((port + i)) CPUs=8" >>"$scratch/slurm.conf"
done
export SLURM_CONF=$scratch/slurm.conf

munged --force --foreground --socket "$scratch/munge/socket" --key-file "$scratch/munge/key" --log-file "$scratch/munge/log" \
    --pid-file "$scratch/munge/pid" --seed-file "$scratch/munge/seed" >"$scratch/munged.out" 2>&1 &
daemons+=($!)
for _ in $(seq 50); do
    if [ -S "$scratch/munge/socket" ]; then break; fi
    sleep 0.1
done
slurmctld -D >"$scratch/slurmctld.out" 2>&1 &
daemons+=($!)
for ((i = 1; i <= nodes; i++)); do
    "$here/slurm_node.sh" "n$i" >"$scratch/slurmd-n$i.out" 2>&1 &
    daemons+=($!)
done
idle() { sinfo -h -t idle -o %D 2>/dev/null; }
for _ in $(seq 100); do
    if [ "$(idle)" = "$nodes" ]; then break; fi
    sleep 0.2
done
if [ "$(idle)" != "$nodes" ]; then
    tail -n 5 "$scratch"/*.out >&2
    exit 1
fi
"$@"
