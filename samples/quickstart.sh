#!/bin/sh
# From a bare Debian 12 to a tile pack and pictures of it: installs what is missing, builds, bakes a sample.
# Run it from anywhere, as root or with sudo; a second run builds only what changed.
set -eu
cd "$(dirname "$0")/.."
. samples/install_packages.sh
install_packages build

echo "Building tilepack ..."
tests=ON # the same build folder serves tests/run.sh, where what tests need is installed
if [ -n "$(missing_packages "$test_packages")" ]; then tests=OFF; fi
cmake --preset release -D TILEPACK_TESTS=$tests -D TILEPACK_WHOLE_ROOMS=ON >/dev/null
cmake --build --preset release --target tilepack_cli
tilepack=build/release/tilepack

sample=samples/pebbles.png
mkdir -p out
$tilepack bake $sample -o out/pebbles
$tilepack validate out/pebbles
$tilepack render out/pebbles -o out/pebbles_8x8.png
$tilepack inspect out/pebbles --picture out/pebbles_pack.png >/dev/null

cat <<END

Made from $sample, in $(pwd):
  out/pebbles/pack.json      the tile pack, with its images beside it
  out/pebbles_pack.png       a picture of the pack: its 16 tiles, with their colors drawn on
  out/pebbles_8x8.png        8 x 8 tiles of the endless texture they make

To try next:
  cd $(pwd)
  $tilepack bake PHOTO.jpg -o out/photo --colors 3       a sample of your own, with more tiles
  $tilepack bake samples/rock_albedo.png -o out/rock --map normal=samples/rock_normal.png \\
      --map roughness=samples/rock_roughness.png --map height=samples/rock_height.png
  $tilepack render out/pebbles -o out/large.png --rect 0,0,8192,8192
  $tilepack help
  sh tests/run.sh                                        all tests
END
