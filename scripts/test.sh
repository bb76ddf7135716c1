#!/usr/bin/env bash
# All tests: the release build with everything, then the dev build (address and undefined-behaviour sanitizers) with the
# quick tests.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/setup.sh test
configure() {
  mkdir -p build
  cmake --preset "$1" >"build/$1.log" 2>&1 || { cat "build/$1.log" >&2; exit 1; }
}

echo "test: npm packages of the file judges"
(cd tests/web && npm ci --no-audit --no-fund --loglevel=error)

echo "test: release build"
configure release
cmake --build --preset release
ctest --test-dir build/release --output-on-failure --no-tests=error -j "$(nproc)"

echo "test: dev build (sanitizers)"
configure dev
cmake --build --preset dev
# LeakSanitizer's own tracer now and then dies while the software GL driver's threads end. Only then what failed is run again.
dev_tests=(ctest --test-dir build/dev --output-on-failure --no-tests=error -j "$(nproc)" -L quick)
if ! "${dev_tests[@]}"; then
  grep -q "Tracer caught signal" build/dev/Testing/Temporary/LastTest.log || exit 1
  "${dev_tests[@]}" --rerun-failed
fi
