# Shared by the scripts in this folder; sourced, never run. Every script that sources it runs from the project's root.
# shellcheck shell=bash

set -euo pipefail
script=$(realpath "$0")
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# Compilers and sub-programs obey the presets, not what happens to be set in the caller's environment.
unset CC CXX CFLAGS CXXFLAGS LDFLAGS CMAKE_GENERATOR

# fail MESSAGE: the one line a person needs, on standard error, then the end.
fail() {
  printf '%s: error: %s\n' "$(basename "$0")" "$*" >&2
  exit 1
}

# usage: prints the comment at the head of the running script.
usage() {
  sed -n '2,$ { /^# shellcheck/q; /^#/!q; s/^# \{0,1\}//; p }' "$script"
}

# need PROGRAM PACKAGE: ends with the name of the Debian package if the program is not there.
need() {
  command -v "$1" >/dev/null || fail "'$1' is not installed (Debian package $2; scripts/setup.sh installs what is needed)"
}

step_number=0
# step TITLE: announces the next step with the time since the script started.
step() {
  step_number=$((step_number + 1))
  printf '\n[%d] %s (%d:%02d elapsed)\n' "$step_number" "$*" $((SECONDS / 60)) $((SECONDS % 60))
}

# configure PRESET: configures into the preset's build folder. A folder left by another generator, another compiler or
# another place of the sources is configured afresh, since CMake refuses or mixes such folders.
configure() {
  local preset=$1 folder=build
  [ "$preset" = release ] || folder=build-$preset
  local fresh=()
  local cache=$folder/CMakeCache.txt
  if [ -f "$cache" ]; then
    grep -qxF 'CMAKE_GENERATOR:INTERNAL=Ninja' "$cache" &&
      grep -qE '^CMAKE_CXX_COMPILER:[A-Z]+=(.*/)?clang\+\+-19$' "$cache" &&
      grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$PWD" "$cache" || fresh=(--fresh)
  fi
  cmake "${fresh[@]}" --preset "$preset" || fail "CMake could not configure the project (its message is above)"
}

# build PRESET [TARGET...]
build() {
  local preset=$1
  shift
  cmake --build --preset "$preset" ${1:+--target "$@"} || fail "the build failed (the compiler's message is above)"
}

# use_real_pairs: exports EPILINE_DATA, the folder with real stereo pairs, unless the caller has set it; leaves it unset
# where there is none.
use_real_pairs() {
  local folder
  if [ -n "${EPILINE_DATA:-}" ]; then
    [ -d "$EPILINE_DATA" ] || fail "EPILINE_DATA names '$EPILINE_DATA', which is not a folder"
    EPILINE_DATA=$(realpath "$EPILINE_DATA")
    export EPILINE_DATA
    return
  fi
  for folder in ../shared/data data/downloads; do
    if [ -f "$folder/pairs.json" ]; then
      EPILINE_DATA=$(realpath "$folder")
      export EPILINE_DATA
      return
    fi
  done
  unset EPILINE_DATA
}
