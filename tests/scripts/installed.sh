#!/usr/bin/env bash
# What cmake --install gives a user: the launcher runs cases by their names from any folder, builds nothing, and the man
# page and the completion know all commands and options.
set -u
# shellcheck source=tests/support/script.sh
. "$(dirname "${BASH_SOURCE[0]}")/../support/script.sh"
unset PYTHONPATH BARCHAN_PRESET
build="$(dirname "$BARCHAN_PROGRAM")"
grep -q '^BARCHAN_SANITIZE:STRING=.' "$build/CMakeCache.txt" && exit 77  # the same files, ten times slower
prefix="$dir/opt/a prefix"
cmake --install "$build" --prefix "$prefix" --component program > "$dir/log" 2>&1 ||
  { cat "$dir/log"; exit 1; }
[ ! -e "$prefix/include" ] && [ -f "$prefix/share/doc/barchan/LICENSE" ] || fail "what is installed: $(ls -R "$prefix")"
mkdir "$dir/bin" "$dir/elsewhere" && ln -s "$prefix/bin/barchan" "$dir/bin/barchan" || exit 1
export PATH="$dir/bin:$PATH" OMP_NUM_THREADS=1
cd "$dir/elsewhere" || exit 1

# expect STATUS TEXT ARGUMENT...: barchan ends with STATUS and says TEXT somewhere
expect() {
  local status=0 wanted=$1 text=$2 said
  shift 2
  said="$(barchan "$@" 2>&1)" || status=$?
  [ "$status" -eq "$wanted" ] || fail "barchan $*: exit code $status, not $wanted: $said"
  [[ $said == *"$text"* ]] || fail "barchan $*: does not say '$text' but: $said"
}

expect 0 "  barchan run configs/quickstart.toml" --help
expect 0 "barchan 0." --version
expect 0 "3,000 grains" check --resolved-only quickstart.toml
expect 0 "3,000 grains" check --resolved-only configs/quickstart.toml
expect 0 "heap-3k-soft.toml" sweep paper/sizes.toml --list
for word in setup build test bench benchmark docs; do expect 2 "of the source tree" "$word"; done
expect 2 "no_such.toml" run no_such.toml
[ -z "$(ls)" ] || fail "left behind: $(ls)"
cp "$prefix/share/barchan/configs/heap-3k.toml" quickstart.toml  # the user's own comes first
said="$(barchan check --resolved-only quickstart.toml)" && [[ $said != *"a barchan of"* ]] || fail "own case: $said"

# One of our cases, which first runs two others (into folders beside its own; shorter here), and one of the user's on
# two ranks.
rm quickstart.toml
sed -i 's/end = 0.2,/end = 0.04,/' "$prefix/share/barchan/configs/heap-3k.toml"
sed -i 's/end = 3,/end = 0.1,/' "$prefix/share/barchan/configs/channel-small.toml"
cp "$root/tests/support/small_dune.toml" mine.toml
barchan run quickstart.toml --quiet --set time.end=2e-3 > said 2>&1 || fail "run quickstart.toml: $(cat said)"
barchan run mine.toml --ranks 2 --quiet --set time.end=1e-3 > said 2>&1 || fail "run on two ranks: $(cat said)"
for run in quickstart mine; do
  grep -q '"status": "done"' "runs/$run/run.json" && [ -f "runs/$run/report.html" ] || fail "$run: $(ls runs/*)"
done
PYTHONPATH="$prefix/share/barchan/python" /usr/bin/python3 - > said 2>&1 << 'END' || fail "Python: $(cat said)"
import xarray
assert xarray.open_dataset("runs/quickstart/fields.h5", engine="barchan").sizes["time"] > 0
END
rm -f runs/quickstart/topviews.png
barchan plot runs/quickstart topviews > said 2>&1 && [ -f runs/quickstart/topviews.png ] || fail "plot: $(cat said)"
[ ! -e "$prefix/bin/build" ] || fail "the launcher builds"

# All commands, and all options that they name themselves, are in the man page and in the completion.
complete_line() {  # complete_line WORD...: what completion proposes for the last word
  bash -c '. "$1"; COMP_WORDS=("${@:2}"); COMP_CWORD=$(($# - 2)); _barchan; echo "${COMPREPLY[@]}"' \
    _ "$prefix/share/bash-completion/completions/barchan" barchan "$@"
}
page="$prefix/share/man/man1/barchan.1"
commands="$(barchan --help | sed -n 's/^  \([a-z][a-z]*\)  *.*/\1/p' | grep -v barchan)"
[ "$(wc -w <<< "$commands")" -ge 6 ] || fail "commands of the usage: $commands"
[ "$(complete_line ru)" = run ] || fail "completion of ru: $(complete_line ru)"
[ "$(complete_line run quick)" = quickstart.toml ] || fail "cases: $(complete_line run quick)"
n_options=0
for command in $commands; do
  grep -q "^\.B $command\>" "$page" || fail "the man page lacks $command"
  [[ " $(complete_line "") " == *" $command "* ]] || fail "the completion lacks $command"
  for option in $(barchan "$command" --help | grep -o -- '--[a-z][a-z-]*' | sort -u); do
    n_options=$((n_options + 1))
    [[ " $(complete_line "$command" --) " == *" $option "* ]] || fail "the completion of $command lacks $option"
    [ "$option" = --help ] || grep -q -- "${option//-/\\\\-}" "$page" || fail "the man page lacks $command $option"
  done
done
[ "$n_options" -ge 20 ] || fail "only $n_options options are found"
if command -v man > said; then
  LC_ALL=C.UTF-8 MANROFFSEQ='' MANWIDTH=80 man --warnings -l "$page" 2>&1 > /dev/null | grep . && fail "warnings of man"
fi

finish "installed: two runs; ${commands//$'\n'/, } and $n_options options are in the man page and the completion"
