#!/bin/sh
# One part of a manifest, a task of the array that slurm_submit.sh submits: MANIFEST PARTS LOGS [OPTIONS].
# Slurm ends it with SIGTERM when it is preempted, which tilepack answers within a second; what was finished is kept.
set -u
manifest=$1 parts=$2 logs=$3
shift 3
part=$SLURM_ARRAY_TASK_ID
log=$logs/$part.log
"${TILEPACK:-tilepack}" batch "$manifest" --shard "$part/$parts" --jobs "${SLURM_CPUS_PER_TASK:-1}" --log-format json "$@" >"$log.new"
code=$?
# Only a part that came to its end has a log: what was killed is submitted again.
if [ "$code" -lt 128 ]; then mv "$log.new" "$log"; fi
exit "$code"
