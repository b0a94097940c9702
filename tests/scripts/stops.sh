#!/usr/bin/env bash
# Runs that are asked to stop: restart file, exit code 3, and the same bits when they go on.
set -euo pipefail
support="$(cd "$(dirname "${BASH_SOURCE[0]}")/../support" && pwd)"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
/usr/bin/python3 "$support/stops.py" "$work"
