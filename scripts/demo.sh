#!/usr/bin/env bash
# The whole path of one design on a real stereo pair: builds everything, runs the C-simulation, compiles the same C++
# source to Verilog, runs that Verilog in Verilator on the same pair with random stalls, compares bit for bit, synthesizes.
#
#   scripts/demo.sh             on Middlebury's Motorcycle
#   scripts/demo.sh SCENE       on another scene of the folder of pairs (scripts/pair_arguments.py FOLDER lists them)
#
# Environment: EPILINE_DATA = folder of pairs (default: ../shared/data if it exists, else data/downloads, into which the
# pair is fetched from a Debian package). Everything is written to build/demo/.
# shellcheck source=scripts/common.sh
source "$(dirname "$0")/common.sh"

case ${1:-} in
  -h | --help)
    usage
    exit 0
    ;;
  -*) fail "unknown argument '$1'" ;;
esac
scene=${1:-motorcycle}
design=color_fuzzy
source_file=hls/tops/$design.cpp
out=build/demo
gaps=25 stalls=25 seed=1

step "Debian packages"
scripts/setup.sh

step "a real stereo pair"
use_real_pairs
if [ -z "${EPILINE_DATA:-}" ]; then
  scripts/fetch_data.py motorcycle_skimage || fail "no real stereo pair: put pairs into a folder and name it in EPILINE_DATA"
  use_real_pairs
fi
# The same picture has another name where it comes from another source, since its size differs a little.
if [ "$scene" = motorcycle ] && ! scripts/pair_arguments.py "$EPILINE_DATA" | grep -qx motorcycle; then
  scene=motorcycle_skimage
fi
pair_lines=$(scripts/pair_arguments.py "$EPILINE_DATA" "$scene") || exit 1
mapfile -t pair <<<"$pair_lines"
echo "$scene: ${pair[0]} and ${pair[1]}, ${pair[3]} levels"

step "configure and build (the first time takes some minutes)"
configure release
build release
mkdir -p "$out"

step "C-simulation: the C++ source, run natively"
build/bin/epiline match --design "$design" --engine native "${pair[@]}" --json "$out/native.json" ||
  fail "the C-simulation failed"

step "$source_file to Verilog"
build/bin/epiline-hls "$PWD/$source_file" --top "$design" --target ecp5 --clock 6ns -o "$out/rtl" ||
  fail "the compilation to Verilog failed"
# The build made the same file for the simulation model below.
cmp "$out/rtl/$design.v" "build/tb/cosim/${design}_rtl.rtl/$design.v" ||
  fail "the Verilog is not the one that the simulation was built from"

step "that Verilog in Verilator, without stalls: cycles, accuracy, picture"
build/bin/epiline match --design "$design" --engine rtl "${pair[@]}" -o "$out/disparity.pfm" \
  --picture "$out/disparity.png" --json "$out/rtl.json" || fail "the simulation of the Verilog failed"

step "native, golden model and Verilog, bit for bit, with random stalls ($gaps % input gaps, $stalls % output stalls, seed $seed)"
build/bin/epiline compare --design "$design" --engines native,golden,rtl "${pair[@]}" --input-gaps "$gaps" \
  --output-stalls "$stalls" --seed "$seed" --json "$out/compare.json" || fail "the engines do not agree"

step "Yosys: resources of the Verilog on ECP5"
scripts/synthesize.sh "$out/rtl/$design.v" "$design" -o "$out/synthesis" || fail "the synthesis failed"

step "done"
cat <<END
native = golden = RTL: bit-identical on $scene

disparity picture, made by the RTL   $PWD/$out/disparity.png
disparities as numbers               $PWD/$out/disparity.pfm
Verilog                              $PWD/$out/rtl/$design.v
report of the compiler               $PWD/$out/rtl/report.txt
figures                              $PWD/$out/rtl.json, compare.json, native.json
END
