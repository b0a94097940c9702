#!/usr/bin/env bash
# Realisations of a study: other packings, other turbulent flows, their mean and spread.
set -u
# shellcheck source=tests/support/studies.sh
. "$(dirname "${BASH_SOURCE[0]}")/../support/studies.sh"

part() {  # part END STEP SECTION...: a case of 20 x 20 x 20 mm with these sections
  printf '[time]\nend = %s\nfluid_step = %s\ngrain_step = 1e-5\n[domain]\nsize = [0.02, 0.02, 0.02]\n' "$1" "$2"
  printf '%s\n' "${@:3}"
}
water=$'[fluid]\ncells = [8, 8, 8]\nmean_velocity = 0.1'
grains=$'[grains]\nyoungs_modulus = 3e5\nsizes = [[2e-4, 800]]'
part 0.01 1e-3 "$grains" '[initial]' 'grains = { pour = { centre = [0.01, 0.01], radius = 0.0025 } }' > heap.toml
part 0.1 1e-3 "$water" '[initial]' 'fluid = "turbulent"' | grep -v grain_step > channel.toml
part 0.02 5e-4 "$water" "$grains" '[initial]' 'fluid = "channel.toml"' 'grains = "heap.toml"' \
  '[output]' 'dune_interval = 0.01' > case.toml
cat > study.toml << 'STUDY'
[study]
base = "case.toml"
[set]
grains.sliding_friction = 0.6
[vary]
grains.sliding_friction = [0.3, 0.6]
STUDY
sweep study.toml --out out --no-pictures > log 2>&1 || fail "the study without [ensemble] ended with $?: $(cat log)"
printf '[ensemble]\nrealisations = 3\n' >> study.toml

sweep study.toml --list > list || fail "--list ended with $?"
[ "$(cut -d' ' -f1 list | tr '\n' ' ')" = \
  "base sliding_friction-0.3 base-r2 sliding_friction-0.3-r2 base-r3 sliding_friction-0.3-r3 " ] || fail "$(cat list)"
sed 's/^realisations.*/&\ncases = ["base"]/' study.toml > some.toml
sweep some.toml --list > list || fail "--list of some cases ended with $?"
[ "$(cut -d' ' -f1 list | tr '\n' ' ')" = "base sliding_friction-0.3 base-r2 base-r3 " ] || fail "$(cat list)"
sed -i 's/"base"\]/"bsae"]/' some.toml
sweep some.toml --list > list 2>&1 && fail "a case that is not there has realisations"
grep -q 'unknown name "bsae" (did you mean "base"?)' list || fail "$(cat list)"

# --- part of a study: runs by name or pattern; the table lists the others as waiting
sweep study.toml --only base '*-r2' --list > list || fail "--only --list ended with $?"
[ "$(cut -d' ' -f1 list | tr '\n' ' ')" = "base base-r2 sliding_friction-0.3-r2 " ] || fail "--only: $(cat list)"
sweep study.toml --only base-r4 > list 2>&1 && fail "a run that is not there was asked for"
grep -q -- '--only: unknown name "base-r4" (did you mean "base-r[23]"?)' list || fail "$(cat list)"
sweep study.toml --only base-r2 --out out --no-pictures > log 2>&1 || fail "one run ended with $?: $(cat log)"
grep -q "1 of 1 cases done, .* runs an hour, 5 others not asked for" log || fail "$(cat log)"
[ -e out/base-r2/run.json ] && [ ! -e out/base-r3 ] || fail "--only ran the wrong ones"

sweep study.toml --out out --no-pictures > log 2>&1 || fail "the study ended with $?: $(cat log)"
[ "$(grep -c 'done before' log)" = 3 ] || fail "the study did not keep its runs: $(cat log)"

# --- each realisation has its own heap and its own flow, which has developed as long as the first
for which in 2 3; do
  for start in heap channel; do [ -e "out/$start-r$which/run.json" ] || fail "no $start-r$which"; done
  for start in heap channel; do
    cmp -s "out/$start/history.csv" "out/$start-r$which/history.csv" && fail "$start $which is $start 1"
  done
done
cat > check.py << 'PYTHON'
import csv, math, statistics, tomllib
ends = [tomllib.load(open(f"out/channel{r}/config.toml", "rb"))["time"]["end"] for r in ("", "-r2", "-r3")]
assert ends == 3 * ends[:1], ends
first = next(csv.DictReader(open("out/channel-r3/history.csv")))
assert float(first["t"]) < 0.05, first
rows = [row for row in csv.DictReader(open("out/study.csv")) if row["case"] == "base"]
assert [row["realisation"] for row in rows] == ["1", "2", "3"], rows
line = next(row for row in csv.DictReader(open("out/ensemble.csv")) if row["case"] == "base")
assert line["realisations"] == "3", line
for column in ("W", "L", "Cx"):
    values = [float(row[column]) for row in rows]
    mean, sd = statistics.fmean(values), statistics.stdev(values)
    assert sd > 0, column
    # Student's t for two degrees of freedom: 4.30265
    for name, wanted in (("mean", mean), ("sd", sd), ("ci95", 4.30265 * sd / math.sqrt(3))):
        assert abs(float(line[f"{column}_{name}"]) - wanted) < 1e-4 * abs(wanted), (column, name, line)
drawn = list(csv.DictReader(open("out/figures_data/morphology_sliding_friction.csv")))
assert "W_m_ci95" in drawn[0] and float(drawn[-1]["W_m_sd"]) > 0, drawn[-1]
PYTHON
"$python" -m barchan plot out fig7 > drawn 2>&1 && [ -s out/fig7.png ] || fail "fig7: $(cat drawn)"
"$python" check.py || fail "tables"

# --- the same command leaves what is done
sweep study.toml --out out --no-pictures > again 2>&1
[ "$(grep -c 'done before' again)" = 6 ] || fail "run again: $(cat again)"

# --- nothing random: there is only one realisation
sed -e '/^sizes/d' -e 's/grains = { pour.*/grains = "one.csv"/' heap.toml > fixed.toml
printf 'id,diameter,x,y,z\n1,2e-4,0.01,5e-3,0.01\n' > one.csv
"$program" check fixed.toml --set initial.realisation=2 > refused 2>&1 && fail "a case without random numbers was taken"
grep -q "initial.realisation.*would all be the same" refused || fail "$(cat refused)"
finish "ensemble: fine"
