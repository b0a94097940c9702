#!/usr/bin/env bash
# The case of docs/first-case.md and that of README.md as a user pastes them: they run to their end, and a dune is there.
set -u
# shellcheck source=tests/support/script.sh
. "$(dirname "${BASH_SOURCE[0]}")/../../support/script.sh"
ln -s "$root/configs" "$dir/configs"
cd "$dir" || exit 1

for page in docs/first-case.md README.md; do
  awk '/^```toml/ { inside = 1; next } /^```/ { if (inside) exit } inside' "$root/$page" > my-dune.toml
  "$BARCHAN_PROGRAM" run my-dune.toml --overwrite > out 2>&1 || fail "$page: $(tail -n 3 out)"
  "$python" - << 'END' || fail "$page: no dune of the size that the page shows"
import barchan
main = barchan.open("runs/my-dune").dunes.loc[0]
begin, end = main.iloc[0], main.iloc[-1]
assert end.n_grains > 1000, end.n_grains
assert 3e-3 < end.Cx - begin.Cx < 20e-3, end.Cx - begin.Cx
assert 0.3e-3 < end.H < begin.H, (begin.H, end.H)
END
done
finish "both cases run as pasted"
