#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
#PBS -N degs
#PBS -J 1-16
#PBS -l select=1:ncpus=4
# qsub -v STUDY=/full/path,OUT=/full/path,DEGS_TASKS=16 pbs.sh, and when the array has ended:
# degs sweep STUDY --out OUT --collect
# PBS does not tell how many tasks there are: DEGS_TASKS is the last number of -J, which begins at
# 1.
exec degs sweep "$STUDY" --out "$OUT" --jobs 4 --shard auto
