#!/usr/bin/env bash
# Random programs through the whole compiler: native by two C++ compilers = dataflow graph = RTL in Verilator under
# random pauses. Finished batches are kept: a run that was stopped (Ctrl-C, kill) goes on with the same command. A program
# that fails is kept with its seed and reduced. docs/fuzzing.md explains the statistics.
#
#   scripts/fuzz.sh --programs N --seed S -j 2      N programs, seeds S to S+N-1 (default: 1000 from 1000, 2 jobs)
#   scripts/fuzz.sh --reduce NAME                   reduces a program kept as failing (again)
#   scripts/fuzz.sh --keep NAME AS                  makes a kept failure the regression test AS
#
# Other options: --state FOLDER (default: fuzz in the build folder), --batch N, --group N (modules in one Verilator
# build), --no-reduce, --statistics FILE (a copy of the statistics if nothing failed).
# Environment: EPILINE_BUILD = a build folder that is ready (default: build, configured and built first).
# shellcheck source=scripts/common.sh
source "$(dirname "$0")/common.sh"

case ${1:-} in
  -h | --help)
    usage
    exit 0
    ;;
esac
command=fuzz.py
arguments=()
while [ $# -gt 0 ]; do
  case $1 in
    --programs | --seed | --state | --batch | --group | --statistics | -j | --jobs)
      [ $# -ge 2 ] || fail "$1 needs a value"
      arguments+=("$1" "$2")
      shift
      ;;
    --no-reduce) arguments+=("$1") ;;
    --reduce)
      [ $# -ge 2 ] || fail "--reduce needs the name of a program, like random_123"
      command=reduce_program.py
      arguments+=(--reduce "$2")
      shift
      ;;
    --keep)
      [ $# -ge 3 ] || fail "--keep needs the name of a program and one for the test"
      command=reduce_program.py
      arguments+=(--keep "$2" "$3")
      shift 2
      ;;
    *) fail "unknown argument '$1' (known: --programs, --seed, -j, --state, --batch, --group, --statistics, --no-reduce, --reduce, --keep)" ;;
  esac
  shift
done

need g++ g++
need cvise cvise
need verilator verilator
folder=${EPILINE_BUILD:-}
if [ -z "$folder" ]; then
  folder=build
  configure release >/dev/null
  build release compiler_test_programs >/dev/null
fi
[ -x "$folder/bin/compiler_check_levels" ] ||
  fail "$folder has no compiler_check_levels: build the target compiler_test_programs"
exec python3 tests/compiler/"$command" --build "$folder" --state "$folder/fuzz" "${arguments[@]}"
