#!/usr/bin/env bash
# The private Kokkos: a new one takes the place of an old one only when a program was built with it, and whatever goes
# wrong before leaves the old one as it was. Without network: apt and dpkg are stood in for.
set -u
# shellcheck source=tests/support/script.sh
. "$(dirname "${BASH_SOURCE[0]}")/../support/script.sh"
cp -r "$root"/{scripts,cmake} "$dir" && mkdir "$dir/bin" "$dir/deps" || exit 1
prefix="$dir/deps/kokkos"

stand_in() { cat > "$1" && chmod +x "$1"; }  # stand_in FILE: the program that it is
stand_in "$dir/bin/apt-get" <<'SH'
#!/bin/sh
case "$* " in
  *--print-uris*) echo "'http://mirror/debian/dists/bookworm/InRelease' x" ;;
  *\ download\ *) [ "$BROKEN" != network ] && for name in libkokkos-dev libkokkos5.2 libc6; do echo new > "$name.deb"; done ;;
esac
SH
stand_in "$dir/bin/apt-cache" <<'SH'
#!/bin/sh
echo "  Depends: libkokkos5.2"
SH
stand_in "$dir/bin/dpkg" <<'SH'
#!/bin/sh
[ "$1" = -x ] || { echo amd64; exit; }
[ "$BROKEN" != disk ] || { echo "No space left on device" >&2; exit 2; }
mkdir -p "$3/usr/lib/x/cmake/Kokkos"
cp "$2" "$3/usr/lib/x/"
case $2 in
  *libc6*) cp "$2" "$3/usr/lib/x/ld-linux-x86-64.so.2" ;;
  *) [ "$BROKEN" = layout ] || echo 'include("/usr/include")' > "$3/usr/lib/x/cmake/Kokkos/KokkosTargets.cmake" ;;
esac
SH
# What proves it: looks where CMake would, or is the true one.
mv "$dir/scripts/probe_kokkos.sh" "$dir/scripts/true_probe.sh"
stand_in "$dir/scripts/probe_kokkos.sh" <<'SH'
#!/bin/sh
case $BROKEN in
  compiler) CXX=/nonexistent/c++ exec "$(dirname "$0")/true_probe.sh" ;;
  signal) kill -TERM $PPID; sleep 0.1 ;;
  probe) echo "no such option" >&2; exit 1 ;;
esac
grep -q new "$BARCHAN_DEPS/kokkos/usr/lib/x/libkokkos-dev.deb"
SH

old() { rm -rf "$prefix" && mkdir -p "$prefix/runtime" && echo old > "$prefix/runtime/loader"; }
unpack() { PATH="$dir/bin:$PATH" BROKEN=$1 "$dir/scripts/kokkos_prefix.sh" "$prefix" > "$dir/said" 2>&1; }

for broken in network disk layout probe compiler signal; do
  old
  unpack $broken && fail "$broken: exit code 0"
  [ "$(cat "$prefix/runtime/loader" 2>&1)" = old ] || fail "$broken: the old Kokkos is not as it was: $(cat "$dir/said")"
  [ "$(ls "$dir/deps")" = kokkos ] || fail "$broken: left behind: $(ls "$dir/deps")"
  rm -rf "$prefix"
  unpack $broken && fail "$broken, without an old one: exit code 0"
  [ -z "$(ls "$dir/deps")" ] || fail "$broken: half of a Kokkos: $(ls "$dir/deps")"
done

for first in yes no; do
  [ $first = yes ] || old
  unpack nothing || fail "exit code $?: $(cat "$dir/said")"
  [ "$(cat "$prefix/usr/lib/x/libkokkos-dev.deb" "$prefix/runtime/usr/lib/x/libc6.deb" 2>&1 | sort -u)" = new ] &&
    [ ! -e "$prefix/runtime/loader" ] && [ "$(ls "$dir/deps")" = kokkos ] || fail "not the new Kokkos: $(find "$dir/deps")"
  ! grep -rq "kokkos\.new" "$prefix" || fail "it names the folder in which it was made"
  rm -rf "$prefix"
done

finish "kokkos_prefix: fine"
