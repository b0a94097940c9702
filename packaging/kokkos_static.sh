#!/usr/bin/env bash
# Builds Kokkos from its sources, to be linked statically: packaging/kokkos_static.sh SOURCES PREFIX [CMAKE OPTIONS]
# For packages of systems that have no Kokkos 4.6. OpenMP, any processor of the architecture; more by CMake's options,
# such as -DKokkos_ENABLE_CUDA=ON.
set -euo pipefail
[ $# -ge 2 ] || { echo "usage: packaging/kokkos_static.sh SOURCES PREFIX [CMAKE OPTIONS]" >&2; exit 2; }
sources=$1 prefix=$2
shift 2
build="$(mktemp -d)"
trap 'rm -rf "$build"' EXIT
cmake -S "$sources" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX="$prefix" \
  -DCMAKE_INSTALL_LIBDIR=lib -DCMAKE_POSITION_INDEPENDENT_CODE=ON -DCMAKE_CXX_STANDARD=20 -DBUILD_SHARED_LIBS=OFF \
  -DKokkos_ENABLE_OPENMP=ON "$@"
cmake --build "$build"
cmake --install "$build" > "$build/install.log"
cp "$sources/LICENSE" "$prefix/LICENSE"
Kokkos_ROOT="$prefix" "$(dirname "${BASH_SOURCE[0]}")/../scripts/probe_kokkos.sh"  # does it work?
