#!/usr/bin/env bash
# Fifty kills at random moments.
set -euo pipefail
BARCHAN_KILLS="${BARCHAN_KILLS:-50}" exec bash "$(dirname "${BASH_SOURCE[0]}")/../kills.sh"
