#!/bin/sh
# The parts of a manifest under GNU parallel: sh parallel.sh MANIFEST PARTS [OPTIONS OF tilepack batch]
# PARALLEL in the environment has parallel's own options, such as --sshlogin. Ends with the worst exit code.
set -eu
manifest=$1 parts=$2
shift 2
here=$(cd "$(dirname "$0")" && pwd)
tilepack=${TILEPACK:-tilepack}
logs=$(mktemp -d "${TMPDIR:-/tmp}/tilepack-logs.$(printf 'X%.0s' 1 2 3 4 5 6)")
trap 'rm -rf "$logs"' EXIT
# Each part has one thread: there are as many parts at a time as cores. Failures are told by the logs.
seq "$parts" | parallel --will-cite --results "$logs/{}.log" \
  "$tilepack" batch "$manifest" --shard "{}/$parts" --jobs 1 --log-format json "$@" >/dev/null 2>&1 || true
python3 "$here/merge_logs.py" --parts "$parts" "$logs"/*.log
