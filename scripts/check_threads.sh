#!/usr/bin/env bash
# Same scene, settings and seed: the same bits for any number of threads.  Compares the tables of solve and the picture of trace.
set -euo pipefail
cd "$(dirname "$0")/.."
interflect=${INTERFLECT:-build/release/bin/interflect}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for threads in 1 2 3 8; do
  out="$work/$threads"
  "$interflect" validate data/scenes/two_rooms.json -o "$out" --element-size 0.6 --accuracy 5% --picture-spp 2 \
    --threads "$threads" --quiet >/dev/null || [ $? -eq 1 ]
  "$interflect" trace data/scenes/cornell_box.json --spp 2 -o "$out/trace.exr" --threads "$threads" --quiet >/dev/null
  for file in surfaces.csv sensors.csv solution.vtu validation.vtu trace.exr; do
    cmp "$work/1/$file" "$out/$file"
  done
done
echo "the same bits for 1, 2, 3 and 8 threads"
