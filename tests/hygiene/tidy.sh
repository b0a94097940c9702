#!/usr/bin/env bash
# clang-tidy over every source of src/, perf/ and tests/, and over kernels/ through them:
#   tests/hygiene/tidy.sh [FILE...]
# The checks, and why some are off, are in .clang-tidy and tests/.clang-tidy. What was clean is looked at
# again when it, a header of ours that it includes, the checks or the tool have changed; ALL=1 looks at
# every file. QUICK=1 leaves out clang-analyzer-*, which takes most of the time.
# Needs (Debian) clang-tidy-22, or CLANG_TIDY=PROGRAM. JOBS: files at a time.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

export tidy="${CLANG_TIDY:-clang-tidy-22}" build=build/tidy
# Warnings are left to g++ (-w), which takes fma for a constant where clang does not. Clang is told an
# instruction set, so that what is written for fused multiply-add is seen. omp.h: g++'s will do.
export options="--extra-arg=-w --extra-arg=-Wno-invalid-constexpr"
options+=" --extra-arg=-idirafter --extra-arg=$(g++ -print-file-name=include)"
if [ "$(uname -m)" = x86_64 ]; then options+=" --extra-arg=-march=x86-64-v3"; fi
# The analyzer follows few paths through a function: with more it spends its time in Kokkos' reference counts.
for option in mode=shallow max-nodes=20000; do
  options+=" --extra-arg=-Xclang --extra-arg=-analyzer-config --extra-arg=-Xclang --extra-arg=$option"
done
export clean=$build/clean
if [ "${QUICK:-0}" != 0 ]; then options+=" --checks=-clang-analyzer-*" clean=$build/clean_quick; fi

command -v "$tidy" > /dev/null || { echo "tidy: no $tidy (Debian: clang-tidy-22)" >&2; exit 1; }
mkdir -p $clean
cmake --preset release -B $build -DBARCHAN_ENABLE_PCH=OFF -DBARCHAN_ENABLE_UNITY=OFF -DBARCHAN_ENABLE_NATIVE=OFF \
  > $build/configure.log 2>&1 ||
  { tail -n 20 $build/configure.log >&2; exit 1; }
mapfile -t all < <(sed -nE 's#^ *"file": "(.*)".*#\1#p' $build/compile_commands.json |
  sed -n "s#^$PWD/##p" | grep -E '^(src|perf|tests)/' | sort -u)
[ ${#all[@]} -gt 0 ] || { echo "tidy: nothing to look at" >&2; exit 1; }
if [ $# -gt 0 ]; then files=("$@"); else files=("${all[@]}"); fi

state_of() {  # a name for FILE as it is, with all of ours that it includes, directly or not
  local todo=("$1") file include
  local -A seen=()
  while [ ${#todo[@]} -gt 0 ]; do
    file=${todo[0]}
    todo=("${todo[@]:1}")
    if [ -n "${seen[$file]:-}" ] || [ ! -f "$file" ]; then continue; fi
    seen[$file]=1
    while IFS= read -r include; do todo+=("$include"); done < <(sed -nE 's/^#include "([^"]+)".*/\1/p' "$file")
  done
  { "$tidy" --version; echo "$options"; grep -hv '^#' .clang-tidy tests/.clang-tidy
    printf '%s\n' "${!seen[@]}" | sort | xargs -d '\n' sha256sum; } | sha256sum
}

look_at() {  # prints what is found in FILE
  local mark=$clean/${1//\//_} state log
  state="$(state_of "$1")"
  if [ "${ALL:-0}" = 0 ] && [ "$(cat "$mark" 2> /dev/null)" = "$state" ]; then return 0; fi
  rm -f "$mark"
  # shellcheck disable=SC2086  # one word an option
  if log="$("$tidy" -p $build --quiet $options "$1" 2>&1)"; then echo "$state" > "$mark"; else echo "$log"; return 1; fi
}
export -f state_of look_at

# shellcheck disable=SC2016  # expanded by the inner bash
printf '%s\n' "${files[@]}" | xargs -d '\n' -n 1 -P "${JOBS:-1}" bash -c 'look_at "$1" || exit 1' look_at ||
  { echo "tidy: findings above" >&2; exit 1; }
headers=(kernels/*/*.hpp src/*/*.hpp perf/*.hpp tests/*/*.hpp)
echo "tidy: ${#files[@]} sources (of ${#all[@]}) and what they include of ${#headers[@]} headers are clean"
