# SPDX-License-Identifier: MIT
# shellcheck shell=bash disable=SC2154  # scratch and fail are of checks.sh
# Sourced by cluster.sh. start_slurm: a Slurm of four nodes, one processor each, on the loopback device of this name
# space; its key, sockets, state and logs lie in $scratch/slurm. SLURM_CONF then leads sbatch and the others to it.
start_slurm() {
  local folder=$scratch/slurm name node i
  name=$(hostname)
  mkdir -p "$folder/munge" "$folder/state" "$folder/log"
  chmod 700 "$folder/munge"
  (umask 077 && head -c 1024 /dev/urandom >"$folder/munge/key")
  # Slurm asks for addresses of configured devices alone, and 127.0.0.1 does not count
  ip link set lo up && ip address add 10.1.1.1/32 dev lo || fail "no loopback device"

  export SLURM_CONF=$folder/slurm.conf
  cat >"$SLURM_CONF" <<END
ClusterName=dmrp
SlurmctldHost=$name(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$folder/munge/socket,cred_expire=5
CredType=cred/munge
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool_%n
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/%n.pid
SlurmctldLogFile=$folder/log/slurmctld
SlurmdLogFile=$folder/log/%n
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdParameters=config_overrides
ReturnToService=2
NodeName=node[1-4] NodeHostname=$name NodeAddr=127.0.0.1 Port=[7101-7104] CPUs=1 RealMemory=16384 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
END
  munged --foreground --force --socket="$folder/munge/socket" --key-file="$folder/munge/key" \
    --log-file="$folder/munge/log" --pid-file="$folder/munge/pid" --seed-file="$folder/munge/seed" \
    >"$folder/log/munged" 2>&1 &
  slurmctld -D -i >"$folder/log/slurmctld.out" 2>&1 &
  for node in node1 node2 node3 node4; do
    slurmd -D -N "$node" >"$folder/log/$node.out" 2>&1 &
  done
  for ((i = 0; i < 1200; ++i)); do
    [[ $(sinfo --noheader --states=idle --format=%D 2>/dev/null) == 4 ]] && return
    sleep 0.05
  done
  tail -n 20 "$folder"/log/*
  fail "Slurm's four nodes are not up"
}
