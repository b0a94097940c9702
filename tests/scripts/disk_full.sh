#!/usr/bin/env bash
# Runs on a disk that fills up; skipped where no small file system can be mounted.
set -euo pipefail
support="$(cd "$(dirname "${BASH_SOURCE[0]}")/../support" && pwd)"
work="$(mktemp -d)"
cleanup() {
  umount "$work/disk" 2> /dev/null || true
  rm -rf "$work"
}
trap cleanup EXIT
mkdir "$work/disk" "$work/elsewhere"
mount -t tmpfs -o size=4m tmpfs "$work/disk" 2> /dev/null || { echo "cannot mount a small tmpfs here"; exit 77; }
/usr/bin/python3 "$support/disk_full.py" "$work/disk" "$work/elsewhere"
