#!/usr/bin/env bash
# Grains in a flow over several ranks: the same results, and restarts on the same and on another number.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../support/over_ranks.sh"

same() { "$support/compare_runs.py" "$@" || fail "$* differ"; }

cat > heap.toml <<'TOML'
[case]
title = "Small heap in a channel"
[time]
end = 0.006
fluid_step = 2.5e-4
grain_step = 1e-5
[domain]
size = [0.024, 0.012, 0.012]
[fluid]
cells = [24, 16, 12]
first_cell_height = 3e-4
mean_velocity = 0.24
[grains]
density = 2500
youngs_modulus = 3.125e5
poisson_ratio = 0.45
restitution = 0.1
sliding_friction = 0.6
rolling_friction = 0.1
sizes = [[0.15e-3, 100], [0.2e-3, 600], [0.25e-3, 100]]
[initial]
fluid = "turbulent"
grains = { pour = { centre = [0.011, 0.006], radius = 0.003 } }
[output]
grains_interval = 0.003
grain_forces = true
tracks_interval = 0.003
dune_interval = 0.001
history_interval = 0.001
[statistics]
start = 0.001
interval = 0.001
grain_forces = true
TOML

run 1 heap.toml --out one
for ranks in 2 6; do
  run "$ranks" heap.toml --out "on-$ranks"
  same grains one "on-$ranks"
done

# On another number of ranks each time, and on the same one, there to the last bit.
run 2 heap.toml --out parts --set time.end=0.002
run 3 heap.toml --out parts --set time.end=0.004 --restart parts/restart_0000000008.h5
run 1 heap.toml --out parts --restart parts/restart_0000000016.h5
same grains one parts
run 3 heap.toml --out whole
run 3 heap.toml --out halves --set time.end=0.003
run 3 heap.toml --out halves --restart halves/restart_0000000012.h5
same bits whole halves

# Two kinds of grains, which take theirs along from rank to rank and through restarts.
cat heap.toml - > kinds.toml <<'TOML'
[[grains.kind]]
name = "glass"
[[grains.kind]]
name = "zirconium"
density = 4100
youngs_modulus = 6e5
sizes = [[0.2e-3, 400]]
[[grains.pair]]
kinds = ["glass", "zirconium"]
sliding_friction = 0.3
TOML
run 1 kinds.toml --out kinds
run 3 kinds.toml --out kinds-on-3
same grains kinds kinds-on-3
for ranks in 1 3; do
  run "$ranks" kinds.toml --out "kinds-halves-$ranks" --set time.end=0.003
  run "$ranks" kinds.toml --out "kinds-halves-$ranks" --restart "kinds-halves-$ranks/restart_0000000012.h5"
done
same bits kinds kinds-halves-1
same bits kinds-on-3 kinds-halves-3

# Of two heaps every grain keeps its own, on ranks, after a restart and in the case that starts from it.
sed '/pour = /d' heap.toml > heaps.toml
cat >> heaps.toml <<'TOML'
[[initial.heap]]
name = "upstream"
centre = [0.005, 0.006]
radius = 0.003
[[initial.heap]]
name = "downstream"
centre = [0.015, 0.006]
radius = 0.003
sizes = [[0.2e-3, 700]]
TOML
run 2 heaps.toml --out heaps --set time.end=0.003
run 3 heaps.toml --out heaps --restart heaps/restart_0000000012.h5
run 1 heaps.toml --out heaps-one
same grains heaps-one heaps
[ -s heaps/heaps.csv ] || fail "no table of heaps"
run 4 heap.toml --out after --set time.end=0.002 --set 'initial.grains="heaps/restart_0000000024.h5"'
run 2 heap.toml --out later --set time.end=0.002 --set 'initial.grains="after/grains.h5"'
/usr/bin/python3 - <<'PYTHON' || fail "grains have lost their heaps"
import h5py
for run, least in (("heaps", 3), ("after", 1), ("later", 1)):
    with h5py.File(f"{run}/grains.h5") as file:
        frames = [name for name in file if name.startswith("frame_")]
        assert len(frames) >= least, frames
        for name in frames:
            number, heap = file[name]["id"][:], file[name]["heap"]
            assert len(number) == 1500 and ((number > 800) == heap[:]).all(), (run, name)
            assert heap.attrs["names"] == "upstream\ndownstream\n", heap.attrs["names"]
PYTHON

# A post among the grains: what pushes it is the same on ranks and after a restart.
cat heap.toml - > post.toml <<'TOML'
[[body]]
name = "post"
shape = "cylinder"
centre = [0.011, 0.006]
radius = 0.0015
height = 0.004
TOML
run 1 post.toml --out post
run 3 post.toml --out post-parts --set time.end=0.003
run 2 post.toml --out post-parts --restart post-parts/restart_0000000012.h5
same grains post post-parts
[ -s post/bodies.csv ] || fail "no table of bodies"

grep -q '"grain_imbalance"' on-6/run.json || fail "run.json does not say how the work is shared"

# A window that follows its dune, with grains that leave and come in.
fed=(--set 'grains.boundary_x="follow"' --set fluid.mean_velocity=0.5 --set grains.feed.rate=8000 --set grains.feed.x=3e-3)
run 1 heap.toml --out fed-one "${fed[@]}"
run 3 heap.toml --out fed-parts "${fed[@]}" --set time.end=0.003
run 2 heap.toml --out fed-parts "${fed[@]}" --restart fed-parts/restart_0000000012.h5
same grains fed-one fed-parts
grep -q '"grains_fed": [1-9]' fed-parts/run.json || fail "no grain has come in"

# Grains that are held in place have no contacts, and the files no histories.
frozen=(--out frozen --set grains.frozen=true --set 'initial.grains="one/restart_0000000024.h5"'
  --set statistics.start=0)
run 2 heap.toml "${frozen[@]}" --set time.end=0.001
run 3 heap.toml "${frozen[@]}" --set time.end=0.002 --restart frozen/restart_0000000004.h5

# Fewer grains than ranks, and then none: the last one leaves through the outlet.
printf 'id,diameter,x,y,z\n7,2e-4,0.0239,1e-4,0.006\n' > few.csv
run 4 heap.toml --out few --set 'initial.grains="few.csv"' --set time.end=0.05 --set fluid.mean_velocity=0.3
grep -q '"grains_left": 1' few/run.json || fail "the last grain has not left"

# A state that goes wrong is told once, and written whole, whichever ranks have seen it.
status=0
run 3 heap.toml --out wrong --set grains.youngs_modulus=2e3 --set 'grains.gravity=[0, -300, 0]' > out 2>&1 || status=$?
[ "$status" -eq 1 ] && [ "$(grep -c "error: grain [0-9]* at .*at most 10 %.*failure_grains.xdmf" out)" -eq 1 ] ||
  { cat out; fail "grains that overlap too much: exit code $status"; }
/usr/bin/python3 -c 'import h5py; assert len(h5py.File("wrong/failure_grains.h5")["frame_000000/id"]) == 800' ||
  fail "the state that went wrong is not there whole"

# Cells that grains reach across.
status=0
run 2 heap.toml --out coarse --set 'fluid.cells=[24, 16, 120]' --set coupling.smoothing_length=3e-4 > out 2>&1 || status=$?
[ "$status" -eq 2 ] && [ "$(grep -c "smaller than the radius" out)" -eq 1 ] || { cat out; fail "cells below a radius: $status"; }
echo "ok"
