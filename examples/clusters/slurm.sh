#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
#SBATCH --job-name=degs --array=1-16 --cpus-per-task=4 --requeue
# sbatch slurm.sh STUDY OUT, and when the array has ended: degs sweep STUDY --out OUT --collect
# Slurm tells the size of an array without gaps; `degs sweep --slurm` submits arrays with gaps.
exec degs sweep "$1" --out "$2" --jobs 4 --shard auto
