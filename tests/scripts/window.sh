#!/usr/bin/env bash
# A case that begins as a part of another one: on one and two ranks, and across a restart.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../support/over_ranks.sh"

same() { "$support/compare_runs.py" "$@" || fail "$* differ"; }

cat > whole.toml <<'TOML'
time = { end = 0.003, fluid_step = 2.5e-4, grain_step = 1e-5 }
domain.size = [0.024, 0.012, 0.012]
[fluid]
cells = [24, 16, 12]
first_cell_height = 3e-4
mean_velocity = 0.24
[grains]
youngs_modulus = 3.125e5
rolling_friction = 0.1
sizes = [[0.15e-3, 100], [0.2e-3, 600], [0.25e-3, 100]]
[initial]
fluid = "turbulent"
grains = { pour = { centre = [0.011, 0.006], radius = 0.003 } }
TOML
cat > part.toml <<'TOML'
time = { end = 0.002, fluid_step = 2.5e-4, grain_step = 1e-5 }
domain.size = [0.008, 0.004, 0.006]
initial = { fluid = "whole.toml", grains = "whole.toml", window = [0.009, 0.004] }
[fluid]
cells = [16, 16, 12]
top = "no_slip"
top_velocity = 0.2
pressure_gradient = 10.0
[grains]
youngs_modulus = 3.125e5
rolling_friction = 0.1
boundary_x = "periodic"
[output]
grains_interval = 0.001
tracks_interval = 0.001
grain_forces = true
dune_interval = 0.001
history_interval = 0.001
[statistics]
start = 0.001
interval = 0.001
grain_forces = true
TOML

run 1 whole.toml
run 1 part.toml --out one
run 2 part.toml --out two
same grains one two
run 1 part.toml --out halves --set time.end=0.0015
run 1 part.toml --out halves --resume
same bits one halves

refused() {  # word of the message, case, arguments
  local word=$1
  shift
  if "$BARCHAN_PROGRAM" check "$@" > refused.txt 2>&1; then fail "not refused: $*"; fi
  grep -q -- "$word" refused.txt || { cat refused.txt; fail "no word of $word"; }
}
refused 'window = \[0.017' part.toml --set 'initial.window=[0.017, 0.004]'
sed 's/grains = "whole.toml"/grains = { pour = { radius = 0.002, centre = [0.004, 0.003] } }/' part.toml > poured.toml
refused 'where grains are poured' poured.toml --set 'grains.sizes=[[2e-4, 100]]'
