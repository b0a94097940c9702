#!/usr/bin/env bash
# The figures of the validation pages from the results saved in docs/validation; and what bad input says.
set -u
# shellcheck source=tests/support/plotting.sh
. "$(dirname "${BASH_SOURCE[0]}")/../../support/plotting.sh"
figures=(channel channel_resolved taylor_green contacts grains_and_water convergence beside_cfdem)

# Every saved result says where it comes from.
for table in "$root"/docs/validation/*.csv; do
  if [[ $table == */channel_summary.csv ]]; then continue; fi
  for note in command commit machine date; do
    grep -q "^# $note: ." "$table" || fail "$(basename "$table") does not say its $note"
  done
  [ "$(grep -vc '^#' "$table")" -gt 2 ] || fail "$(basename "$table") has no rows"
done

plot 0 validation --out "$dir/all"
quiet
for figure in "${figures[@]}"; do
  is_drawing "$dir/all/$figure"
  same_drawing "$dir/all/$figure.svg" "$root/docs/validation/$figure.svg" ||
    fail "docs/validation/$figure.svg is not what the saved results give"
done
# Figures of merit: every quantity has as many cells as the heading.
awk -F, '!/^#/ { if (!columns) columns = NF; else rows += NF == columns; all += NF != columns }
         END { exit !(rows >= 10 && !all && columns >= 5) }' "$dir/all/channel_summary.csv" ||
  fail "channel_summary.csv is not a whole table"

mkdir "$dir/empty"
refused "contacts needs $dir/empty/chung_ooi_1_2.csv" validation --from "$dir/empty" --out "$dir/none" contacts
printf 'test,overlap,force\n1,0,none\n' > "$dir/empty/chung_ooi_1_2.csv"
plot 1 validation --from "$dir/empty" --out "$dir/none" contacts
says "cannot draw contacts"
refused 'no mesh "mesh9"; meshes: mesh1' validation --keep mesh9="$dir/empty"
refused "needs statistics.csv and config.toml" validation --keep mesh1="$dir/empty" --from "$dir/empty"
status=0
"$root/barchan" plot validation zzz 2> "$dir/err" || status=$?
[ "$status" = 2 ] || fail "the launcher ended with $status, not 2"
says 'no figure "zzz"; figures: channel'

finish "${#figures[@]} figures from saved results"
