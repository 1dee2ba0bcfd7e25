#!/bin/sh
# A Slurm of its own on this machine, on loopback, for trying things out: sh local_slurm.sh start|stop FOLDER
# It has two nodes that are both this machine, keeps everything in FOLDER (a new one, with a short path) and leaves nothing running after stop.
# Then: export SLURM_CONF=FOLDER/slurm.conf. Needs Debian's slurmctld, slurmd, slurm-client and munge.
set -eu
action=$1
mkdir -p "$2"
folder=$(cd "$2" && pwd)
export SLURM_CONF="$folder/slurm.conf"

stop() {
  scontrol shutdown >/dev/null 2>&1 || true
  for pid in "$folder"/*.pid; do
    if [ -e "$pid" ]; then kill "$(cat "$pid")" 2>/dev/null || true; fi
  done
  for wait in 1 2 3 4 5 6 7 8 9 10; do
    left=
    for pid in "$folder"/*.pid; do
      if [ -e "$pid" ] && kill -0 "$(cat "$pid")" 2>/dev/null; then left=yes; fi
    done
    [ -n "$left" ] || return 0
    sleep 0.3
  done
}

if [ "$action" = stop ]; then
  stop
  exit 0
fi

host=$(hostname -s) user=$(id -un) first=${PORT:-46817}
mkdir -p "$folder/state" "$folder/log"
chmod 755 "$folder"
umask 077
head -c 1024 /dev/urandom >"$folder/munge.key"
umask 022
cat >"$SLURM_CONF" <<END
ClusterName=tiles
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$first
SlurmUser=$user
SlurmdUser=$user
AuthType=auth/munge
AuthInfo=socket=$folder/munge.socket
CredType=cred/munge
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool-%n
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd-%n.pid
SlurmctldLogFile=$folder/log/slurmctld.log
SlurmdLogFile=$folder/log/slurmd-%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SwitchType=switch/none
MpiDefault=none
ReturnToService=2
SlurmdTimeout=5
KillWait=2
JobAcctGatherType=jobacct_gather/none
SchedulerType=sched/builtin
SchedulerParameters=sched_interval=1
NodeName=node1 NodeHostname=$host NodeAddr=127.0.0.1 Port=$((first + 1)) CPUs=1 State=UNKNOWN
NodeName=node2 NodeHostname=$host NodeAddr=127.0.0.1 Port=$((first + 2)) CPUs=1 State=UNKNOWN
PartitionName=all Nodes=node1,node2 Default=YES MaxTime=INFINITE State=UP
END
munged --force --key-file="$folder/munge.key" --socket="$folder/munge.socket" --pid-file="$folder/munge.pid" \
  --log-file="$folder/log/munge.log" --seed-file="$folder/munge.seed"
slurmctld -f "$SLURM_CONF"
for node in node1 node2; do slurmd -N "$node" -f "$SLURM_CONF"; done
for wait in $(seq 50); do
  if [ "$(sinfo --noheader --format %T 2>/dev/null | sort -u)" = idle ]; then exit 0; fi
  sleep 0.2
done
echo "local_slurm: the nodes do not come up; the logs are in $folder/log" >&2
stop
exit 1
