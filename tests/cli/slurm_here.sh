#!/usr/bin/env bash
# A real Slurm on this machine alone, for tests: one controller and one node daemon, with keys, sockets, ports and
# folders of their own. A Slurm that is already here is neither used nor touched.
#
#   slurm_here.sh start FOLDER [CPUS]   starts it; afterwards `. FOLDER/environment` points Slurm's commands at it
#   slurm_here.sh stop FOLDER           cancels its jobs and ends its daemons; FOLDER and its logs stay
#
# Exit code 77: it cannot run here, with the reason in one line on standard output. 1: it should have run, and did not.
set -euo pipefail

cannot() { printf 'no Slurm here: %s\n' "$*"; exit 77; }
failed() { printf 'slurm_here: %s\n' "$*" >&2; exit 1; }

# The ends of the logs, for whoever reads the record of a test on another machine.
show_logs() {
  local log
  for log in "$here"/log/*; do
    [[ -s $log ]] || continue
    echo "-- ${log##*/}" >&2
    tail -n 15 "$log" >&2
  done
}

# until_true <tenths of a second> <command...>
until_true() {
  local left=$1
  shift
  until "$@" >/dev/null 2>&1; do
    ((left-- > 0)) || return 1
    sleep 0.1
  done
}

# The process that a daemon named in its file, if it is still that daemon: numbers are used again.
process_of() {
  local file=$here/run/$1.pid process
  [[ -s $file ]] || return 1
  process=$(<"$file")
  [[ $process =~ ^[0-9]+$ && "$(readlink "/proc/$process/cwd" 2>/dev/null)" == "$here/run" ]] || return 1
  echo "$process"
}
runs() { process_of "$1" >/dev/null; }
ended() { ! runs "$1"; }

# Each daemon stays in the foreground, so that its number is known; without terminal it outlives this script.
# launch <name> <program> [arguments...]
launch() {
  local name=$1
  shift
  (cd "$here/run" && exec setsid "$@" </dev/null >>"$here/log/$name" 2>&1) &
  echo $! >"$here/run/$name.pid"
}

# A port that nothing listens on. Another process may take it before Slurm does; then the start is tried again.
free_port() {
  local port
  while :; do
    port=$((20000 + RANDOM % 12000))
    (exec 3<>"/dev/tcp/127.0.0.1/$port") 2>/dev/null || break
  done
  echo "$port"
}

write_configuration() {
  local host
  host=$(hostname -s)
  cat >"$here/etc/slurm.conf" <<CONFIGURATION
ClusterName=spall_test
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$(free_port)
SlurmdPort=$(free_port)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$here/run/munge.socket
CredType=cred/munge
StateSaveLocation=$here/state
SlurmdSpoolDir=$here/spool
SlurmctldPidFile=$here/run/slurmctld.own.pid
SlurmdPidFile=$here/run/slurmd.own.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
JobCompType=jobcomp/filetxt
JobCompLoc=$here/log/finished_jobs
# Memory is not tracked: whatever a job asks for, it gets.
# The node is taken to be as big as it is said to be below.
SlurmdParameters=config_overrides
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerType=sched/builtin
SchedulerParameters=batch_sched_delay=0,sched_interval=1,sched_min_interval=100000
ReturnToService=2
KillWait=5
MinJobAge=300
MaxArraySize=1001
NodeName=$host NodeAddr=127.0.0.1 CPUs=$cpus RealMemory=1000000 State=UNKNOWN
PartitionName=test Nodes=$host Default=YES MaxTime=INFINITE State=UP
CONFIGURATION
  # Nothing here uses control groups, but slurmd loads what deals with them. Version 1's asks nothing of the machine
  # as long as it is not used; since 23.02 there is a name for none.
  local cgroup=cgroup/v1
  if [[ "$(slurmd -V)" =~ ([0-9]+)\.0?([0-9]+) ]] && ((BASH_REMATCH[1] * 100 + BASH_REMATCH[2] >= 2302)); then
    cgroup=disabled
  fi
  echo "CgroupPlugin=$cgroup" >"$here/etc/cgroup.conf"
}

node_is_idle_or_lost() { ended slurmd || ended slurmctld || node_is_idle; }
node_is_idle() { [[ "$(sinfo --noheader --format=%T 2>/dev/null)" == idle ]]; }

start() {
  local program
  ((EUID == 0)) || cannot "its daemons need root"
  for program in munged slurmctld slurmd sbatch squeue scancel scontrol sinfo; do
    command -v "$program" >/dev/null || cannot "there is no $program (packages slurm-wlm and munge)"
  done
  mkdir -p "$here"/{etc,run,log,state,spool}
  runs slurmctld && failed "one is running in $here already"
  chmod 755 "$here" "$here/run"
  chmod 700 "$here/etc"
  (umask 077 && head -c 128 /dev/urandom >"$here/etc/munge.key")

  # munge refuses folders that others could write in, which /tmp and its like are not: they have the sticky bit.
  launch munged munged --foreground --force --num-threads=2 --key-file="$here/etc/munge.key" --socket="$here/run/munge.socket" \
    --pid-file="$here/run/munged.own.pid" --seed-file="$here/state/munge.seed"
  until_true 50 munge --no-input --socket="$here/run/munge.socket" || { stop; show_logs; failed "munged does not answer"; }

  printf 'export SLURM_CONF=%q\n' "$here/etc/slurm.conf" >"$here/environment"
  export SLURM_CONF=$here/etc/slurm.conf
  for _ in 1 2 3; do
    write_configuration
    launch slurmctld slurmctld -D -c
    launch slurmd slurmd -D
    until_true 100 node_is_idle_or_lost && node_is_idle && return
    end slurmd
    end slurmctld
  done
  stop
  show_logs
  failed "the node does not come up"
}

# Asks a daemon to end, and insists after five seconds.
end() {
  local process
  process=$(process_of "$1") || return 0
  kill -TERM "$process" 2>/dev/null || true
  until_true 50 ended "$1" || kill -KILL "$process" 2>/dev/null || true
  rm -f "$here/run/$1.pid"
}

queue_is_empty() { [[ -z "$(squeue --noheader 2>&1)" ]]; }

stop() {
  export SLURM_CONF=$here/etc/slurm.conf
  if runs slurmctld && runs slurmd; then
    timeout 5 scancel --full --signal=KILL --user=root >/dev/null 2>&1 || true
    timeout 5 scancel --user=root >/dev/null 2>&1 || true
    until_true 100 queue_is_empty || true
  fi
  end slurmd
  end slurmctld
  end munged
}

verb=${1:-}
[[ -n ${2:-} ]] || failed "usage: slurm_here.sh start|stop FOLDER [CPUS]"
mkdir -p "$2"
here=$(cd "$2" && pwd -P)
cpus=${3:-$(nproc)}
case $verb in
  start) start ;;
  stop) stop ;;
  *) failed "unknown verb '$verb'; start or stop" ;;
esac
