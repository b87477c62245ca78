#!/usr/bin/env bash
# Plants faults into a copy of the sources, one at a time, and demands that the tests notice each.  A few minutes per fault.
# Usage: scripts/check_planted_faults.sh [NAME]
set -euo pipefail
cd "$(dirname "$0")/.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
git ls-files -z | xargs -0 tar -c | tar -x -C "$work"
cmake -S "$work" -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DINTERFLECT_WITH_VTK=OFF -DINTERFLECT_BUILD_BENCHMARKS=OFF >/dev/null

# name | file | what it says | what the fault makes of it | tests that must notice
faults=(
  'F_ji for F_ij|fem/radiosity.cpp|divide_by(H, K.gram());|K.apply((B.array().colwise() / Eigen::Map<const Eigen::ArrayXd>(K.gram().data(), B.rows())).matrix(), H, run);|test_fem_radiosity'
  'pi missing in a form factor|fem/form_factor/far_field.cpp|return inv_pi * product_rule<8>|return product_rule<8>|test_fem_form_factors'
  'pi missing in a pixel|montecarlo/path_estimator.cpp|return radiosity * inv_pi;|return radiosity;|test_montecarlo'
  'rho twice in the solvers|solvers/transport_operator.h|reflectance_.array() * h.array()|reflectance_.array().square() * h.array()|test_solvers'
  'rho twice along a path|montecarlo/path_estimator.cpp|throughput *= optics(*hit).reflectance;|throughput *= optics(*hit).reflectance * optics(*hit).reflectance;|test_montecarlo'
  'a leaking wall|raycast/embree_caster.cpp|+ offset_ * leaves|- offset_ * leaves|test_raycast'
)
missed=0
for fault in "${faults[@]}"; do
  IFS='|' read -r name file right wrong tests <<<"$fault"
  [[ -z "${1:-}" || "$1" == "$name" ]] || continue
  cp "$work/$file" "$work/original"
  RIGHT="$right" WRONG="$wrong" perl -0pi -e 's/\Q$ENV{RIGHT}\E/$ENV{WRONG}/' "$work/$file"
  if cmp -s "$work/$file" "$work/original"; then
    echo "NOT PLANTED  $name: $file no longer says: $right"
    missed=$((missed + 1))
    continue
  fi
  cmake --build "$work/build" --target "bin/$tests" >/dev/null
  if "$work/build/bin/$tests" >"$work/log" 2>&1; then
    echo "MISSED       $name: $tests passes"
    missed=$((missed + 1))
  else
    echo "noticed      $name: $(grep -c '^\[  FAILED  \] .*)$' "$work/log" || true) tests of $tests fail"
  fi
  cp "$work/original" "$work/$file"
done
exit $((missed > 0))
