#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# slurm.sh PROGRAM CONFIGS: runs a study as a job array on a Slurm cluster of two nodes on this
# machine, which it starts and stops itself, loses a node on the way, and compares the results with
# those of a plain sweep; then the recipe of examples/clusters. Exits with 77 where it is not root,
# because slurmd needs that.
set -euo pipefail
program=$1 configs=$2
[[ $(id -u) -eq 0 ]] || { echo "skipped: a Slurm cluster can be started by root only"; exit 77; }
for tool in slurmctld slurmd munged sbatch; do
    command -v $tool >/dev/null || { echo "$tool is missing: run scripts/install.sh --tests"; exit 1; }
done

folder=$(mktemp -d)
stop() { # FILE: ends the daemon with this pid file
    local pid
    pid=$(cat "$1" 2>/dev/null) || return 0
    kill "$pid" 2>/dev/null || return 0
    for _ in $(seq 50); do kill -0 "$pid" 2>/dev/null || return 0; sleep 0.1; done
    kill -9 "$pid" 2>/dev/null || true
}
finish() {
    local status=$?
    if [[ $status -ne 0 ]]; then
        sinfo 2>&1 || true
        squeue 2>&1 || true
        tail -n 20 "$folder"/*.log "$folder"/slurm-out/slurm/*.log 2>/dev/null || true
    fi
    scancel --user root 2>/dev/null || true
    for file in n1 n2 slurmctld munged; do stop "$folder/$file.pid"; done
    rm -rf "$folder"
}
trap finish EXIT
until_true() { # SECONDS COMMAND...
    local limit=$1 start=$SECONDS
    shift
    until "$@"; do
        [[ $((SECONDS - start)) -lt $limit ]] || { echo "waited $limit s in vain for: $*"; return 1; }
        sleep 0.2
    done
}

# The cluster: its ports are free ones, and everything lies in the folder, the socket of its own
# munge too.
mkdir -m 755 "$folder/munge"
chmod 755 "$folder"
head -c 128 /dev/urandom >"$folder/munge/key"
chmod 600 "$folder/munge/key"
munged --socket="$folder/munge/socket" --key-file="$folder/munge/key" --pid-file="$folder/munged.pid" \
    --log-file="$folder/munge/munged.log" --seed-file="$folder/munge/seed"
free_ports=($(python3 -c "
import socket
sockets = [socket.socket() for _ in range(3)]
for s in sockets: s.bind(('', 0))
print(*(s.getsockname()[1] for s in sockets))"))
host=$(hostname -s)
export SLURM_CONF=$folder/slurm.conf
cat >"$SLURM_CONF" <<CONF
ClusterName=degs
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=${free_ports[0]}
SlurmUser=root
AuthType=auth/munge
AuthInfo=cred_expire=5,socket=$folder/munge/socket
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=batch_sched_delay=0,sched_interval=2
MailProg=/bin/true
ReturnToService=2
SlurmdTimeout=5
KillWait=2
MinJobAge=600
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool-%n
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/%n.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd-%n.log
NodeName=n1 NodeHostname=$host NodeAddr=127.0.0.1 Port=${free_ports[1]} CPUs=1 RealMemory=500
NodeName=n2 NodeHostname=$host NodeAddr=127.0.0.1 Port=${free_ports[2]} CPUs=1 RealMemory=500
PartitionName=all Nodes=n1,n2 Default=YES State=UP
CONF
mkdir "$folder/state" "$folder/spool-n1" "$folder/spool-n2"
slurmctld
slurmd -N n1
slurmd -N n2
nodes_are_idle() { [[ $(sinfo -h -o %t%D 2>/dev/null) == idle2 ]]; }
until_true 60 nodes_are_idle

cat >"$folder/study.yaml" <<YAML
study: cluster
designs:
  - include: $configs/degs-64.yaml
    name: degs-64
axes:
  gaussian_buffer.bytes: x1/2..x4 x2
  packing.bytes: x1..x4 x2
  memory.bandwidth_gb_per_s: 51.2GB/s..204.8GB/s x2
scenes: synthetic:object,gaussians=20000
width: 480
YAML
"$program" sweep "$folder/study.yaml" --out "$folder/plain" >/dev/null 2>&1

"$program" sweep "$folder/study.yaml" --out "$folder/slurm-out" --slurm --tasks 12 --sbatch --mem=100
points() { find "$folder/slurm-out/points" -name '*.point' 2>/dev/null | wc -l || true; }
some_points() { [[ $(points) -ge 4 ]]; }
until_true 60 some_points

# The node is lost with all of its processes, in the midst of a task. They are stopped first, one
# after the other from the daemon down, so that no task begins or ends while the others are looked
# for.
of_n1() { # pids of what runs there
    local environment
    for environment in $(grep -lszx 'SLURMD_NODENAME=n1' /proc/[0-9]*/environ || true); do
        if grep -qszx "SLURM_CONF=$SLURM_CONF" "$environment"; then cut -d/ -f3 <<<"$environment"; fi
    done
}
stop_n1() { # a task runs there, and all of its processes stand still; otherwise the daemon goes on
    lost=$(squeue -h -w n1 -t R -o %A) || return 1
    [[ -n $lost ]] || return 1
    kill -STOP "$daemon"
    victims=
    keepers=
    local pid parent
    for pid in $(of_n1); do
        kill -STOP "$pid" 2>/dev/null || continue
        parent=$(grep -s '^PPid:' "/proc/$pid/status" | cut -f2) || continue
        victims+=" $pid"
        [[ $(cat "/proc/$parent/comm" 2>/dev/null) != slurmstepd ]] || keepers+=" $parent"
    done
    [[ -z $victims || -z $keepers ]] || return 0
    for pid in $victims "$daemon"; do kill -CONT "$pid" 2>/dev/null || true; done
    return 1
}
daemon=$(cat "$folder/n1.pid")
until_true 60 stop_n1
for pid in "$daemon" $keepers $victims; do kill -9 "$pid" 2>/dev/null || true; done
rm -f "$folder/n1.pid"
at_the_loss=$(points)
echo "node n1 lost with job $lost, $at_the_loss of 36 points finished"
[[ $at_the_loss -lt 36 ]]
node_is_down() { [[ $(sinfo -h -n n1 -o %t) == down* ]]; }
until_true 60 node_is_down
queue_is_empty() { # a controller that does not answer has not said so
    local queue
    queue=$(squeue -h) && [[ -z $queue ]]
}
until_true 200 queue_is_empty
echo "queue empty, $(points) of 36 points finished"

"$program" sweep "$folder/study.yaml" --out "$folder/slurm-out" --collect
for file in results.csv results.json index.html; do
    cmp "$folder/plain/$file" "$folder/slurm-out/$file"
done
"$program" sweep "$folder/study.yaml" --out "$folder/slurm-out" --slurm | grep 'All points are finished'
echo "the array, a node lost, gives the bytes of a plain sweep"

# The recipe: tasks find their parts in what this Slurm sets.
mkdir "$folder/bin"
ln -s "$(realpath "$program")" "$folder/bin/degs"
sed 's/20000/200/; s/480/64/' "$folder/study.yaml" >"$folder/small.yaml"
"$program" sweep "$folder/small.yaml" --out "$folder/small" >/dev/null 2>&1
PATH=$folder/bin:$PATH timeout 120 sbatch --wait --array=3-7:2 --cpus-per-task=1 --mem=100 \
    --output="$folder/recipe-%a.log" "$configs/../examples/clusters/slurm.sh" "$folder/small.yaml" "$folder/recipe"
"$program" sweep "$folder/small.yaml" --out "$folder/recipe" --collect >/dev/null
cmp "$folder/small/results.csv" "$folder/recipe/results.csv"
grep -h '12 of 12' "$folder"/recipe-[357].log | wc -l | grep -qx 3
echo "three tasks of an array with --shard auto give the bytes of a plain sweep"

# A search by two tasks at a time, one on each node, as docs/explore.md has it; the lost node comes
# back.
slurmd -N n1
until_true 60 nodes_are_idle
search="$folder/small.yaml --budget 12"
"$program" explore $search --out "$folder/searched" >/dev/null 2>&1
timeout 120 sbatch --wait --array=1-2 --mem=100 --output="$folder/search-%a.log" \
    --wrap "$program explore $search --out $folder/search --shard auto"
for file in explore.json beliefs.csv front.csv results.csv; do
    cmp "$folder/searched/$file" "$folder/search/$file"
done
echo "two tasks of an array search as one process does"
