#!/usr/bin/env bash
# Installs what is missing, builds, and runs all tests but the long ones. The exit status is ctest's.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
exec </dev/null

scripts/setup.sh
cmake --preset release
cmake --build --preset release --parallel "$(nproc)"
exec ctest --preset release --parallel "$(nproc)" --no-tests=error
