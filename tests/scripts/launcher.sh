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
expect 2 "did you mean 'run'" rnu
expect 2 "unknown command 'frobnicate'" frobnicate
expect 2 "--ranks needs a number" run case.toml --ranks none
expect 2 "--threads needs a number" run case.toml --threads=0
expect 2 "run folder" plot

# Bad input: code 2 and nothing written, also from a folder with a space and an accent in its name.
mkdir "dünes 1" && cd "dünes 1" || exit 1
printf '[time]\nendd = 1.0\n' > "bad case.toml"
expect 2 "end" run "bad case.toml"
expect 2 "end" check "bad case.toml"
expect 2 "no such case.toml" run "no such case.toml"
[ "$(ls)" = "bad case.toml" ] || fail "a bad case left something behind: $(ls)"

expect 0 "nothing to do" setup
start="$(date +%s%N)"
"$root/barchan" setup > /dev/null
elapsed_ms=$((($(date +%s%N) - start) / 1000000))
[ "$elapsed_ms" -lt 1000 ] || fail "set-up with nothing to do took $elapsed_ms ms"

finish "launcher: fine; set-up with nothing to do took $elapsed_ms ms"
