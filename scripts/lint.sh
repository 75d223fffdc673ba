#!/usr/bin/env bash
# Static checks that are too slow for the default tests: clang-tidy on C++, shellcheck on scripts.
#
#   scripts/lint.sh             files changed since the last commit
#   scripts/lint.sh --all       every file
#   scripts/lint.sh FILE...     these (C++ sources and shell scripts)
# Needs scripts/setup.sh --lint once, and a configured build/ (scripts/test.sh leaves one).
# shellcheck source=scripts/common.sh
source "$(dirname "$0")/common.sh"

need clang-tidy-19 clang-tidy-19
need shellcheck shellcheck
[ -f build/compile_commands.json ] || fail "build/ is not configured: run 'cmake --preset release' first"

case ${1:-} in
  '') mapfile -t files < <(git diff --name-only --diff-filter=d HEAD && git ls-files --others --exclude-standard) ;;
  --all) mapfile -t files < <(git ls-files --cached --others --exclude-standard) ;;
  -*) fail "unknown argument '$1' (known: --all)" ;;
  *) files=("$@") ;;
esac

shell_scripts=()
sources=()
for file in "${files[@]}"; do
  case $file in
    *.sh | .ci/run) [ ! -f "$file" ] || shell_scripts+=("$file") ;;
    # Headers are checked where a source includes them; sources that no target builds cannot be checked.
    *.cpp) ! grep -qF "\"$PWD/$file\"" build/compile_commands.json || sources+=("$PWD/$file") ;;
  esac
done

status=0
scripts/format.sh --check || status=1
if [ ${#shell_scripts[@]} -gt 0 ]; then
  shellcheck -x -S warning "${shell_scripts[@]}" || status=1
fi
if [ ${#sources[@]} -gt 0 ]; then
  printf '%s\0' "${sources[@]}" | xargs -0 -n 1 -P 2 clang-tidy-19 --quiet -p build || status=1
fi
[ "$status" -eq 0 ] || fail "some checks failed (see above)"
echo "lint: ${#sources[@]} C++ sources and ${#shell_scripts[@]} shell scripts are clean"
