#!/bin/sh
# Builds the C++ tests and the program under sanitizers and runs them:
#   tools/sanitize.sh address [WHAT...]     addresses, leaks and undefined behaviour
#   tools/sanitize.sh thread [WHAT...]      data races
# WHAT: programs such as test_sampling, Python tests of the program such as cli.test_mpi, or fuzz_documents (FUZZ_SECONDS,
# 600 by default, and FUZZ_SEED); all of the first by default.
# Builds into build-address or build-thread (BUILD=... elsewhere); what each said is in sanitized/<name>.log there.
# GTEST_FILTER, as GoogleTest has it, chooses tests.
set -e
kind=$1
case "$kind" in
  address | thread) shift ;;
  *) sed -n '2,8s/^# \{0,1\}//p' "$0" >&2; exit 2 ;;
esac
source=$(cd "$(dirname "$0")/.." && pwd)
build=${BUILD:-$source/build-$kind}
mkdir -p "$build/sanitized"
cmake -S "$source" -B "$build" -G Ninja -DIFOV_SANITIZE="$kind" -DIFOV_BENCHMARKS=OFF > "$build/sanitized/cmake.log" || {
  cat "$build/sanitized/cmake.log" >&2
  exit 1
}
if [ $# -eq 0 ]; then
  set -- $(cd "$source/tests" && for room in */; do ls "$room"test_*.cpp > /dev/null 2>&1 && echo "test_${room%/}"; done)
fi
targets=$(for what in "$@"; do case "$what" in *.*) echo ifov kill_at_call jumping_clock ;; fuzz_documents) echo ifov fuzz_readers ;; *) echo "$what" ;; esac; done | sort -u)
cmake --build "$build" --target $targets

# Some Python tests put a library before the sanitizer's own (tests/support/kill_at_call.cpp).
export ASAN_OPTIONS="verify_asan_link_order=0${ASAN_OPTIONS:+:$ASAN_OPTIONS}"
export LSAN_OPTIONS="suppressions=$source/tools/leak_suppressions.txt:print_suppressions=0"
export UBSAN_OPTIONS=print_stacktrace=1
export TSAN_OPTIONS="suppressions=$source/tools/thread_suppressions.txt halt_on_error=1"
export IFOV_PROGRAM="$build/ifov" IFOV_BUILD="$build" IFOV_SANITIZER="$kind"
cd "$source"
failed=
for what in "$@"; do
  log="$build/sanitized/$what.log"
  begin=$(date +%s)
  code=0
  case "$what" in
    # Open MPI leaves memory of modules that it has closed by then, which cannot be named.
    *.*) ASAN_OPTIONS=$ASAN_OPTIONS:detect_leaks=0 /usr/bin/python3 tests/run_unittest.py "tests/${what%%.*}/${what#*.}.py" > "$log" 2>&1 || code=$? ;;
    fuzz_documents) /usr/bin/python3 tests/fuzz/documents/fuzz_documents.py --sanitized --build "$build" \
      --seconds "${FUZZ_SECONDS:-600}" --seed "${FUZZ_SEED:-1}" --finds "$build/sanitized/finds" > "$log" 2>&1 || code=$? ;;
    *) "$build/$what" > "$log" 2>&1 || code=$? ;;
  esac
  took=$(($(date +%s) - begin))
  if [ "$code" -eq 0 ]; then
    echo "$what: ok, $took s: $(grep -E '\[  PASSED  \]|^Ran |^finds: ' "$log" | tail -1)"
  else
    echo "$what: FAILED ($code), $took s: $log"
    grep -E -m 3 '^find: |^SUMMARY|runtime error|\[  FAILED  \]|^(FAIL|ERROR):|WARNING: ThreadSanitizer' "$log" | sed 's/^/  /' || true
    failed="$failed $what"
  fi
done
[ -z "$failed" ] || { echo "failed:$failed" >&2; exit 1; }
