#!/usr/bin/env bash
# The studies that ship name cases that load.
set -u
# shellcheck source=tests/support/studies.sh
. "$(dirname "${BASH_SOURCE[0]}")/../../support/studies.sh"
grep -lZ '^\[study\]' -r "$root/configs" |
  xargs -0 -P 2 -I STUDY "$python" -m barchan sweep "$program" STUDY --list > list 2>&1 ||
  fail "a study that ships: $(cat list)"
finish "studies: fine"
