#!/usr/bin/env bash
# The performance suite on tiny cases: that all of it runs and what it counts, not how fast it is. Then
# compare.py on its records, and against peers that only pretend.
set -u
# shellcheck source=tests/support/script.sh
. "$(dirname "${BASH_SOURCE[0]}")/../../support/script.sh"
bench="$(dirname "$BARCHAN_PROGRAM")/barchan_bench"
[ -x "$bench" ] || { echo "no $bench"; exit 77; }
export OMP_NUM_THREADS=2 OMP_PROC_BIND=false

suite() {  # suite RECORDS [OPTION...]
  "$bench" --tiny --benchmark_min_time=0.01 "--records=$1" "${@:2}" > "$dir/out" 2>&1 ||
    fail "barchan_bench ${*:2} ended with $?: $(tail -n 5 "$dir/out")"
}

compare() {  # compare EXPECTED_STATUS ARGUMENT...
  local status=0
  "$python" "$root/perf/compare.py" "${@:2}" > "$dir/table" 2> "$dir/err" || status=$?
  [ "$status" = "$1" ] || fail "compare.py ${*:2} ended with $status, not $1: $(cat "$dir/err")"
}

says() { grep -qE -- "$2" "$1" || fail "expected '$2', got '$(cat "$1")'"; }

# Dunes that move, in place of those of 10,000 and 100,000 grains.
for dune in dune-10k dune-100k; do
  "$BARCHAN_PROGRAM" run "$root/tests/support/small_dune.toml" --quiet --out "$dir/runs/$dune" > "$dir/out" 2>&1 ||
    fail "the dune of a benchmark: $(tail -n 5 "$dir/out")"
done

suite "$dir/a.jsonl" --benchmark_repetitions=2 "--runs=$dir/runs"
"$bench" --benchmark_list_tests "--runs=$dir/runs" 2> /dev/null | sed 's|/[a-z]*_time$||' > "$dir/names"
"$python" "$root/tests/support/check_bench_records.py" "$dir/a.jsonl" "$dir/names" || failures=$((failures + 1))

# Two records of one program.
suite "$dir/b.jsonl" --benchmark_filter=dem/heap_10k
compare 0 "$dir/a.jsonl" "$dir/b.jsonl"
says "$dir/table" '^dem/heap_10k  +[0-9].* \.\. '
says "$dir/table" '^only in A: les/mesh1$'
sed 's/"threads":2/"threads":3/' "$dir/b.jsonl" > "$dir/c.jsonl"
compare 2 "$dir/a.jsonl" "$dir/c.jsonl"
says "$dir/err" 'threads differs: 2 and 3'
compare 0 --across "$dir/a.jsonl" "$dir/c.jsonl"
compare 2 "$dir/a.jsonl@0000nobody" "$dir/b.jsonl"
says "$dir/err" 'no records in'
compare 2 "$dir/a.jsonl" "$dir/missing.jsonl"
says "$dir/err" 'cannot read'

# The table that the prediction for many ranks reads.
"$python" "$root/perf/keep.py" "$dir/a.jsonl" "$dir/measured.csv" || fail "keep.py ended with $?"
says "$dir/measured.csv" '^coupled/heap_10k,2,[0-9.]+,[0-9.]+,[0-9.]+,[0-9.]+,[0-9.]+$'
says "$dir/measured.csv" '^kernel/list_build,2,[0-9.]+,'

# Peers: their rows as they print them, once when measured and again at the end.
mkdir "$dir/peers"
cat > "$dir/peers/run_liggghts.sh" <<'PEER'
row="ROW liggghts heap100k roll=off rebuild=0 ranks=$RANKS       ms/step min 12.80 median 13.00 max 13.60 | 7.71 M grain-steps/s"
echo "# scratch: $SCRATCH"; echo "$row"; echo "== figures"; echo "$row"
PEER
compare 0 --peers "$dir/peers" --scripts run_liggghts.sh --rounds 2 --bench "$bench" --out "$dir/p.jsonl" \
  --bench-option=--tiny --bench-option=--benchmark_min_time=0.01
says "$dir/table" '^liggghts heap100k roll=off rebuild=0 ranks=2 +13 +dem/heap_100k +[0-9]'
says "$dir/p.jsonl" '"peer_seconds": \[0.013, 0.013\]'
echo 'echo "no such thing"; exit 3' > "$dir/peers/run_liggghts.sh"
compare 2 --peers "$dir/peers" --scripts run_liggghts.sh --rounds 1 --bench "$bench" \
  --bench-option=--tiny --bench-option=--benchmark_min_time=0.01
says "$dir/err" 'ended with 3 and 0 rows'

finish "bench: $(wc -l < "$dir/a.jsonl") records in order"
