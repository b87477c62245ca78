#!/usr/bin/env bash
# Runs every command of docs/status.md and says which one failed.  Usage: scripts/status.sh [PATTERN]  (only lines that match)
set -uo pipefail
cd "$(dirname "$0")/.."
export PATH="$PWD/build/release/bin:$PATH"
mkdir -p out
tests() { ctest --test-dir build/release --output-on-failure --no-tests=error --parallel "$(nproc)" -R "$1"; }
export -f tests
failed=0
while IFS= read -r line; do
  what=${line#- \[?\] }
  what=${what%%: \`*}
  command=${line#*: \`}
  command=${command%\`}
  start=$SECONDS
  if bash -c "$command" >out/status.log 2>&1 </dev/null; then
    printf 'ok      %4d s  %s\n' $((SECONDS - start)) "$what"
  else
    printf 'FAILED  %4d s  %s\n          %s\n' $((SECONDS - start)) "$what" "$command"
    tail -5 out/status.log | sed 's/^/          /'
    failed=$((failed + 1))
  fi
done < <(grep -E '^- \[.\] .*: `.*`$' docs/status.md | grep -E -- "${1:-}")
if ((failed > 0)); then
  echo "$failed failed"
  exit 1
fi
echo "all shown"
