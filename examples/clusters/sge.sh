#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
#$ -S /bin/sh -N degs -t 1-16 -cwd -pe smp 4
# qsub sge.sh STUDY OUT, and when the array has ended: degs sweep STUDY --out OUT --collect
# SGE tells first number, last number and step; the name of the parallel environment is the site's.
exec degs sweep "$1" --out "$2" --jobs 4 --shard auto
