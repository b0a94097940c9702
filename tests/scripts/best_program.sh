#!/usr/bin/env bash
# The program that starts the best build for the processor: which one it takes, and what it says when there is none.
set -euo pipefail
fail() { echo "best_program: $*" >&2; exit 1; }

[ "$(uname -m)" = x86_64 ] || exit 77
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
"${CXX:-g++}" -std=c++20 -O0 -Wall -Wextra -Werror src/app/best_program.cpp -o "$folder/prog"
for level in x86-64 x86-64-v3 x86-64-v4; do
  printf '#!/bin/sh\necho %s "$@"\nexit 3\n' "$level" > "$folder/prog.$level"
  chmod +x "$folder/prog.$level"
done
supported="$(BARCHAN_CPU=none "$folder/prog" 2>&1)" && fail "takes a level that nobody knows"
[[ $supported == *'BARCHAN_CPU = "none"'*' x86-64;'* ]] || fail "message: $supported"
unset BARCHAN_CPU

best=x86-64
for level in x86-64-v3 x86-64-v4; do
  if [[ $supported == *" $level"[\ \;]* ]]; then best="$level"; fi
done
grep -qw avx512vl /proc/cpuinfo && [ "$best" != x86-64-v4 ] && fail "a processor with AVX-512 is not seen as one"
said="$("$folder/prog" run "a b")" && fail "the exit code is lost"
[ "$said" = "$best run a b" ] || fail "started $said, best is $best"
said="$(BARCHAN_CPU=x86-64 "$folder/prog" keys)" || true
[ "$said" = "x86-64 keys" ] || fail "asked for x86-64, started $said"

rm "$folder"/prog.x86-64-v*
said="$("$folder/prog")" || true
[ "$said" = "x86-64" ] || fail "with the lowest build alone: $said"
rm "$folder/prog.x86-64"
status=0
said="$("$folder/prog" 2>&1)" || status=$?
[ "$status" = 1 ] && [[ $said == *"no build for this processor"* ]] || fail "without a build: $status, $said"
status=0
said="$(BARCHAN_CPU=x86-64 "$folder/prog" 2>&1)" || status=$?
[ "$status" = 1 ] && [[ $said == *"cannot start"*"No such file"* ]] || fail "without the build asked for: $status, $said"
