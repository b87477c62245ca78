#!/usr/bin/env bash
# Same scene, settings and seed: the same bits for any number of threads.  Compares the tables of solve, also by rays and
# by shooting in a scene of many elements, and pictures and tables of trace by every integrator of the catalogue.
set -euo pipefail
cd "$(dirname "$0")/.."
interflect=${INTERFLECT:-build/release/bin/interflect}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# A lamp, a block that hides it and a camera of a few pixels.
cat >"$work/room.json" <<'SCENE'
{
  "format": "interflect/scene/1", "units": "m", "quantity": "radiometric",
  "materials": { "grey": { "type": "diffuse", "reflectance": 0.5 },
                 "lamp": { "type": "diffuse", "reflectance": 0.2, "exitance": 9 } },
  "geometry": [
    { "name": "room", "material": "grey", "facing": "inward", "box": { "min": [0, 0, 0], "max": [3, 2, 1] } },
    { "name": "block", "material": "grey", "box": { "min": [1, 0.6, 0.1], "max": [1.6, 1.1, 0.5] } },
    { "name": "lamp", "material": "lamp",
      "polygon": [[2, 0.5, 0.95], [2, 0.9, 0.95], [2.5, 0.9, 0.95], [2.5, 0.5, 0.95]] } ],
  "sensors": [ { "name": "table", "normal": [0, 0, 1], "points": [[0.5, 1, 0.4], [2, 1.5, 0.2]] } ],
  "cameras": [ { "name": "c", "eye": [0.1, 0.1, 0.6], "target": [2, 1.5, 0.3], "fov_y_deg": 70, "size": [24, 16] } ]
}
SCENE
integrators=$("$interflect" trace --help | sed -n 's/.*--integrator TEXT:{\([^}]*\)}.*/\1/p' | tr , ' ')
[ "$(wc -w <<<"$integrators")" -ge 7 ] || { echo "check_threads: integrators expected in the help of trace" >&2; exit 1; }

# Trees of rays find light that one diffuse surface sends on, and light that comes straight: one after the other.
paths_of() {
  case $1 in
    whitted | distributed) echo 'LDE LE' ;;
    *) echo 'L.*E' ;;
  esac
}

set -f  # expressions are no patterns of files
for threads in 1 2 3 8; do
  out="$work/$threads"
  "$interflect" validate data/scenes/two_rooms.json -o "$out" --element-size 0.6 --accuracy 5% --picture-spp 2 \
    --threads "$threads" --quiet >/dev/null || [ $? -eq 1 ]
  "$interflect" trace data/scenes/cornell_box.json --spp 2 -o "$out/trace.exr" --threads "$threads" --quiet >/dev/null
  for file in surfaces.csv sensors.csv solution.vtu validation.vtu trace.exr; do
    cmp "$work/1/$file" "$out/$file"
  done
  for solver in gauss-seidel stochastic-ray shooting-collision shooting-and-gathering; do
    "$interflect" solve data/scenes/office.json --solver "$solver" --steps 2 -o "$out/$solver" --no-pictures \
      --threads "$threads" --quiet >/dev/null || [ $? -eq 1 ]
    cmp "$work/1/$solver/solution.vtu" "$out/$solver/solution.vtu"
  done
  for overshoot in 0 0.5; do
    "$interflect" shoot data/scenes/office.json --overshoot "$overshoot" --unshot 45% -o "$out/shoot-$overshoot" \
      --no-pictures --threads "$threads" --quiet >/dev/null
    cmp "$work/1/shoot-$overshoot/solution.vtu" "$out/shoot-$overshoot/solution.vtu"
  done
  for integrator in $integrators; do
    part=0
    for paths in $(paths_of "$integrator"); do
      part=$((part + 1))
      of="$integrator-$part"
      estimates=(--estimates "$out/$of" --accuracy 5%)
      files=("$of.exr" "$of/surfaces.csv" "$of/sensors.csv")
      if [ "$paths" = LDE ]; then estimates=() files=("$of.exr"); fi
      "$interflect" trace "$work/room.json" --integrator "$integrator" --paths "$paths" --spp 16 -o "$out/$of.exr" \
        "${estimates[@]}" --threads "$threads" --quiet >/dev/null
      for file in "${files[@]}"; do cmp "$work/1/$file" "$out/$file"; done
    done
  done
done
echo "the same bits for 1, 2, 3 and 8 threads, by radiosity and by" $integrators
