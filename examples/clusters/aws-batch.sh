#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# aws-batch.sh QUEUE DEFINITION STUDY OUT: submits an array job, whose size AWS Batch tells every
# task. The job definition has the image of scripts/container.sh and mounts a file system, such as
# EFS, where all tasks find STUDY and OUT. When the job has ended:
# degs sweep STUDY --out OUT --collect
set -eu
exec aws batch submit-job --job-name degs --job-queue "$1" --job-definition "$2" \
    --array-properties size=16 \
    --container-overrides "{\"command\": [\"sweep\", \"$3\", \"--out\", \"$4\", \"--jobs\", \"4\", \"--shard\", \"auto\"]}"
