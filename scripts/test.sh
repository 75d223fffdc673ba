#!/usr/bin/env bash
# Sets up, builds, and runs the tests. Exit code 0 only if everything passed.
#
#   scripts/test.sh             the default tests (what CI runs; all but the label `slow`)
#   scripts/test.sh --all       the slow ones too
#   scripts/test.sh --debug     in the debug preset: address and undefined-behaviour sanitizers
#
# Environment: EPILINE_DATA = folder with real stereo pairs (default: ../shared/data if it exists, else data/downloads
# if scripts/fetch_data.py has filled it; without real pairs the tests that need them are skipped).
# shellcheck source=scripts/common.sh
source "$(dirname "$0")/common.sh"

preset=release
suffix=
for argument in "$@"; do
  case $argument in
    --all) suffix=-all ;;
    --debug) preset=debug ;;
    -h | --help)
      usage
      exit 0
      ;;
    *) fail "unknown argument '$argument' (known: --all, --debug)" ;;
  esac
done

step "Debian packages"
scripts/setup.sh

step "configure (preset $preset)"
configure "$preset"

step "build"
build "$preset"

use_real_pairs
step "tests${EPILINE_DATA:+ (real pairs: $EPILINE_DATA)}"
# ctest's own summary ends the output. No tests at all would be a broken set-up, not a success.
ctest --preset "$preset$suffix" --no-tests=error
