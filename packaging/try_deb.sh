#!/usr/bin/env bash
# Builds the Debian packages of the last commit, checks them with lintian, installs them in a new Debian 12 and runs the
# quickstart there as an ordinary user: packaging/try_deb.sh KOKKOS_SOURCES FOLDER [CMAKE OPTIONS OF KOKKOS]
# As root. Needs debootstrap, lintian and debian/control's build dependencies. What is in FOLDER from an earlier call
# (kokkos, barchan-*, system) is used again. The variable MIRROR is debootstrap's argument.
set -euo pipefail
[ $# -ge 2 ] || { echo "usage: packaging/try_deb.sh KOKKOS_SOURCES FOLDER [CMAKE OPTIONS OF KOKKOS]" >&2; exit 2; }
here="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
version="$(dpkg-parsechangelog --file "$here/debian/changelog" --show-field Version)"
mkdir -p "$2"
folder="$(cd "$2" && pwd)"
say() { echo "try_deb: $*"; }

[ -d "$folder/kokkos" ] ||
  "$here/packaging/kokkos_static.sh" "$1" "$folder/kokkos" "${@:3}" > "$folder/kokkos.log" 2>&1 ||
  { tail -n 20 "$folder/kokkos.log"; exit 1; }
source="$folder/barchan-${version%-*}"
[ -d "$source" ] || git clone --quiet --no-checkout "$here" "$source"
git -C "$source" fetch --quiet "$here" HEAD
git -C "$source" checkout --quiet --force --detach FETCH_HEAD
(cd "$source" && dh_clean)  # what is compiled stays
say "building the packages (the longest part; $folder/build.log)"
(cd "$source" && Kokkos_ROOT="$folder/kokkos" dpkg-buildpackage -us -uc -b -nc -Ppkg.barchan.static-kokkos) \
  > "$folder/build.log" 2>&1 || { tail -n 20 "$folder/build.log"; exit 1; }
say "lintian"
lintian --fail-on error,warning --allow-root "$folder"/barchan_"$version"_*.changes

system="$folder/system"
[ -d "$system" ] || debootstrap --variant=minbase bookworm "$system" ${MIRROR:+"$MIRROR"} > "$folder/debootstrap.log"
inside() {
  # shellcheck disable=SC2016  # expanded by the inner sh
  unshare --mount --pid --fork --mount-proc="$system/proc" \
    sh -c 'mount --bind /sys "$0/sys" && exec chroot "$0" "$@"' "$system" "$@"
}
rm -rf "$system/packages"
mkdir "$system/packages"
cp "$folder"/*barchan_"$version"_*.deb "$system/packages"
say "installing them in a new Debian 12"
inside sh -c 'export DEBIAN_FRONTEND=noninteractive; apt-get -qq update &&
  apt-get -qq --yes --reinstall install /packages/*.deb' > "$folder/install.log" 2>&1 ||
  { tail -n 20 "$folder/install.log"; exit 1; }
inside id tester > /dev/null 2>&1 || inside useradd --create-home --shell /bin/bash tester
say "barchan run quickstart.toml, as an ordinary user"
inside su - tester -c 'rm -rf runs && time barchan run quickstart.toml --quiet && ls -s runs/quickstart &&
  grep -q "\"status\": \"done\"" runs/quickstart/run.json && [ -s runs/quickstart/topviews.png ] &&
  python3 -c "import barchan; print(barchan.open(\"runs/quickstart\").dunes.tail(1).T)" &&
  zgrep -q "NAME" /usr/share/man/man1/barchan.1.gz'
say "done"
