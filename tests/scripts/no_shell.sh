#!/usr/bin/env bash
# No text that was put together - from a case file, a path, an argument - is ever read as a command:
# programs are started from lists of arguments, or not at all. And shellcheck, where there is one, finds
# nothing in the scripts (an expansion without quotes is the other way to a command nobody wrote).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

failures=0
complain() {
  echo "$1"
  failures=$((failures + 1))
}

mapfile -d '' sources < <(find kernels src perf tests \( -name '*.hpp' -o -name '*.cpp' \) -print0)
mapfile -d '' pythons < <(find analysis scripts perf tests -name '*.py' -print0)
mapfile -d '' shells < <(find scripts tests .ci -name '*.sh' -print0)
shells+=(barchan)

# In C++ nothing starts a program: what runs over ranks, draws or sweeps is started by the launcher.
if grep -nE '\b(system|popen|wordexp|exec[lv]p?e?|posix_spawnp?) *\(' "${sources[@]}"; then
  complain "a program is started from C++"
fi
/usr/bin/env python3 tests/support/no_shell.py "${pythons[@]}" || complain "Python starts a shell"
# `eval`, and a text for `sh -c` into which something is expanded; "\$@" and '...' are for the inner shell.
# shellcheck disable=SC2016  # a pattern
if grep -nE '(^|[;&|(] *|\b(then|do|else) +)eval\b|\b(ba|da)?sh +(-[a-z]+ +)*-[a-z]*c +([^ '\''"]|"([^"\\$`]|\\.)*[$`])' \
  "${shells[@]}" | grep -v '^tests/scripts/no_shell.sh:'; then
  complain "a text that was put together is run"
fi
if command -v shellcheck > /dev/null; then
  shellcheck "${shells[@]}" || complain "shellcheck: findings above"
else
  echo "no shellcheck: scripts not looked at"
fi

[ "$failures" -eq 0 ] || exit 1
echo "no shell: ${#sources[@]} C++, ${#pythons[@]} Python and ${#shells[@]} shell files are in order"
