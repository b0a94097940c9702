#!/usr/bin/env bash
# What TAB proposes behind ./barchan, with the completion of the repository, in bash itself and in a terminal. That it
# knows every command and every option: tests/scripts/installed.sh.
set -u
# shellcheck source=tests/support/script.sh
. "$(dirname "${BASH_SOURCE[0]}")/../support/script.sh"
cd "$dir" || exit 1
ln -s "$root/barchan" barchan
mkdir -p runs/field/reversal runs/dune/vtkhdf mine && touch runs/field/reversal/run.json runs/dune/study.json
touch mine/case.toml mine/notes.txt "mine/\$(touch hacked).toml" field
# shellcheck source=scripts/completion.bash
. "$root/scripts/completion.bash"

# expect PROPOSALS WORD...: what is proposed for the last word
expect() {
  local wanted=$1 said
  COMP_WORDS=(./barchan "${@:2}")
  COMP_CWORD=$(($# - 1))
  _barchan
  said="$(printf '%s\n' ${COMPREPLY+"${COMPREPLY[@]}"} | LC_ALL=C sort | paste -sd ' ')"
  [ "$said" = "$wanted" ] || fail "'${*:2}': '$said', not '$wanted'"
}

expect "setup sweep" s
expect "" nonsense x
expect "--restart --resume" run case.toml --res
expect "quickstart.toml" run quick
expect "field/all.toml field/corners-heap.toml field/corners.toml field/encounters.toml field/sizes.toml" sweep field/
expect "small/friction-3k.toml" sweep small/fr
expect "" run field/sizes
expect "mine/\$(touch hacked).toml mine/case.toml" run mine/
expect "mine" run min
expect "grains.sliding_friction=" run case.toml --set grains.sl
expect "" run case.toml --set grains.sliding_friction =
expect "" run case.toml --set grains.sliding_friction = 0
expect "" run case.toml --set grains.kind.n
expect "grains.kind" keys grains.k
expect "grains.wall.restitution" keys grains.wall.re
expect "runs/dune runs/field runs/field/reversal" plot runs/
expect "runs/dune/vtkhdf" list runs/dune/
expect "mine/\$(touch hacked).toml mine/case.toml mine/notes.txt" info mine/
expect "morphodynamics morphology" plot runs/dune mor
expect "fig2" plot runs/dune --pdf morphology fig2
expect "runs" run case.toml --out = run
expect "" run case.toml --threads ""
expect "--help --schema" keys --
[ ! -e hacked ] || fail "a name of a file was obeyed"

finish "completion: fine"
