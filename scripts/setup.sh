#!/usr/bin/env bash
# Brings the machine to where the project builds: Debian packages by apt, and Kokkos.
# scripts/setup.sh [--tests] [--docs] [--quiet]
#   --tests: also what the tests and benchmarks need, not only a run and its pictures
#   --docs: also what the site of the documentation needs
#   --quiet: say nothing when there is nothing to do, and ask nothing
# Installs only what is missing, upgrades nothing, needs no network when all is there. Who is not root is asked before
# sudo is called, or told the command.
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
deps="${BARCHAN_DEPS:-$root/build/deps}"
stamp="$deps/setup.stamp"
speaker="barchan setup"
# shellcheck source=scripts/progress.sh
. "$root/scripts/progress.sh"

packages=(cmake g++ ninja-build pkg-config libopenmpi-dev openmpi-bin libhdf5-openmpi-dev libfftw3-dev
  libtomlplusplus-dev libcli11-dev libeigen3-dev libfmt-dev nlohmann-json3-dev zlib1g-dev
  python3 python3-h5py python3-numpy python3-matplotlib python3-pandas python3-xarray)
test_packages=(git libgtest-dev libbenchmark-dev python3-scipy
  python3-pytest mypy python3-nbconvert python3-ipykernel  # the Python package
  python3-pip python3-venv python3-wheel  # its installation
  python3-yaml python3-jsonschema  # the citation file; the schema of a case
  nodejs node-jsdom)  # the report page
docs_packages=(mkdocs mkdocs-material mkdocstrings mkdocstrings-python-handlers python3-nbconvert libjs-mathjax
  fonts-mathjax fonts-inter)
if [ "${CI:-}" = true ]; then test_packages+=(chromium "${docs_packages[@]}"); fi  # large; elsewhere tests are skipped

quiet=no
tests=no
for argument in "$@"; do
  case $argument in
    --quiet) quiet=yes ;;
    --tests)
      tests=yes
      packages+=("${test_packages[@]}")
      ;;
    --docs) packages+=("${docs_packages[@]}") ;;
    *) die 2 "unknown option '$argument'; there are --tests, --docs and --quiet" ;;
  esac
done

missing_packages() {  # one name a line; a package that was removed but configured counts as missing
  local installed
  # shellcheck disable=SC2016  # ${Package} is dpkg-query's own syntax
  installed="$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' "${packages[@]}" 2> /dev/null |
    sed -n 's/^installed //p')" || true
  comm -23 <(printf '%s\n' "${packages[@]}" | sort -u) <(sort -u <<< "$installed")
}

apt_install() {
  local as_root=() answer=""
  if [ "$(id -u)" -ne 0 ]; then
    say "packages are missing. As root: apt-get install --no-install-recommends $*"
    command -v sudo > /dev/null || die 1 "nothing was installed"
    [ "$quiet" = no ] && [ -t 0 ] || die 1 "nothing was installed; ./barchan setup does it with sudo, if you agree"
    read -r -p "barchan setup: run this with sudo now? [y/N] " answer
    [[ $answer == [yY]* ]] || die 1 "nothing was installed"
    as_root=(sudo)
  fi
  as_root+=(env DEBIAN_FRONTEND=noninteractive)
  say "missing packages: $*"
  mkdir -p "$deps"
  : > "$deps/apt.log"
  if [ "$apt_updated" = no ]; then
    progress "reading the lists of packages" "$deps/apt.log" true "${as_root[@]}" apt-get -qq update ||
      say "warning: apt-get update reported problems; trying with what it knows"
    apt_updated=yes
  fi
  progress "installing packages ($#, and what they need)" "$deps/apt.log" apt_state \
    "${as_root[@]}" apt-get -qq install --yes --no-install-recommends --no-upgrade "$@" ||
    { tail -n 5 "$deps/apt.log" >&2; die 1 "apt-get install failed (full output in $deps/apt.log)."; }
}

apt_state() {  # apt_state LOG: how far apt has come
  local unpacked
  unpacked="$(grep -c '^Unpacking' "$1")" || { echo "fetching"; return; }
  echo "$unpacked unpacked, $(grep -c '^Setting up' "$1") set up"
}

check_tools() {  # a machine without apt, such as a cluster: modules or the user must provide them
  local tool
  for tool in cmake ninja mpicxx; do
    command -v "$tool" > /dev/null || die 1 "'$tool' was not found; install it or load its module."
  done
}

system_kokkos_is_new_enough() {  # what apt would install: 4.6 or newer?
  local candidate
  candidate="$(apt-cache policy libkokkos-dev 2> /dev/null | awk '$1 == "Candidate:" { print $2 }')"
  [ -n "$candidate" ] && [ "$candidate" != "(none)" ] && dpkg --compare-versions "$candidate" ge 4.6
}

provide_kokkos() {
  local found
  if ! found="$("$root/scripts/probe_kokkos.sh" 2> "$deps/kokkos.log")"; then
    # CMake's words for a compiler that is not there, or that compiles nothing: another Kokkos would not help.
    ! grep -qE "CMAKE_CXX_COMPILER not set|able to compile a simple test program" "$deps/kokkos.log" ||
      die 1 "no C++ compiler that works: CXX='${CXX:-}' (see $deps/kokkos.log)."
    [ -z "${Kokkos_ROOT:-}${Kokkos_DIR:-}" ] ||
      die 1 "the Kokkos in Kokkos_ROOT='${Kokkos_ROOT:-$Kokkos_DIR}' does not build a small program (see $deps/kokkos.log)."
    [ "$has_apt" = yes ] || die 1 "Kokkos 4.6 or newer was not found; set Kokkos_ROOT."
    if system_kokkos_is_new_enough; then
      apt_install libkokkos-dev
    else
      progress "unpacking Kokkos of Debian unstable into $deps/kokkos (nothing is installed)" "$deps/kokkos.log" true \
        "$root/scripts/kokkos_prefix.sh" "$deps/kokkos" || { tail -n 16 "$deps/kokkos.log" >&2; exit 1; }
    fi
    found="$("$root/scripts/probe_kokkos.sh" 2> "$deps/kokkos.log")" ||
      die 1 "Kokkos does not build a small program (see $deps/kokkos.log)."
  fi
  say "$found"
}

# What the answer of the last full check depended on; the prefix is looked at besides.
fingerprint() {
  printf '%s\n' "$root" "$deps" "${Kokkos_ROOT:-}" "${Kokkos_DIR:-}" "${CMAKE_PREFIX_PATH:-}" "${CXX:-}"
  cat "$root/scripts/setup.sh" "$root/scripts/kokkos_prefix.sh" "$root/scripts/probe_kokkos.sh" "$root/cmake/kokkos.cmake" | cksum
  if [ -d "$deps/kokkos" ]; then echo "private kokkos"; fi
}

has_apt=no
apt_updated=no
missing=""
if command -v dpkg-query apt-get > /dev/null; then
  has_apt=yes
  # What reads the files for ParaView, for a test. ParaView has its own, and apt would remove that.
  if [ "$tests" = yes ] && ! dpkg-query -W -f '${db:Status-Status}' python3-paraview 2> /dev/null | grep -qx installed
  then packages+=(python3-vtk9); fi
  missing="$(missing_packages)"
  # With it apt does not take python3-scipy for matplotlib's fonts, which brings 350 MB more.
  if [[ $missing == *python3-matplotlib* ]]; then missing+=$'\npython3-munkres'; fi
fi
if [ -z "$missing" ] && [ -f "$stamp" ] && [ "$(fingerprint)" = "$(cat "$stamp")" ]; then
  [ "$quiet" = yes ] || say "nothing to do"
  exit 0
fi

mkdir -p "$deps" 2> /dev/null || die 1 "cannot write to $deps; set BARCHAN_DEPS to another folder."
if [ -n "$missing" ]; then
  # shellcheck disable=SC2086  # one word a package
  apt_install $missing
fi
[ "$has_apt" = yes ] || check_tools
provide_kokkos
fingerprint > "$stamp"
say "ready"
