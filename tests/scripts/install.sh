#!/usr/bin/env bash
# cmake --install, and what others build upon it: ten lines with the kernels alone, ten with the library, and the whole
# as a folder of another project.
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
build="$(dirname "$BARCHAN_PROGRAM")"
dir="$(mktemp -d)"
trap 'rm -rf "$dir"' EXIT
fail() { echo "install: $*" >&2; exit 1; }
cached() { sed -n "s/^$1:[A-Z]*=//p" "$build/CMakeCache.txt"; }
compiler="-DCMAKE_CXX_COMPILER=$(cached CMAKE_CXX_COMPILER)"
[ -z "$(cached BARCHAN_SANITIZE)" ] || exit 77  # the library wants its sanitizer's runtime
case "$(cached CMAKE_BUILD_TYPE)" in Release | RelWithDebInfo) ;; *) exit 77 ;; esac

cmake --install "$build" --prefix "$dir/there" > /dev/null
"$dir/there/bin/barchan" --version > /dev/null || fail "the installed program does not start"
[ -f "$dir/there/share/barchan/configs/quickstart.toml" ] || fail "the cases are not installed"

cmake -S "$root/tests/install" -B "$dir/theirs" -G Ninja "$compiler" -DCMAKE_PREFIX_PATH="$dir/there" \
  -DCMAKE_BUILD_TYPE=Debug > "$dir/log" 2>&1 || fail "$(tail -n 20 "$dir/log")"
cmake --build "$dir/theirs" > "$dir/log" 2>&1 || fail "$(tail -n 20 "$dir/log")"
read -r ours theory < <("$dir/theirs/kernels_alone")
[ -n "$theory" ] && [ "$ours" = "$theory" ] || fail "Hertz: $ours, by the formula $theory"
"$dir/theirs/with_core" "$root/configs/quickstart.toml" | grep -q "friction velocity" || fail "the library does not run"

mkdir "$dir/around"
cat > "$dir/around/CMakeLists.txt" << END
cmake_minimum_required(VERSION 3.25)
project(around LANGUAGES C CXX)
add_subdirectory($root barchan)
add_executable(kernels_alone $root/tests/install/kernels_alone.cpp)
target_link_libraries(kernels_alone PRIVATE barchan::kernels)
if(TARGET tests OR TARGET barchan_bench)
  message(FATAL_ERROR "a part of another project has our tests")
endif()
END
cmake -S "$dir/around" -B "$dir/whole" -G Ninja "$compiler" -DKokkos_DIR="$(cached Kokkos_DIR)" > "$dir/log" 2>&1 ||
  fail "as a folder of another project: $(tail -n 20 "$dir/log")"
cmake -S "$root" -B "$dir/old" -G Ninja "$compiler" -DKokkos_DIR="$(cached Kokkos_DIR)" -DBARCHAN_TESTS=OFF \
  > "$dir/log" 2>&1 || fail "an old option: $(tail -n 20 "$dir/log")"
grep -q "BARCHAN_TESTS is called BARCHAN_ENABLE_TESTS now" "$dir/log" || fail "an old option is not told"
grep -q "^BARCHAN_ENABLE_TESTS:BOOL=OFF" "$dir/old/CMakeCache.txt" || fail "an old option does nothing"
echo "install: the program, ten lines with the kernels ($ours N), ten with the library"
