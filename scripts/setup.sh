#!/usr/bin/env bash
# Installs what building, running and testing Bosquet needs on Debian 12: scripts/setup.sh [build|test|nightly]
# Asks apt only for packages that are missing, so a second run is quick and needs no network.
set -euo pipefail

build=(g++ cmake ninja-build pkg-config ccache
  libopenvdb-dev libboost-iostreams-dev zlib1g-dev libtbb-dev libgdal-dev libglm-dev libtinygltf-dev libmeshoptimizer-dev
  libstb-dev libtomlplusplus-dev libsqlite3-dev libcli11-dev nlohmann-json3-dev libfmt-dev libpng-dev libjpeg-dev
  libcairo2-dev fonts-dejavu-core fonts-inter fonts-font-awesome
  libglfw3-dev libimgui-dev
  libegl-dev libopengl-dev libgl-dev libgl1-mesa-dri
  libgtest-dev libgmock-dev librapidcheck-dev libbenchmark-dev)
test=(chromium gdal-bin xvfb xdotool)

wanted=("${build[@]}")
if [ "${1:-build}" = nightly ]; then
  wanted+=(clang libclang-rt-14-dev)
fi
if [ "${1:-build}" = test ]; then
  wanted+=("${test[@]}")
  # Node may come from elsewhere than Debian, whose packages would then conflict.
  command -v node >/dev/null || wanted+=(nodejs)
  command -v npm >/dev/null || wanted+=(npm)
fi

missing=()
for package in "${wanted[@]}"; do
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then
  echo "setup: every package is there"
  exit 0
fi

echo "setup: installing ${missing[*]}"
as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || { echo "setup: not root and no sudo; install these yourself: ${missing[*]}" >&2; exit 1; }
  as_root=(sudo)
fi
export DEBIAN_FRONTEND=noninteractive
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
