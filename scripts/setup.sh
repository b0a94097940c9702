#!/usr/bin/env bash
# Brings the machine to where the project builds: Debian packages by apt, and Kokkos.
# scripts/setup.sh [--quiet]     --quiet: say nothing when there is nothing to do, and ask nothing
# Installs only what is missing, upgrades nothing, needs no network when all is there. Who is not root is asked before
# sudo is called, or told the command.
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
deps="${BARCHAN_DEPS:-$root/build/deps}"
stamp="$deps/setup.stamp"
quiet=no
[ "${1:-}" != --quiet ] || quiet=yes

say() { echo "barchan setup: $*"; }
die() { echo "barchan setup: $*" >&2; exit 1; }

packages=(cmake g++ ninja-build pkg-config git libopenmpi-dev openmpi-bin libhdf5-openmpi-dev
  libfftw3-dev libeigen3-dev libgtest-dev libbenchmark-dev libtomlplusplus-dev libcli11-dev
  libfmt-dev nlohmann-json3-dev zlib1g-dev
  python3 python3-h5py python3-numpy python3-matplotlib python3-scipy python3-pandas python3-xarray
  python3-pytest mypy python3-nbconvert python3-ipykernel python3-pip python3-venv python3-wheel python3-yaml
  nodejs node-jsdom)  # this line and the one before: for tests; node for that of the report page

missing_packages() {  # one name a line; a package that was removed but configured counts as missing
  local installed
  # shellcheck disable=SC2016  # ${Package} is dpkg-query's own syntax
  installed="$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' "${packages[@]}" 2> /dev/null |
    sed -n 's/^installed //p')" || true
  comm -23 <(printf '%s\n' "${packages[@]}" | sort) <(sort <<< "$installed")
}

apt_install() {
  local as_root=() answer=""
  if [ "$(id -u)" -ne 0 ]; then
    say "packages are missing. As root: apt-get install --no-install-recommends $*" >&2
    command -v sudo > /dev/null || die "nothing was installed"
    [ "$quiet" = no ] && [ -t 0 ] || die "nothing was installed; ./barchan setup does it with sudo, if you agree"
    read -r -p "barchan setup: run this with sudo now? [y/N] " answer
    [[ $answer == [yY]* ]] || die "nothing was installed"
    as_root=(sudo)
  fi
  as_root+=(env DEBIAN_FRONTEND=noninteractive)
  say "installing with apt: $*"
  mkdir -p "$deps"
  if [ "$apt_updated" = no ]; then
    "${as_root[@]}" apt-get -qq update > "$deps/apt.log" 2>&1 ||
      say "warning: apt-get update reported problems; trying with what it knows"
    apt_updated=yes
  fi
  "${as_root[@]}" apt-get -qq install --yes --no-install-recommends --no-upgrade "$@" >> "$deps/apt.log" 2>&1 ||
    { tail -n 5 "$deps/apt.log" >&2; die "apt-get install failed (full output in $deps/apt.log)."; }
}

check_tools() {  # a machine without apt, such as a cluster: modules or the user must provide them
  local tool
  for tool in cmake ninja mpicxx git; do
    command -v "$tool" > /dev/null || die "'$tool' was not found; install it or load its module."
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
    [ -z "${Kokkos_ROOT:-}${Kokkos_DIR:-}" ] ||
      die "the Kokkos in Kokkos_ROOT='${Kokkos_ROOT:-$Kokkos_DIR}' does not build a small program (see $deps/kokkos.log)."
    [ "$has_apt" = yes ] || die "Kokkos 4.6 or newer was not found; set Kokkos_ROOT."
    if system_kokkos_is_new_enough; then
      apt_install libkokkos-dev
    else
      say "unpacking Kokkos of Debian unstable into $deps/kokkos (nothing is installed)"
      "$root/scripts/kokkos_prefix.sh" "$deps/kokkos"
    fi
    found="$("$root/scripts/probe_kokkos.sh" 2> "$deps/kokkos.log")" ||
      die "Kokkos does not build a small program (see $deps/kokkos.log)."
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
  missing="$(missing_packages)"
fi
if [ -z "$missing" ] && [ -f "$stamp" ] && [ "$(fingerprint)" = "$(cat "$stamp")" ]; then
  [ "$quiet" = yes ] || say "nothing to do"
  exit 0
fi

mkdir -p "$deps" 2> /dev/null || die "cannot write to $deps; set BARCHAN_DEPS to another folder."
if [ -n "$missing" ]; then
  # shellcheck disable=SC2086  # one word a package
  apt_install $missing
fi
[ "$has_apt" = yes ] || check_tools
provide_kokkos
fingerprint > "$stamp"
say "ready"
