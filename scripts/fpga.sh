#!/usr/bin/env bash
# From a C++ top to a bitstream: epiline-hls, Yosys, nextpnr for several placement seeds, the packer of the device.
#
#   scripts/fpga.sh TOP [--target ecp5-85k|ecp5-45k|ecp5-25k|ecp5-12k|hx8k] [--speed 6|7|8] [--clock NS]
#                       [--board ulx3s-85f] [--seeds N | --seed-list A,B,..] [-o FOLDER]
#
# TOP is a name of hls/tops, or SOURCE.cpp:TOP. `scripts/fpga.sh --help` lists everything; docs/fpga.md explains the
# figures. Writes FOLDER (default build/fpga/TOP-TARGET): TOP.json, the bitstream, and a folder a step. An interrupted
# run goes on where it was when the same command is given again. Ends with exit code 1 when the clock is not reached.
#
# Environment: EPILINE_BUILD = a build folder to use as it is (default: build, which is then brought up to date);
# EPILINE_FPGA_TOOLS = folder of the pinned tools (default build/fpga-tools, filled on first use from PyPI).
# shellcheck source=scripts/common.sh
EPILINE_CALLER=$PWD
export EPILINE_CALLER
source "$(dirname "$0")/common.sh"

if command -v python3 >/dev/null; then
  python3 -B scripts/fpga --check-arguments "$@" || exit $?
  for argument in "$@"; do
    case $argument in -h | --help) exit 0 ;; esac
  done
fi
if [ -z "${EPILINE_BUILD:-}" ]; then
  step "Debian packages"
  scripts/setup.sh
  step "epiline-hls and epiline (the first time takes some minutes)"
  configure release
  build release epiline-hls epiline
fi
exec python3 -B scripts/fpga "$@"
