#!/usr/bin/env bash
# A day of the paper's dune in steps, with a small heap, in pieces and in one go: some 10 minutes on two cores.
set -euo pipefail
support="$(cd "$(dirname "${BASH_SOURCE[0]}")/../../support" && pwd)"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
/usr/bin/python3 "$support/soak.py" "$work" "${BARCHAN_SOAK_STEPS:-80000}"
