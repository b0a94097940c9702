# shellcheck shell=bash
# Sourced by script tests that draw; skipped without the plotting modules.
# shellcheck source=tests/support/script.sh
. "$(dirname "${BASH_SOURCE[0]}")/script.sh"
"$python" -c 'import h5py, matplotlib, numpy' 2> /dev/null || { echo "no h5py or matplotlib"; exit 77; }

fake() { "$python" "$root/tests/support/make_fake_run.py" "$@" || fail "make_fake_run $*"; }

programs=$PATH  # where plot finds ffmpeg, if any
plot() {  # plot EXPECTED_STATUS ARGUMENT...
  local expected=$1 status=0 module=(barchan plot)
  shift
  if [ "$1" = validation ]; then
    module=(validation)
    shift
  fi
  PATH="$programs" "$python" -m "${module[@]}" "$@" > "$dir/out" 2> "$dir/err" || status=$?
  [ "$status" = "$expected" ] || fail "plot $* ended with $status, not $expected: $(cat "$dir/err")"
  ! grep -q Traceback "$dir/err" || fail "plot $* shows a traceback"
}

is_picture() {  # is_picture PATH [BYTES]: a PNG of more than so many (5000) and less than 300 kB
  [ "$(head -c 4 "$1" 2> /dev/null | tail -c 3)" = PNG ] || { fail "no picture $1"; return; }
  [ "$(wc -c < "$1")" -lt 300000 ] || fail "$1 is larger than 300 kB"
  [ "$(wc -c < "$1")" -gt "${2:-5000}" ] || fail "$1 looks empty"
}

is_figure() {  # is_figure PATH_WITHOUT_END: a PNG and a PDF
  is_picture "$1.png" 15000
  [ "$(head -c 4 "$1.pdf" 2> /dev/null)" = %PDF ] || fail "no $1.pdf"
}

is_drawing() {  # is_drawing PATH_WITHOUT_END: an SVG file that follows the page, and a PDF file
  grep -q '<style>:root{color-scheme:light dark;' "$1.svg" || fail "no $1.svg for dark pages"
  grep -q '#000000"\|: #000000' "$1.svg" && fail "$1.svg has black ink that dark pages swallow"
  [ "$(wc -c < "$1.svg")" -lt 300000 ] || fail "$1.svg is larger than 300 kB"
  [ "$(head -c 4 "$1.pdf" 2> /dev/null)" = %PDF ] || fail "no $1.pdf"
}

same_drawing() {  # same_drawing A B: SVG files that differ by less than 0.1 point
  "$python" - "$1" "$2" <<'PYTHON'
import re, sys
from pathlib import Path
number = re.compile(r"\d+\.?\d*")
name = re.compile(r'(id="|url\(#|href="#)[^")]*')  # made of digests
ours, theirs = (name.sub("", Path(path).read_text()) for path in sys.argv[1:])
values = [[float(found) for found in number.findall(text)] for text in (ours, theirs)]
sys.exit(number.sub("", ours) != number.sub("", theirs) or any(abs(a - b) > 0.1 for a, b in zip(*values)))
PYTHON
}

says() {  # says TEXT: somewhere on the error stream
  grep -qF -- "$1" "$dir/err" || fail "expected '$1', got '$(cat "$dir/err")'"
}

says_only() {  # says_only TEXT: the same, and nothing else
  says "$1"
  [ "$(wc -l < "$dir/err")" = 1 ] || fail "expected one line, got: $(cat "$dir/err")"
}

quiet() { [ ! -s "$dir/err" ] || fail "warnings: $(cat "$dir/err")"; }

refused() {  # refused TEXT ARGUMENT...: plot ends with 2 and one line, which has this text
  plot 2 "${@:2}"
  says_only "$1"
}
