#!/usr/bin/env bash
# slurm.sh COMMAND...: runs a command beside a Slurm cluster of its own, of one node on this machine, without systemd; ends both.
# Needs root, and Debian's slurmctld slurmd slurm-client munge, installed where /usr/sbin/policy-rc.d exits 101.
set -euo pipefail

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
cat >"$scratch/slurm.conf" <<CONF
ClusterName=ptbench
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$scratch/munge/socket
CryptoType=crypto/munge
SlurmctldPort=16817
StateSaveLocation=$scratch/state
SlurmctldPidFile=$scratch/slurmctld.pid
SlurmdPidFile=$scratch/slurmd.pid
SlurmdSpoolDir=$scratch/spool
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SlurmdParameters=config_overrides
ReturnToService=2
NodeName=n1 NodeHostname=$host NodeAddr=127.0.0.1 Port=17001 CPUs=8
PartitionName=all Nodes=n1 Default=YES State=UP
CONF
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
slurmd -D -N n1 >"$scratch/slurmd.out" 2>&1 &
daemons+=($!)
for _ in $(seq 100); do
    if [ "$(sinfo -h -o %t 2>/dev/null)" = idle ]; then break; fi
    sleep 0.2
done
if [ "$(sinfo -h -o %t)" != idle ]; then
    tail -n 5 "$scratch"/*.out >&2
    exit 1
fi
"$@"
