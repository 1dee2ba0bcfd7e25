#!/bin/sh
# Installs what is missing, builds with g++ and with clang under sanitizers, and runs every test in both.
# Run it from anywhere, as root or with sudo; a second run builds only what changed.
set -eu
cd "$(dirname "$0")/.."
. samples/install_packages.sh
install_packages test

for preset in release sanitize; do
  cmake --preset "$preset" -D TILEPACK_WHOLE_ROOMS=ON >/dev/null # from nothing, half the time
  cmake --build --preset "$preset"
done

# A minute of strangers' input in all; tests/fuzz/run.sh MINUTES takes longer.
sh tests/fuzz/run.sh

# The first failure ends this, so that the last line is always the verdict.
for preset in release sanitize; do
  ctest --preset "$preset" --parallel "$(nproc)"
done
