#!/usr/bin/env bash
# The direction of knowledge: kernels know only Kokkos and each other; src knows kernels; tests and perf
# know both, not each other; a folder of kernels/ or src/ knows itself and the folders before it in the lists
# below, and no other; no header includes itself in a circle. And no file or class grows past its limit of lines.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

# Each folder may include itself and those before it. ARCHITECTURE.md draws them.
kernel_rooms=(math bodies fluid grains coupling diagnostics)
src_rooms=(base toml parallel io bodies fluid grains coupling restart results case initial diagnostics run app)

max_lines=400          # anywhere
max_lines_of_program=300  # in src/ and kernels/
max_lines_of_class=500    # its header and its sources together
# Classes over that limit. The list may only become shorter.
large_classes=(Hdf5File ConfigReader)
failures=0
complain() {
  echo "$*"
  failures=$((failures + 1))
}

# Standard headers that make sense on a device, and what alternatives need to name themselves. No strings, streams,
# clocks, containers.
device_headers='algorithm|array|bit|cfloat|climits|cmath|concepts|cstddef|cstdint|cstring|limits|numbers|string_view'
device_headers+='|tuple|type_traits|utility|variant'

mapfile -d '' sources < <(find kernels src tests perf \( -name '*.hpp' -o -name '*.cpp' \) -print0 | sort -z)
includes="$(grep -HnoE '^[[:space:]]*#[[:space:]]*include[[:space:]]*[<"][^>"]+[>"]' "${sources[@]}" |
  sed -E 's/:[[:space:]]*#[[:space:]]*include[[:space:]]*/ /')"  # "file:line target" a line

# check_rooms PLACE TARGET TOP ROOMS...: an include from TOP/room/... to TOP/room/... points down or stays.
check_rooms() {
  local from="${1#"$3"/}" to="${2#"$3"/}" order
  from=${from%%/*} to=${to%%/*}
  order=" ${*:4} "
  if [[ $order != *" $from "* || $order != *" $to "* ]]; then
    complain "$1: $2: not in a folder that this script lists"
  elif [[ $from != "$to" && $order != *" $to "*"$from "* ]]; then
    complain "$1: $2 is in a folder further up; the order is: ${*:4}"
  fi
}

while read -r place target; do
  name="${target:1:-1}"
  case $target in
    \"kernels/* | \"src/* | \"tests/* | \"perf/*)
      [ -e "$name" ] || complain "$place: $target does not exist" ;;
    \"barchan_version.hpp\") ;;
    \"*) complain "$place: $target: write it from the root, as in \"src/$(basename "$name")\"" ;;
  esac
  case $place in
    kernels/*)
      [[ $target == \"kernels/* || $target == \<Kokkos_* || $name =~ ^($device_headers)$ ]] ||
        complain "$place: kernels may not include $target" ;;
    src/*) [[ $target != \"tests/* && $target != \"perf/* ]] || complain "$place: src may not include $target" ;;
    tests/*) [[ $target != \"perf/* ]] || complain "$place: tests may not include $target" ;;
    perf/*) [[ $target != \"tests/* ]] || complain "$place: perf may not include $target" ;;
  esac
  case "$place $name" in
    kernels/*\ kernels/*) check_rooms "$place" "$name" kernels "${kernel_rooms[@]}" ;;
    src/*\ src/*) check_rooms "$place" "$name" src "${src_rooms[@]}" ;;
  esac
done <<< "$includes"

circle="$(sed -n 's/^\(.*\):[0-9]* "\(.*\)"$/\1 \2/p' <<< "$includes" | { tsort 2>&1 > /dev/null || true; } |
  sed -n 's/^tsort: //p')"
[ -z "$circle" ] || complain "headers include each other in a circle:" "$circle"

while read -r lines file; do
  limit=$max_lines
  case $file in src/* | kernels/*) limit=$max_lines_of_program ;; esac
  [ "$lines" -le "$limit" ] || complain "$file: $lines lines, more than $limit; split it by noun"
done < <(find barchan src kernels tests perf python scripts packaging cmake -type f \( -name barchan -o \
  -name '*.hpp' -o -name '*.cpp' -o -name '*.py' -o -name '*.sh' -o -name '*.cmake' \) \
  -exec wc -l {} + 2> /dev/null | grep -v ' total$')

# Prints "lines class" for each class of src/: its header, and each source that defines members of it more than of
# any other class.
class_lines() {
  awk '
    FNR == 1 { files[++n] = FILENAME }
    { lines[FILENAME] = FNR }
    FILENAME ~ /hpp$/ && /^(class|struct) [A-Z][A-Za-z0-9]* .*\{/ { header[$2] = FILENAME }
    FILENAME ~ /cpp$/ && /^[A-Za-z]/ && match($0, /(^|[ *&])[A-Z][A-Za-z0-9]*::~?[A-Za-z_]+\(/) {
      name = substr($0, RSTART, RLENGTH)
      sub(/^[ *&]/, "", name)
      sub(/::.*/, "", name)
      members[FILENAME, name]++
    }
    END {
      for (i = 1; i <= n; ++i) {
        class = ""
        for (name in header) if (members[files[i], name] > members[files[i], class]) class = name
        if (class != "") sources[class] += lines[files[i]]
      }
      for (name in sources) print sources[name] + lines[header[name]], name
    }' "$@"
}

mapfile -d '' sources_of_classes < <(find src \( -name '*.hpp' -o -name '*.cpp' \) -print0 | sort -z)
classes="$(class_lines "${sources_of_classes[@]}")"
while read -r lines class; do
  [[ $lines -le $max_lines_of_class || " ${large_classes[*]} " == *" $class "* ]] ||
    complain "$class: $lines lines in all its files, more than $max_lines_of_class; give a part of it to another class"
done <<< "$classes"
for class in "${large_classes[@]}"; do
  lines="$(sed -n "s/ $class\$//p" <<< "$classes")"
  [ "${lines:-0}" -gt "$max_lines_of_class" ] ||
    complain "$class: ${lines:-0} lines, within the limit: take it off the list in this script"
done

[ "$failures" -eq 0 ] || { echo "$failures problem(s)"; exit 1; }
echo "layers: ${#sources[@]} files are in order"
