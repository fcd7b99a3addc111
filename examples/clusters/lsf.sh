#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
#BSUB -J degs[1-16]
#BSUB -n 4
#BSUB -R span[hosts=1]
# STUDY=/full/path OUT=/full/path bsub < lsf.sh, and when the array has ended:
# degs sweep STUDY --out OUT --collect
# LSF tells the last number and the step, but not the first: the array has to begin at 1.
exec degs sweep "$STUDY" --out "$OUT" --jobs 4 --shard auto
