#!/usr/bin/env bash
# Lays out every C++ source of the project by .clang-format.
#
#   scripts/format.sh           rewrites the files
#   scripts/format.sh --check   changes nothing; names every file that is laid out differently (one of the default tests)
# shellcheck source=scripts/common.sh
source "$(dirname "$0")/common.sh"

need clang-format-19 clang-format-19
mapfile -t sources < <(find hls rtl_gen tb tests -type f \( -name '*.hpp' -o -name '*.h' -o -name '*.cpp' \) | sort)
[ ${#sources[@]} -gt 0 ] || fail "no C++ sources found"

case ${1:-} in
  '') clang-format-19 -i -- "${sources[@]}" ;;
  --check)
    complaints=$(clang-format-19 --dry-run --Werror -- "${sources[@]}" 2>&1) || true
    unformatted=$(sed -n 's/^\([^ :]*\):[0-9].*/  \1/p' <<<"$complaints" | sort -u)
    [ -z "$complaints" ] || [ -n "$unformatted" ] || fail "clang-format-19 failed: $complaints"
    [ -z "$unformatted" ] || fail "not laid out by .clang-format (scripts/format.sh mends it):
$unformatted"
    echo "${#sources[@]} files are laid out by .clang-format"
    ;;
  *) fail "unknown argument '$1' (known: --check)" ;;
esac
