#!/usr/bin/env bash
# Plants the faults of scripts/planted_faults.txt into a copy of the sources, and demands that the tests in charge fail
# with each, one at a time, and pass without any.  All are in one build, each behind a switch: a fault takes as long as
# its tests do until the first one fails.  The copy, its build and a log a fault stay in build/faults, or in the folder
# that INTERFLECT_FAULTS names, so that the next time only what has changed is compiled.
# Usage: scripts/check_planted_faults.sh [PATTERN]   (only faults whose names match this regular expression)
set -euo pipefail
cd "$(dirname "$0")/.."
work=${INTERFLECT_FAULTS:-build/faults}
mkdir -p "$work"
work=$(cd "$work" && pwd)
rm -rf "$work/sources" "$work/logs"
mkdir -p "$work/sources" "$work/logs" "$work/copy"
git ls-files -z --cached --others --exclude-standard | tar -c --ignore-failed-read --null -T - | tar -x -C "$work/sources"

# Files that are the same keep their times, and faults are planted where they are: no object is older than it must be.
scripts/plant_faults.pl "$work/sources/scripts/planted_faults.txt" "$work/sources" "$work/sources" >"$work/faults"
(cd "$work/copy" && find . -type f | while IFS= read -r file; do [[ -e "$work/sources/$file" ]] || rm "$file"; done)
(cd "$work/sources" && find . -type f | while IFS= read -r file; do
  cmp -s "$file" "$work/copy/$file" && continue
  mkdir -p "$work/copy/$(dirname "$file")" && cp "$file" "$work/copy/$file"
done)

awk -F '\t' -v name="${1:-.}" '$4 ~ name' "$work/faults" >"$work/asked"
cmake -S "$work/copy" -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DINTERFLECT_PRECOMPILE=ON -DINTERFLECT_WITH_VTK=OFF \
  -DINTERFLECT_BUILD_BENCHMARKS=OFF >/dev/null
cut -f 2 "$work/asked" | sort -u | sed 's|^|bin/|' | xargs cmake --build "$work/build" --parallel "$(nproc)" --target >"$work/logs/build" || {
  tail -20 "$work/logs/build"
  exit 2
}

# passes NUMBER LOG TESTS FILTER: with this fault, 0 being none
passes() {
  PLANTED_FAULT=$1 timeout 600 "$work/build/bin/$3" --gtest_filter="$4" --gtest_fail_fast >"$2" 2>&1 </dev/null
}

missed=0
for tests in $(cut -f 2 "$work/asked" | sort -u); do
  filter=$(awk -F '\t' -v tests="$tests" '$2 == tests { print $3 }' "$work/asked" | sort -u | paste -sd :)
  log="$work/logs/$tests"
  if passes 0 "$log" "$tests" "$filter" && ! grep -q '\[  PASSED  \] 0 tests' "$log"; then continue; fi
  echo "NO MEASURE   $tests $filter fails without a fault, or has no tests"
  missed=$((missed + 1))
done
while IFS=$'\t' read -r number tests filter name; do
  log="$work/logs/$number"
  if [[ "$number" == 0 ]]; then
    missed=$((missed + 1))  # what the planter said of it
    continue
  fi
  ended=0
  passes "$number" "$log" "$tests" "$filter" || ended=$?
  noticed=$(sed -n 's/^\[  FAILED  \] \([^ ,]*\).*(.* ms)$/\1/p' "$log" | head -1)
  if [[ -n "$noticed" ]]; then
    echo "noticed      $name: $noticed"
  else
    echo "MISSED       $name: $tests $filter ends with $ended and no test that failed"
    missed=$((missed + 1))
  fi
done <"$work/asked"
exit $((missed > 0))
