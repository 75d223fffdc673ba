#!/usr/bin/env bash
# Which lines of the compiler (rtl_gen/) its default tests run: builds it for counting into build-coverage/, runs the
# tests, writes build-coverage/coverage/index.html and prints one line.
#
#   scripts/coverage.sh                  all of the compiler's default tests
#   scripts/coverage.sh emit schedule    those of these folders of tests/ only
#   scripts/coverage.sh --least 95       ends with an error below 95 % of the lines
#   scripts/coverage.sh --report         no build and no test: the report of what ran last
#   scripts/coverage.sh -j 1             one job at a time (default: 2)
# shellcheck source=scripts/common.sh
source "$(dirname "$0")/common.sh"

least=0
jobs=2
run_tests=yes
folders=()
while [ $# -gt 0 ]; do
  case $1 in
    --least | -j)
      [[ "${2:-}" =~ ^[0-9]+$ ]] || fail "$1 wants a whole number"
      if [ "$1" = -j ]; then jobs=$2; else least=$2; fi
      shift
      ;;
    --report) run_tests=no ;;
    -h | --help)
      usage
      exit 0
      ;;
    -*) fail "unknown argument '$1' (known: --least, --report, -j)" ;;
    *)
      [ -f "tests/$1/CMakeLists.txt" ] || fail "tests/$1 is no folder of tests"
      folders+=("$1")
      ;;
  esac
  shift
done
[ ${#folders[@]} -gt 0 ] || folders=(dataflow frontend passes prove schedule emit check compiler)
need llvm-cov-19 llvm-19
need llvm-profdata-19 llvm-19

tree=build-coverage
output=$tree/coverage
if [ "$run_tests" = yes ]; then
  step "build for counting"
  configure coverage
  targets=("${folders[@]/#/tests/}")
  cmake --build --preset coverage -j "$jobs" --target epiline-hls "${targets[@]/%//all}" ||
    fail "the build failed (the compiler's message is above)"
  rm -rf "$output"
  mkdir -p "$output/runs"
  # %m: one file a program, into which its runs are added up, %4: four of them, so that runs side by side do not wait.
  export LLVM_PROFILE_FILE=$PWD/$output/runs/%4m.profraw
  for folder in "${folders[@]}"; do
    step "tests/$folder"
    ctest --test-dir "$tree/tests/$folder" -j "$jobs" -LE '^slow$' --no-tests=error --output-on-failure ||
      fail "tests of tests/$folder fail: their coverage says nothing"
  done
fi

mapfile -t runs < <(find "$output/runs" -name '*.profraw' 2>/dev/null)
[ ${#runs[@]} -gt 0 ] || fail "no test has run yet: leave out --report"
llvm-profdata-19 merge -sparse -o "$output/all.profdata" "${runs[@]}"
# The compiler, and the test programs: they link parts of it.
programs=()
for program in "$tree"/bin/*; do
  case $program in
    */epiline-hls | *_test | */compiler_check_levels) programs+=(-object "$program") ;;
  esac
done
counted=("${programs[@]:1}" -instr-profile "$output/all.profdata" -sources rtl_gen)
llvm-cov-19 show "${counted[@]}" -format html -output-dir "$output" -show-directory-coverage
llvm-cov-19 export "${counted[@]}" -summary-only >"$output/summary.json"
python3 - "$output/summary.json" "$least" "$output/index.html" <<'EOF' || fail "less than $least % of the lines of rtl_gen run"
import json, sys

summary, least, page = sys.argv[1:]
with open(summary, encoding="utf-8") as file:
    lines = json.load(file)["data"][0]["totals"]["lines"]
print(f"coverage of rtl_gen: {lines['percent']:.1f} % of {lines['count']} lines ({page})")
sys.exit(lines["percent"] < float(least))
EOF
