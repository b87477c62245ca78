#!/usr/bin/env bash
# Installs the release build into a temporary place, and builds and runs docs/example against it from outside.
set -euo pipefail
cd "$(dirname "$0")/.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cmake --install build/release --prefix "$work/prefix" >/dev/null
"$work/prefix/bin/interflect" --version
cmake -S docs/example -B "$work/build" -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_BUILD_TYPE=Release >/dev/null
cmake --build "$work/build" >/dev/null
"$work/build/two_plates"
