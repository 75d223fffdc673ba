#!/usr/bin/env bash
# Everything published about FPGAs, again: each run of scripts/fpga/published.txt with three seeds, the synthesized
# netlist of each design on a whole real frame in Verilator against the native engine, and docs/results.md. Takes hours.
#
#   scripts/fpga_nightly.sh            all runs
#   scripts/fpga_nightly.sh TOP...     those of these tops
#
# Works in build-nightly/, whose netlists are made by the pinned Yosys; an interrupted night goes on where it was. Ends
# with exit code 1, after everything was tried, if a clock was not reached or a netlist differs.
#
# Environment: EPILINE_DATA = folder of real pairs (as scripts/test.sh); SEEDS = placements a run (default 3).
# shellcheck source=scripts/common.sh
source "$(dirname "$0")/common.sh"

wanted=()
for argument in "$@"; do
  case $argument in
    -h | --help)
      usage
      exit 0
      ;;
    -*) fail "unknown argument '$argument' (see --help)" ;;
    *)
      grep -q "^$argument " scripts/fpga/published.txt ||
        fail "no published run of a top '$argument' (scripts/fpga/published.txt)"
      wanted+=("$argument")
      ;;
  esac
done
seeds=${SEEDS:-3}
[[ $seeds =~ ^[1-9][0-9]?$ ]] || fail "SEEDS must be a number from 1 to 99, not '$seeds'"

folder=$PWD/build-nightly
export EPILINE_BUILD=$folder EPILINE_FPGA_TOOLS=$folder/fpga-tools

step "Debian packages"
scripts/setup.sh
use_real_pairs
[ -n "${EPILINE_DATA:-}" ] || fail "no real stereo pairs: name their folder in EPILINE_DATA (docs/data.md)"
scene=$(scripts/pair_arguments.py "$EPILINE_DATA" | head -1)
pair_lines=$(scripts/pair_arguments.py "$EPILINE_DATA" "$scene") || exit 1
mapfile -t pair <<<"$pair_lines"

step "the pinned tools"
python3 -B scripts/fpga/tools.py
export YOSYS=$EPILINE_FPGA_TOOLS/bin/yosys

step "configure and build into build-nightly/"
cmake --preset release -B "$folder" || fail "CMake could not configure the project (its message is above)"
cmake --build "$folder" -j 2 --target epiline-hls epiline || fail "the build failed (the compiler's message is above)"

problems=()
tops=()
mapfile -t runs < <(grep -v '^#' scripts/fpga/published.txt)
for run in "${runs[@]}"; do
  read -r -a words <<<"$run"
  top=${words[0]}
  [ ${#wanted[@]} -eq 0 ] || [[ " ${wanted[*]} " == *" $top "* ]] || continue
  name=$(tr -c 'a-z0-9_\n' '_' <<<"${words[*]}" | tr -s _)
  tops+=("$top $folder/fpga/$name")
  step "$run"
  rm -f "$folder/fpga/$name/$top.json"
  scripts/fpga.sh "${words[@]}" --seeds "$seeds" -o "$folder/fpga/$name" || problems+=("$run")
  if [ -f "$folder/fpga/$name/$top.json" ]; then cp "$folder/fpga/$name/$top.json" "docs/results/$name.json"; fi
done

for entry in "${tops[@]}"; do
  read -r top place <<<"$entry"
  step "the netlist of $top on $scene, a whole frame"
  if ! "$folder/bin/epiline" match --list | grep -q "^$top:"; then
    echo "epiline has no design $top: not simulated"
    continue
  fi
  # Of the smallest scene's size, 384x288. Tests cut a part out for smaller designs (tests/cosim/netlist_cells_test.cpp).
  columns=$("$folder/bin/epiline" match --list | sed -n "/^$top:/,/images up to/s/.*images up to \([0-9]*\)x.*/\1/p")
  if [ "$columns" -lt 384 ]; then
    echo "$top takes $columns columns: the scene is too large for it, its netlist runs on a part of it in the tests"
    continue
  fi
  "$folder/bin/epiline" compare --design "$top" --engines native,netlist "${pair[@]}" || problems+=("netlist of $top")
  # What was simulated must be what was placed.
  cmp "$folder/tb/cosim/${top}_netlist.netlist/${top}_netlist.v" "$place/synthesis/${top}_netlist.v" ||
    problems+=("netlist of $top: the one that was simulated is not the one that was placed")
done

step "docs/results.md"
scripts/results_table.py
[ ${#problems[@]} -eq 0 ] || fail "$(printf '%s; ' "${problems[@]}")see above"
echo "fpga_nightly: all ${#tops[@]} runs reached their clocks, all netlists equal native"
