#!/usr/bin/env bash
# Installs the Debian 12 packages that interflect is built with, as far as they are missing.
# Where nothing is missing it does nothing: no network, no rights needed.
set -euo pipefail

usage() {
  cat <<'TEXT'
Usage: scripts/setup.sh [--without-vtk]
  --without-vtk   leave out VTK and Xvfb (two thirds of the download); configure with -DINTERFLECT_WITH_VTK=OFF, without pictures
TEXT
}

fail() {
  printf 'setup.sh: %s\n' "$1" >&2
  exit 1
}

packages=(
  g++ cmake ninja-build pkg-config ccache
  libeigen3-dev libtbb-dev libspdlog-dev        # core
  libcgal-dev                                   # geometry
  nlohmann-json3-dev libtinyobjloader-dev libassimp-dev zlib1g-dev   # scene
  libembree-dev libopenmesh-dev                 # raycast, mesh
  libopenexr-dev libstb-dev libhdf5-dev         # results
  libcli11-dev                                  # apps
  libgtest-dev libbenchmark-dev                 # tests, bench
)
pictures=(libvtk9-dev xvfb)                     # visual

for argument in "$@"; do
  case "$argument" in
    --without-vtk) pictures=() ;;
    -h | --help) usage; exit 0 ;;
    *) usage >&2; fail "unknown option '$argument'" ;;
  esac
done
packages+=("${pictures[@]}")

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  fail "this system has no apt; install the equivalents of: ${packages[*]}"
fi

installed() { [[ "$(dpkg-query --show --showformat='${db:Status-Status}' "$1" 2>/dev/null)" == installed ]]; }

missing=()
for package in "${packages[@]}"; do
  installed "$package" || missing+=("$package")
done
[[ ${#missing[@]} -gt 0 ]] || exit 0

as_root=()
if [[ "$(id -u)" -ne 0 ]]; then
  command -v sudo >/dev/null || fail "neither root nor sudo; ask an administrator for: apt-get install --no-install-recommends ${missing[*]}"
  as_root=(sudo)
fi

printf 'setup.sh: installing %s\n' "${missing[*]}"
apt_get() { "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=120 "$@"; }
apt_get -qq update || fail "apt-get update failed"
apt_get -qq -y --no-install-recommends install "${missing[@]}" || fail "apt-get could not install: ${missing[*]}"
