# What set-up and build say while they take their time; read in by the launcher and by scripts/setup.sh. `speaker` is
# who speaks.
# shellcheck shell=bash
say() { (trap '' PIPE && echo "${speaker:?}: $*" >&2) || true; }  # that nobody can read it costs nothing
die() {  # die STATUS MESSAGE
  local status=$1
  shift
  say "$*"
  exit "$status"
}

# progress WHAT LOG STATE COMMAND...: runs COMMAND with its output added to LOG. Says WHAT, every 20 s how far it is (the
# output of STATE LOG, a function), and how long it took.
progress() {
  local what=$1 log=$2 state=$3 start=$SECONDS status=0 watch far never
  shift 3
  say "$what ..."
  (  # waits by `read` from a pipe to which nobody writes: no `sleep` is left behind
    exec {never}<> <(:)
    while ! read -r -t 20 -u "$never" && kill -0 "$$" 2> /dev/null; do
      far="$("$state" "$log")" || true
      say "... still $what ($((SECONDS - start)) s${far:+, $far})"
    done
  ) &
  watch=$!
  "$@" >> "$log" 2>&1 || status=$?
  { kill "$watch" && wait "$watch"; } 2> /dev/null || true
  [ "$status" -ne 0 ] || say "... took $((SECONDS - start)) s"
  return "$status"
}
