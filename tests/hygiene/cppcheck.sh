#!/usr/bin/env bash
# cppcheck over src/, perf/ and tests/, and over kernels/ through them. What it gets wrong is in
# cppcheck_suppressions.txt beside this file, with the reasons. Needs (Debian) cppcheck. JOBS: files at a time.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

command -v cppcheck > /dev/null || { echo "cppcheck: not found (Debian: cppcheck)" >&2; exit 1; }
mkdir -p build/cppcheck
mapfile -t files < <(find src perf tests -name '*.cpp' | sort)
headers=(kernels/*/*.hpp src/*/*.hpp perf/*.hpp tests/*/*.hpp)
# shellcheck disable=SC2054  # the commas are cppcheck's
options=(--std=c++20 --language=c++ --enable=warning,performance,portability,style --inline-suppr
  --library=posix,googletest,openmp -I. --cppcheck-build-dir=build/cppcheck -j "${JOBS:-1}"
  --suppressions-list=tests/hygiene/cppcheck_suppressions.txt --error-exitcode=1 --quiet
  --template='{file}:{line}: {severity}: {message} [{id}]')
# It does not read Kokkos' headers (nor any of the system): what its macros stand for.
options+=(-D__GNUC__ -D__FMA__ -D__x86_64__ -DKOKKOS_LAMBDA='[=]' -DKOKKOS_CLASS_LAMBDA='[=, *this]' -DKOKKOS_FUNCTION=
  -DKOKKOS_INLINE_FUNCTION=inline -DKOKKOS_FORCEINLINE_FUNCTION=inline '-DBARCHAN_SOURCE_DIR=""')
cppcheck "${options[@]}" "${files[@]}" || { echo "cppcheck: findings above" >&2; exit 1; }
echo "cppcheck: ${#files[@]} sources and what they include of ${#headers[@]} headers are clean"
