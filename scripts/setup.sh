#!/usr/bin/env bash
# Installs what Epiline needs on Debian 12, from Debian's own packages. Safe to run again: it then only looks.
#
#   scripts/setup.sh            everything to build, test and run
#   scripts/setup.sh --lint     also what scripts/lint.sh needs
#   scripts/setup.sh --check    installs nothing; names what is missing and exits with 1 if something is
# shellcheck source=scripts/common.sh
source "$(dirname "$0")/common.sh"

packages=(
  # compilers and build: clang-19 builds everything and is the front end of epiline-hls; the kernels must compile with g++
  clang-19 libclang-rt-19-dev llvm-19-dev g++ make cmake ninja-build pkg-config git
  # what llvm-19-dev's CMake files look for
  zlib1g-dev libzstd-dev libxml2-dev
  # libraries
  liblemon-dev libopencv-dev libeigen3-dev libcli11-dev nlohmann-json3-dev libfmt-dev libgtest-dev libgmock-dev
  libbenchmark-dev libz3-dev
  # hardware tools; those of scripts/fpga.sh that are not pinned packages of PyPI, which python3-venv is for
  verilator yosys iverilog z3
  nextpnr-ice40 fpga-icestorm openfpgaloader python3-venv
  # reduces the random programs of scripts/fuzz.sh that fail
  cvise
  # scripts (python3: the standard library only, but for the tests of report.json, which need jsonschema), and the check
  # of the sources' format, which is one of the tests
  python3 python3-jsonschema ca-certificates clang-format-19
)
lint_packages=(clang-tidy-19 shellcheck)

check_only=no
for argument in "$@"; do
  case $argument in
    --lint) packages+=("${lint_packages[@]}") ;;
    --check) check_only=yes ;;
    -h | --help)
      usage
      exit 0
      ;;
    *) fail "unknown argument '$argument' (known: --lint, --check)" ;;
  esac
done

if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
  fail "this script needs Debian's apt-get; elsewhere install the equivalents of: ${packages[*]}"
fi

# Packages of the list that are not fully installed, one a line.
missing_packages() {
  local installed package
  installed=$(dpkg-query --show --showformat='${db:Status-Abbrev} ${Package}\n' "${packages[@]}" 2>/dev/null |
    sed -n 's/^.i  *//p' || true)
  for package in "${packages[@]}"; do
    grep -qxF -- "$package" <<<"$installed" || printf '%s\n' "$package"
  done
}

mapfile -t missing < <(missing_packages)
if [ ${#missing[@]} -eq 0 ]; then
  echo "setup: all ${#packages[@]} Debian packages are installed"
  exit 0
fi
echo "setup: ${#missing[@]} of ${#packages[@]} Debian packages are missing: ${missing[*]}"
[ "$check_only" = no ] || exit 1

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || fail "installing packages needs root: run this script as root, or install sudo"
  as_root=(sudo)
fi
apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -y -q -o DPkg::Lock::Timeout=600 -o Acquire::Retries=3)

echo "setup: apt-get update"
"${apt[@]}" update || fail "'apt-get update' failed (its message is above); is the network reachable?"
echo "setup: apt-get install --no-install-recommends ${missing[*]}"
"${apt[@]}" install --no-install-recommends "${missing[@]}" ||
  fail "apt-get could not install the packages (its message is above); the list is made for Debian 12 (bookworm)"

mapfile -t missing < <(missing_packages)
[ ${#missing[@]} -eq 0 ] || fail "still missing after the installation: ${missing[*]}"
echo "setup: done"
