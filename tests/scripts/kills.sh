#!/usr/bin/env bash
# Runs that are killed at random moments go on as if nothing had been: BARCHAN_KILLS of them (6).
set -euo pipefail
support="$(cd "$(dirname "${BASH_SOURCE[0]}")/../support" && pwd)"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
/usr/bin/python3 "$support/kills.py" "${BARCHAN_KILLS:-6}" "$work" "${BARCHAN_SEED:-1}"
