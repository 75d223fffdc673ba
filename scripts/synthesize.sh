#!/usr/bin/env bash
# Yosys: synthesizes generated Verilog for an FPGA and counts what it takes.
#
#   scripts/synthesize.sh VERILOG... TOP -o FOLDER [--target ecp5|hx8k]
#
# Writes FOLDER/TOP.json (netlist for nextpnr), FOLDER/TOP_netlist.v (the same for simulation; of ECP5 with the cells of
# tb/cosim/ecp5_cells.v), FOLDER/resources.json and FOLDER/yosys.log. Fails when Yosys finds a problem (several drivers,
# a combinational loop, an undriven wire, a latch) or when an array did not become RAM, unless its ram_style in the
# Verilog is "registers".
#
# Environment: YOSYS = the program to run (default: yosys; scripts/fpga.sh names the pinned one), YOSYS_OPTIONS = further
# options of synth_ecp5 or synth_ice40.
# shellcheck source=scripts/common.sh
caller=$PWD
source "$(dirname "$0")/common.sh"

positional=()
folder='' target=ecp5
while [ $# -gt 0 ]; do
  case $1 in
    -h | --help)
      usage
      exit 0
      ;;
    -o)
      [ $# -ge 2 ] || fail "$1 needs a value"
      folder=$2
      shift
      ;;
    --target)
      [ $# -ge 2 ] || fail "$1 needs a value"
      target=$2
      shift
      ;;
    -*) fail "unknown argument '$1' (see --help)" ;;
    *) positional+=("$1") ;;
  esac
  shift
done
[ ${#positional[@]} -ge 2 ] && [ -n "$folder" ] ||
  fail "usage: synthesize.sh VERILOG... TOP -o FOLDER [--target ecp5|hx8k]"
case $target in
  ecp5) family=ecp5 synthesis=synth_ecp5 ;;
  hx8k) family=ice40 synthesis='synth_ice40 -device hx' ;;
  *) fail "unknown target '$target' (known: ecp5, hx8k)" ;;
esac

# Names are relative to where the caller stands.
from_caller() { case $1 in /*) echo "$1" ;; *) echo "$caller/$1" ;; esac; }
top=${positional[-1]} folder=$(from_caller "$folder")
sources=() read_sources=''
for name in "${positional[@]::${#positional[@]}-1}"; do
  source_file=$(from_caller "$name")
  [ -r "$source_file" ] && [ ! -d "$source_file" ] || fail "'$source_file' is not a readable file"
  sources+=("$source_file")
  read_sources+="
  read_verilog \"$source_file\""
done
[[ $top =~ ^[A-Za-z_][A-Za-z0-9_]*$ ]] || fail "'$top' is not the name of a module"
yosys=${YOSYS:-yosys}
need "$yosys" yosys
need python3 python3
mkdir -p "$folder" || fail "cannot write to '$folder'"
rm -f "$folder/resources.json" "$folder/$top.json" "$folder/${top}_netlist.v"

# The steps of the synthesis, stopped where the memories are known and again where those that did not fit a RAM are left.
# Loops are visible to Yosys only before it maps to cells; what else that early check says is not yet final.
# "$mem_v2" cells carry the name of the Verilog array in MEMID.
synthesis+=" -top $top ${YOSYS_OPTIONS:-}"
# Operators with a mapping of their own are black boxes until then, so that their widths stay parameters.
operators=''
if [ "$target" = ecp5 ] && grep -q '^module epiline_add_or_subtract' "${sources[@]}"; then
  operators="
    blackbox epiline_add_or_subtract
    hierarchy -top $top
    techmap -map \"$PWD/scripts/ecp5_operators.v\""
fi
# With their final widths, and before Yosys looks for sums of three operands.
adders="proc; flatten; opt -nodffe -nosdff; wreduce; peepopt; opt_clean
  techmap -map \"$PWD/scripts/adders.v\""
# Copies of flip-flops stay black boxes to the end: Yosys would make one of them.
copies='' map_copies=''
if grep -q '^module epiline_copy' "${sources[@]}"; then
  copies='blackbox epiline_copy'
  map_copies="techmap -map \"$PWD/scripts/${family}_copies.v\""
fi
# Yosys runs inside the folder: it takes no quotes around the names of its output files.
if ! (cd "$folder" && "$yosys" -Q -T -q -l yosys.log -p "
  $read_sources
  $copies
  $operators
  $synthesis -run begin:coarse
  $adders
  $synthesis -run coarse:map_ram
  tee -o early_check.txt check
  select -assert-none t:\$_DLATCH* t:\$dlatch %u
  tee -o memories.txt dump t:\$mem_v2
  $synthesis -run map_ram:map_ffram
  tee -o lost_memories.txt dump t:\$mem_v2
  $synthesis -run map_ffram:json -json $top.json
  $map_copies
  clean
  check -assert
  select -assert-none t:\$_DLATCH* t:\$dlatch %u
  delete */t:\$scopeinfo
  write_json $top.json
" >yosys.out 2>&1); then
  grep -h 'ERROR' "$folder/yosys.out" "$folder/yosys.log" | sort -u | head -5 >&2 || true
  fail "Yosys failed; its log is $folder/yosys.log"
fi
if loop=$(grep -m1 -A3 'found logic loop' "$folder/early_check.txt"); then
  fail "the Verilog has a combinational loop: $loop"
fi
# All by way of scripts/netlist_file.py.
if [ "$family" = ecp5 ]; then
  python3 scripts/ram_output_registers.py "$folder/$top.json"
  python3 scripts/carry_chains.py "$folder/$top.json"
  python3 scripts/join_carry_chains.py "$folder/$top.json"
fi
(cd "$folder" && "$yosys" -Q -T -q -l yosys_netlist.log -p "
  read_json $top.json
  tee -q -o statistics.json stat -json
  write_verilog -noattr -simple-lhs ${top}_netlist.v
" >>yosys.out 2>&1) || fail "Yosys cannot read its own netlist; its log is $folder/yosys_netlist.log"
if [ "$family" = ecp5 ]; then python3 scripts/carry_chains.py --open-ends "$folder/$top.json"; fi
python3 scripts/netlist_resources.py "$folder" "$top" "$target" "${sources[@]}"
