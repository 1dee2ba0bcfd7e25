#!/bin/sh
# Bakes the packs of the landscape from the samples: sh bake_packs.sh [FOLDER], samples/scenes/made unless told otherwise.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
made=${1:-$here/made}
tilepack=${TILEPACK:-tilepack}
for sample in pebbles cracked meadow; do
  "$tilepack" bake "$here/../$sample.png" -o "$made/$sample.pack" --tile-size 128 --effort 1 --quiet
done
"$tilepack" bake "$here/../rock_albedo.png" --map "height=$here/../rock_height.png" -o "$made/rock.pack" --tile-size 128 --effort 1 --quiet
