#!/usr/bin/env bash
# The launcher on a machine that is set up: usage, mistakes, exit codes, and that set-up is quick.
set -u
# shellcheck source=tests/support/script.sh
. "$(dirname "${BASH_SOURCE[0]}")/../support/script.sh"
cd "$dir" || exit 1

# expect STATUS TEXT COMMAND...: the launcher ends with STATUS and says TEXT somewhere
expect() {
  local status=0 wanted=$1 text=$2 said
  shift 2
  said="$("$root/barchan" "$@" 2>&1)" || status=$?
  [ "$status" -eq "$wanted" ] || fail "./barchan $*: exit code $status, not $wanted: $said"
  [[ $said == *"$text"* ]] || fail "./barchan $*: does not say '$text' but: $said"
}

expect 0 "configs/quickstart.toml"
expect 0 "configs/quickstart.toml" --help
expect 2 "there are run, check" rnu
expect 2 "unknown command 'frobnicate'" frobnicate
expect 2 "--ranks needs a number" run case.toml --ranks none
expect 2 "--threads needs a number" run case.toml --threads=0
expect 2 "run folder" plot
expect 2 "run folder" vtk
expect 2 "run folder or a case" watch
expect 2 "run needs a case" run --quiet
expect 2 "check needs a case" check
expect 2 "info needs" info
expect 0 "usage: ./barchan test" test --help
expect 0 "usage: ./barchan bench" bench --help
expect 2 "unknown option '--test'" setup --test

status=0
said="$(BARCHAN_PRESET=nonsense "$root/barchan" check case.toml 2>&1)" || status=$?
[ "$status" -eq 2 ] && [[ $said == "barchan: BARCHAN_PRESET: there is no preset 'nonsense'; there are release, "* ]] &&
  [ "$(wc -l <<< "$said")" -eq 1 ] || fail "a preset that is not there: exit code $status: $said"
for left in "$root"/build/nonsense*; do [ ! -e "$left" ] || fail "a preset that is not there leaves $left"; done

# What the program says of an option is what the launcher says.
"$root/barchan" run --help > said 2>&1 || fail "run --help: $(cat said)"
dry="$("$root/barchan" --help | sed -n 's/^ *--dry-run *//p')"
[ -n "$dry" ] && tr -s ' \n' ' ' < said | grep -qF -- "$dry" || fail "--dry-run: the launcher says '$dry', the program: $(cat said)"

# Bad input: code 2 and nothing written, also from a folder with a space and an accent in its name.
mkdir "dünes 1" && cd "dünes 1" || exit 1
printf '[time]\nendd = 1.0\n' > "bad case.toml"
expect 2 "end" run "bad case.toml"
expect 2 "end" check "bad case.toml"
expect 2 "no such case.toml" run "no such case.toml"
[ "$(ls)" = "bad case.toml" ] || fail "a bad case left something behind: $(ls)"

# Names that begin with a dash: of a case, and of a run folder, also when its pictures are drawn.
export OMP_NUM_THREADS=1
quick=(--quiet --set time.end=5e-4)
cp "$root/tests/support/small_dune.toml" -- -dash.toml
said="$("$root/barchan" run "${quick[@]}" --out -o2 -dash.toml 2>&1)" || fail "run -dash.toml --out -o2: $said"
[[ $said != *error* && $said != *"some pictures"* && -f -o2/run.json && -f -o2/report.html ]] ||
  fail "run -dash.toml --out -o2: no pictures: $said"
"$root/barchan" check -dash.toml > said 2>&1 || fail "check -dash.toml: $(cat said)"
"$root/barchan" run "${quick[@]}" --dry-run -- -dash.toml > said 2>&1 || fail "run -- -dash.toml: $(cat said)"

# With more than 512 threads Kokkos crashes: they are refused, and never taken by default.
status=0
KOKKOS_NUM_THREADS=513 "$BARCHAN_PROGRAM" check -- -dash.toml > said 2>&1 || status=$?
[ "$status" = 2 ] && grep -q "at most 512" said || fail "KOKKOS_NUM_THREADS=513: $status, $(cat said)"
OMP_NUM_THREADS=600 "$BARCHAN_PROGRAM" run "${quick[@]}" --dry-run -- -dash.toml > said 2>&1 ||
  fail "OMP_NUM_THREADS=600: $(cat said)"

# More threads than cores are told; as many are not.
for more in 1 0; do
  "$root/barchan" run "${quick[@]}" --dry-run --threads $(($(nproc --all) + more)) -- -dash.toml > said 2>&1
  [ "$(grep -c "threads that share a core" said)" = "$more" ] || fail "$more threads more than cores: $(cat said)"
done

printf '[study]\nbase = "-dash.toml"\n[set]\n"time.end" = 5e-4\n[vary]\n"fluid.mean_velocity" = [0.2]\n' > -study.toml
"$root/barchan" sweep -study.toml --out=-s > said 2>&1 || fail "sweep -study.toml --out=-s: $(cat said)"
! grep -i "error\|could not" said || fail "sweep -study.toml --out=-s: no pictures"

# Without an environment, and with nothing to read from or to write to.
export BARCHAN_PYTHON=/bin/false  # no more pictures
env -i OMP_NUM_THREADS=1 BARCHAN_PYTHON=/bin/false "$root/barchan" run "${quick[@]}" --out bare ./-dash.toml > said 2>&1 ||
  fail "without an environment: $(cat said)"
"$root/barchan" run "${quick[@]}" --out closed ./-dash.toml <&- >&- 2>&- || fail "closed streams: exit code $?"
grep -q '"status": "done"' bare/run.json closed/run.json || fail "without an environment or streams: not done"

# A name that no test has. What there is to build for them is not the question: cmake does nothing.
# And ctest looks into a folder with one test, or it would write over the results of the tests that run now.
mkdir bin one && ln -s /bin/true bin/cmake
echo 'add_test(Contact true)' > one/CTestTestfile.cmake
printf '#!/bin/sh\nshift 2\nexec "%s" --test-dir "%s" "$@"\n' "$(command -v ctest)" "$PWD/one" > bin/ctest
chmod +x bin/ctest
PATH="$PWD/bin:$PATH" "$root/barchan" test -R Contact > said 2>&1 || fail "a test that is there: $(cat said)"
said="$(PATH="$PWD/bin:$PATH" "$root/barchan" test -R Hertz-of-nobody 2>&1)" && fail "no such test: exit code 0"
[[ $said == *"No tests were found"* ]] || fail "no such test: $said"

# The checkout of another user: its program runs; what is not built there cannot be.
as_other=()
if [ "$(id -u)" -eq 0 ]; then as_other=(setpriv --reuid=65534 --regid=65534 --clear-groups); fi
mkdir -p other/build/release && cp -r "$root"/{barchan,scripts,python} other &&
  cp "$BARCHAN_PROGRAM"* other/build/release && chmod -R a-w,a+rX other && chmod 755 "$dir" || fail "no copy"
if "${as_other[@]}" other/build/release/barchan --version > said 2>&1; then
  mkdir -m 777 theirs
  (cd theirs && BARCHAN_PRESET=release "${as_other[@]}" ../other/barchan run "${quick[@]}" "$PWD/../-dash.toml") \
    > said 2>&1 || fail "the checkout of another user: $(cat said)"
  [ -f theirs/runs/-dash/run.json ] || fail "the checkout of another user: nothing run: $(cat said)"
  status=0
  BARCHAN_PRESET=release "${as_other[@]}" other/barchan build unit_tests > said 2>&1 || status=$?
  [ "$status" -eq 1 ] && [ "$(wc -l < said)" -eq 1 ] && grep -q "cannot write to .*/build" said ||
    fail "a build in the checkout of another user: exit code $status: $(cat said)"
fi
chmod -R u+w other

# A compiler that is not there: said at once, without a new Kokkos from elsewhere.
mkdir -p deps/kokkos
BARCHAN_DEPS="$PWD/deps" CXX=/nonexistent/c++ expect 1 "no C++ compiler that works: CXX='/nonexistent/c++'" setup
[ -d deps/kokkos ] || fail "a set-up without a compiler has removed the Kokkos there was"

expect 0 "nothing to do" setup --tests
TIMEFORMAT="%U %S"  # of the processor, which other tests do not lengthen
took="$({ time "$root/barchan" setup > /dev/null 2>&1; } 2>&1 | awk '{ print 1000 * ($1 + $2) }')"
[ "${took%.*}" -lt 1000 ] || fail "set-up with nothing to do took $took ms"

finish "launcher: fine; set-up with nothing to do took $took ms"
