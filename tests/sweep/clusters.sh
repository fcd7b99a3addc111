#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# clusters.sh PROGRAM ROOT: runs every recipe of examples/clusters with the variables that its
# scheduler sets, task by task, and compares the collected results with those of a plain sweep.
set -euo pipefail
program=$(realpath "$1") root=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/bin"
ln -s "$program" "$work/bin/degs"
export PATH=$work/bin:$PATH
unset "${!SLURM_@}" "${!PBS_@}" "${!SGE_@}" "${!LSB_@}" "${!AWS_BATCH_@}" JOB_COMPLETION_INDEX DEGS_TASKS
recipes=$root/examples/clusters
export STUDY=$work/study.yaml
cat >"$STUDY" <<YAML
designs: [{ include: $root/configs/degs-64.yaml, name: degs-64 }]
axes: { packing.bytes: x1..x4 x2, memory.latency_ns: [50, 100] }
scenes: synthetic:object,gaussians=200
width: 64
YAML
degs sweep "$STUDY" --out "$work/plain" >/dev/null
collected() { # NAME: the parts of this recipe are complete
    degs sweep "$STUDY" --out "$work/$1" --collect >/dev/null
    cmp "$work/plain/results.csv" "$work/$1/results.csv"
    echo "$1: the tasks have the results of a plain sweep"
}
for id in 3 4 5; do
    SLURM_ARRAY_TASK_ID=$id SLURM_ARRAY_TASK_MIN=3 SLURM_ARRAY_TASK_MAX=5 SLURM_ARRAY_TASK_STEP=1 \
        SLURM_ARRAY_TASK_COUNT=3 sh "$recipes/slurm.sh" "$STUDY" "$work/slurm"
done
collected slurm
for id in 1 2 3; do
    OUT=$work/pbs PBS_ARRAY_INDEX=$id DEGS_TASKS=3 sh "$recipes/pbs.sh"
    SGE_TASK_ID=$((2 * id)) SGE_TASK_FIRST=2 SGE_TASK_LAST=7 SGE_TASK_STEPSIZE=2 \
        sh "$recipes/sge.sh" "$STUDY" "$work/sge"
    OUT=$work/lsf LSB_JOBINDEX=$id LSB_JOBINDEX_END=3 LSB_JOBINDEX_STEP=1 sh "$recipes/lsf.sh"
done
collected pbs
collected sge
collected lsf

# What the job would run, in place of the client that submits it.
cat >"$work/bin/aws" <<'PYTHON'
#!/usr/bin/python3
import json, os, subprocess, sys
options = dict(zip(sys.argv[3::2], sys.argv[4::2]))
size = options["--array-properties"].split("=")[1]
for index in range(int(size)):
    variables = {"AWS_BATCH_JOB_ARRAY_INDEX": str(index), "AWS_BATCH_JOB_ARRAY_SIZE": size}
    command = json.loads(options["--container-overrides"])["command"]
    subprocess.run(["degs", *command], check=True, env={**os.environ, **variables})
PYTHON
chmod +x "$work/bin/aws"
sh "$recipes/aws-batch.sh" queue definition "$STUDY" "$work/aws-batch"
collected aws-batch
/usr/bin/python3 - "$recipes/kubernetes.yaml" "$work" <<'PYTHON'
import os, pathlib, subprocess, sys, yaml
work = pathlib.Path(sys.argv[2])
job = yaml.safe_load(pathlib.Path(sys.argv[1]).read_text(encoding="utf-8"))["spec"]
assert job["completionMode"] == "Indexed"
container = job["template"]["spec"]["containers"][0]
variables = {entry["name"]: entry["value"] for entry in container["env"]}
places = {"/data/study.yaml": work / "study.yaml", "/data/out": work / "kubernetes"}
for index in range(job["completions"]):
    subprocess.run(["degs", *(str(places.get(word, word)) for word in container["args"])], check=True,
                   env={**os.environ, **variables, "JOB_COMPLETION_INDEX": str(index)})
PYTHON
collected kubernetes
