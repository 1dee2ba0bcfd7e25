#!/bin/sh
# The parts of a manifest as a job array: sh slurm_submit.sh MANIFEST PARTS [OPTIONS OF tilepack batch]
# Waits for it, submits again the parts that did not come to their end (preempted, or their node was lost), at most
# TRIES times (5), merges their logs, and ends with the worst exit code of all entries.
set -eu
manifest=$1 parts=$2
shift 2
here=$(cd "$(dirname "$0")" && pwd)
logs=${LOGS:-$(pwd)/tilepack-logs}
mkdir -p "$logs"
rm -f "$logs"/*.log "$logs"/*.new

missing() {
  for part in $(seq "$parts"); do
    [ -e "$logs/$part.log" ] || printf '%s,' "$part"
  done
}

try=1
while left=$(missing) && [ -n "$left" ]; do
  if [ "$try" -gt "${TRIES:-5}" ]; then
    echo "slurm_submit: parts $left did not end after ${TRIES:-5} tries" >&2
    break
  fi
  if [ "$try" -gt 1 ]; then echo "slurm_submit: again: ${left%,}" >&2; fi
  # --wait ends when all tasks have, with the highest of their codes; those are in the logs.
  sbatch --parsable --wait --no-requeue --array "${left%,}" --job-name "tilepack-$(basename "$manifest")" --output "$logs/slurm-%a.txt" \
    --cpus-per-task "${CPUS:-1}" ${PARTITION:+--partition "$PARTITION"} ${TIME:+--time "$TIME"} --export ALL \
    "$here/slurm_part.sh" "$manifest" "$parts" "$logs" "$@" >/dev/null || true
  try=$((try + 1))
done
python3 "$here/merge_logs.py" --parts "$parts" "$logs"/*.log
