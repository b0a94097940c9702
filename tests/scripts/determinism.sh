#!/usr/bin/env bash
# Equal runs give equal bits whatever the addresses, the threads' pace and what memory held before.
set -euo pipefail
support="$(cd "$(dirname "${BASH_SOURCE[0]}")/../support" && pwd)"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
/usr/bin/python3 "$support/determinism.py" "$work"
