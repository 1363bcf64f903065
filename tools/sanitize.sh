#!/bin/sh
# Builds the C++ tests and the program under sanitizers and runs them:
#   tools/sanitize.sh address [TEST...]     addresses and undefined behaviour
#   tools/sanitize.sh thread [TEST...]      data races
# TEST: programs such as test_sampling; all of them by default. Builds into build-address or build-thread (BUILD=... elsewhere).
set -e
kind=$1
case "$kind" in
  address | thread) shift ;;
  *) sed -n '2,5s/^# \{0,1\}//p' "$0" >&2; exit 2 ;;
esac
source=$(cd "$(dirname "$0")/.." && pwd)
build=${BUILD:-$source/build-$kind}
cmake -S "$source" -B "$build" -G Ninja -DIFOV_SANITIZE="$kind" -DIFOV_BENCHMARKS=OFF > /dev/null
if [ $# -eq 0 ]; then
  set -- $(cd "$source/tests" && for room in */; do ls "$room"test_*.cpp > /dev/null 2>&1 && echo "test_${room%/}"; done)
fi
cmake --build "$build" --target "$@"
export ASAN_OPTIONS=detect_leaks=0
export UBSAN_OPTIONS=print_stacktrace=1
export TSAN_OPTIONS="suppressions=$source/tools/thread_suppressions.txt halt_on_error=1"
failed=
for test in "$@"; do
  echo "== $test"
  (cd "$source" && "$build/$test" --gtest_brief=1) || failed="$failed $test"
done
[ -z "$failed" ] || { echo "failed:$failed" >&2; exit 1; }
