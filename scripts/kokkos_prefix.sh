#!/usr/bin/env bash
# Unpacks Kokkos from Debian unstable into a private prefix: scripts/kokkos_prefix.sh PREFIX
#
# Debian 12 has no usable Kokkos. The one in unstable needs a newer C and C++ run time than
# Debian 12's; installing that would upgrade libc6 for the whole system. So Kokkos and the run time it
# needs are unpacked side by side into PREFIX, nothing is installed, and every program that links
# Kokkos is told (by link options of the Kokkos target) to start with PREFIX's dynamic linker.
set -euo pipefail

die() { echo "barchan setup: $*" >&2; exit 1; }

[ $# -eq 1 ] || die "usage: scripts/kokkos_prefix.sh PREFIX"
case $1 in
  *[,:\$]*) die "the path '$1' holds a comma, colon or dollar sign, which a linker option cannot; set BARCHAN_DEPS to another folder." ;;
esac
mkdir -p "$(dirname "$1")"
prefix="$(cd "$(dirname "$1")" && pwd)/$(basename "$1")"
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
# The new prefix is made and proven beside the old one, of which programs that are built need the run time: that goes
# only when this is whole. Nothing in it names the place where it lies.
scratch="$(mktemp -d)"
beside=""
cleanup() {
  if [ -n "$beside" ] && [ -e "$beside/old" ] && [ ! -e "$prefix" ]; then mv -T "$beside/old" "$prefix"; fi
  rm -rf "$scratch" ${beside:+"$beside"}
}
trap cleanup EXIT
trap 'exit 130' INT TERM HUP
beside="$(mktemp -d "$prefix.new.XXXXXX")" || die "cannot write to $(dirname "$prefix")."
made="$beside/kokkos"

# The mirrors that this machine's own apt is set to, those with the suite of this system first (third
# parties and security updates have suites of other names); works before the first apt-get update too.
list_mirrors() {
  local codename
  # shellcheck source=/dev/null
  codename="$(. /etc/os-release && echo "${VERSION_CODENAME:-}")"
  apt-get update --print-uris |
    sed -nE "s#^'(.*)/dists/(.+)/InRelease'.*#\2 \1#p" |
    awk -v suite="$codename" '{ print ($1 == suite ? 0 : 1), $2 }' | sort -s -k 1,1 |
    awk '!seen[$2]++ { print $2 }'
}

private_apt() {  # apt-get with sources, lists and caches of its own: the user's state stays untouched
  local options=(-qq -o "Dir::Etc::sourcelist=$scratch/sources.list" -o Dir::Etc::sourceparts=/dev/null
    -o "Dir::State::Lists=$scratch/lists" -o "Dir::Cache=$scratch/cache" -o Dir::Cache::pkgcache=
    -o Dir::Cache::srcpkgcache= -o Acquire::Languages=none -o Acquire::Retries=2)
  [ "$(id -u)" -ne 0 ] || options+=(-o APT::Sandbox::User=root)  # scratch is not readable for _apt
  apt-get "${options[@]}" "$@"
}

fetch_packages() {  # fills $scratch/packages from SUITE on MIRROR
  local mirror=$1 suite=$2 arch keyring=/usr/share/keyrings/debian-archive-keyring.gpg options runtime
  arch="$(dpkg --print-architecture)"
  options="arch=$arch"
  [ ! -e "$keyring" ] || options+=" signed-by=$keyring"
  rm -rf "$scratch/lists" "$scratch/packages"
  mkdir -p "$scratch/lists/partial" "$scratch/cache/archives/partial" "$scratch/packages"
  echo "deb [$options] $mirror $suite main" > "$scratch/sources.list"
  private_apt update || return 1
  # The number in the run-time library's name moves with the version: ask what the headers depend on.
  runtime="$(apt_depends_kokkos)" || return 1
  (cd "$scratch/packages" && private_apt download libkokkos-dev "$runtime" libc6 libstdc++6 libgcc-s1 libgomp1)
}

apt_depends_kokkos() {
  apt-cache -o "Dir::Etc::sourcelist=$scratch/sources.list" -o Dir::Etc::sourceparts=/dev/null \
    -o "Dir::State::Lists=$scratch/lists" -o Dir::Cache::pkgcache= -o Dir::Cache::srcpkgcache= \
    depends --no-recommends --no-suggests libkokkos-dev |
    awk '$1 == "Depends:" && $2 ~ /^libkokkos[0-9]/ { print $2; found = 1; exit } END { exit !found }'
}

repair() {
  local targets libdir name loader
  targets="$(find "$made/usr/lib" -name KokkosTargets.cmake)"
  [ -n "$targets" ] || { echo "no KokkosTargets.cmake in the packages" >&2; return 1; }
  libdir="$(dirname "$(dirname "$(dirname "$targets")")")"
  # 1. The include path is absolute (made for an installation at /).
  # shellcheck disable=SC2016  # ${_IMPORT_PREFIX} is CMake's
  sed -i 's#\([";]\)/usr/include#\1${_IMPORT_PREFIX}/include#g' "$targets"
  # 2. Two archives it names hold no objects and are not shipped.
  for name in libkokkosalgorithms.a libkokkossimd.a; do
    [ -e "$libdir/$name" ] || ar rc "$libdir/$name"
  done
  # 3. Programs that link Kokkos run with the run time in this prefix.
  loader="$(cd "$made" && find runtime/usr/lib -maxdepth 2 -name 'ld-linux*.so.*' | head -n 1)"
  [ -n "$loader" ] || { echo "no dynamic linker in the packages" >&2; return 1; }
  cat >> "$targets" <<REPAIR

# Added by scripts/kokkos_prefix.sh: this Kokkos needs the newer C and C++ run time beside it.
get_filename_component(_barchan_prefix "\${CMAKE_CURRENT_LIST_DIR}/../../../../.." ABSOLUTE)
set_property(TARGET Kokkos::kokkoscore APPEND PROPERTY INTERFACE_LINK_OPTIONS
  "-Wl,--dynamic-linker=\${_barchan_prefix}/$loader"
  "-Wl,-rpath,\${_barchan_prefix}/$(dirname "$loader")" "-Wl,--allow-shlib-undefined"
  "-Wl,--disable-new-dtags")  # rpath, not runpath: also for libm and libgomp of other libraries
unset(_barchan_prefix)
REPAIR
}

obtain() {
  local mirror suite
  echo "apt names no mirror" > "$scratch/log"
  for suite in sid testing; do
    while read -r mirror; do
      if fetch_packages "$mirror" "$suite" > "$scratch/log" 2>&1; then return 0; fi
    done < <(list_mirrors)
  done
  tail -n 5 "$scratch/log" >&2
  return 1
}

obtain || die "could not get Kokkos (libkokkos-dev of Debian unstable) from this machine's apt mirror; is the network up? Or install Kokkos 4.6 or newer and set Kokkos_ROOT."
mkdir -p "$made"
for package in "$scratch"/packages/*.deb; do
  case "$(basename "$package")" in
    libkokkos*) dpkg -x "$package" "$made" ;;
    *) dpkg -x "$package" "$made/runtime" ;;  # apart, so that only programs are sent there, not the linker
  esac
done
repair || die "the Kokkos packages of Debian unstable are not laid out as expected."
env -u Kokkos_ROOT -u Kokkos_DIR BARCHAN_DEPS="$beside" "$here/probe_kokkos.sh" > "$scratch/log" 2>&1 ||
  { tail -n 15 "$scratch/log" >&2; die "the unpacked Kokkos does not build a small program."; }
if [ -e "$prefix" ]; then mv -T "$prefix" "$beside/old"; fi
mv -T "$made" "$prefix"
