#!/usr/bin/env bash
# From a fresh clone to a grown forest: installs what is missing, builds the release preset into build/release and makes
# out/riverbank.glb and out/riverbank.png from examples/riverbank.toml.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/setup.sh build
echo "demo: building"
mkdir -p build
cmake --preset release >build/release.log 2>&1 || { cat build/release.log >&2; exit 1; }
cmake --build --preset release --target bosquet
mkdir -p out
echo "demo: growing the river bank"
build/release/bosquet make examples/riverbank.toml -o out/riverbank.glb -o out/riverbank.png
echo "demo: see out/riverbank.png; open out/riverbank.glb in any glTF viewer"
