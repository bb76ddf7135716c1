#!/usr/bin/env bash
# What takes too long for scripts/test.sh: 1,000 killed sessions, 10,000 damaged files, ten minutes of fuzzing for each
# reader, threads under ThreadSanitizer, memory after 10,000 edits.
# scripts/nightly.sh [kills|damages|fuzz|threads|leaks]; without a word all of them.
# FUZZ_SECONDS=60 shortens the fuzzing. docs/reliability.md tells what each shows.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/setup.sh nightly
parts=("$@")
[ ${#parts[@]} -gt 0 ] || parts=(kills damages fuzz threads leaks)
configure() {
  mkdir -p build
  cmake --preset "$1" >"build/$1.log" 2>&1 || { cat "build/$1.log" >&2; exit 1; }
}

for part in "${parts[@]}"; do
  echo "nightly: $part"
  case "$part" in
    kills)
      configure release
      cmake --build --preset release --target kill_test
      BOSQUET_KILLS=1000 build/release/tests/reliability/kill_test
      ;;
    damages)
      configure release
      cmake --build --preset release --target reliability_test
      BOSQUET_DAMAGES=10000 build/release/tests/reliability/reliability_test --gtest_filter='DamageTest.*'
      ;;
    fuzz)
      configure fuzz
      readers=(recipe inventory shapes elevation mesh tree image project project_text)
      cmake --build --preset fuzz --target "${readers[@]/%/_fuzz}"
      for reader in "${readers[@]}"; do
        # New cases go into a folder of their own; those that find something are kept beside it.
        mkdir -p "build/fuzz/found/$reader"
        build/fuzz/tests/fuzz/"${reader}_fuzz" -max_total_time="${FUZZ_SECONDS:-600}" -timeout=20 -rss_limit_mb=4096 \
          -print_final_stats=1 -artifact_prefix="build/fuzz/found/$reader-" \
          "build/fuzz/found/$reader" "tests/fuzz/corpus/$reader"
      done
      ;;
    threads)
      # Loops run on plain threads there: Debian's oneTBB is not built for ThreadSanitizer.
      mkdir -p build
      cmake -S . -B build/tsan -G Ninja -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG="-O1 -g1" -DBOSQUET_TSAN=ON \
        -DBOSQUET_BENCH=OFF >build/tsan.log 2>&1 || { cat build/tsan.log >&2; exit 1; }
      cmake --build build/tsan --target pipeline_test document_test project_test crowns_test
      TSAN_OPTIONS=detect_deadlocks=0 ctest --test-dir build/tsan --output-on-failure --no-tests=error \
        -R '^(pipeline|document|project|crowns)\.'
      ;;
    leaks)
      configure dev
      cmake --build --preset dev --target many_edits_test
      ASAN_OPTIONS=detect_leaks=1 LSAN_OPTIONS=suppressions=tests/leaks.supp \
        build/dev/tests/scene/many_edits_test --gtest_filter='*TenThousand*'
      ;;
    *)
      echo "nightly: unknown part '$part'; known: kills damages fuzz threads leaks" >&2
      exit 1
      ;;
  esac
done
echo "nightly: done"
