# shellcheck shell=bash disable=SC2154  # what comes from the caller's `local`
# Completion of ./barchan and barchan for bash: source scripts/completion.bash
# For zsh first: autoload -U compinit bashcompinit && compinit && bashcompinit
#
# Nothing is listed here. Commands, options and what they take are those of `barchan --help`; keys are those of
# docs/keys.md, figures those of python/barchan/figures/registry.py, cases and run folders those on the disk.
_barchan() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} command=${COMP_WORDS[1]:-} IFS=$'\n'
  local launcher=${COMP_WORDS[0]/#\~\//$HOME/} shared takes="" operands=0 at
  COMPREPLY=()
  if [ "$launcher" != "${_barchan_launcher:-}" ]; then  # asked once
    _barchan_help=$("$launcher" --help 2> /dev/null) || return
    _barchan_launcher=$launcher
  fi
  shared=$(sed -n 's|.* are looked for in \(.*\)/configs\. .*|\1|p' <<< "$_barchan_help")
  if [ "$COMP_CWORD" = 1 ]; then
    _barchan_offer < <(_barchan_commands | awk '!seen[$1]++ { print $1 }')
    return
  fi
  if [ "$word" = = ]; then word=""; elif [ "$before" = = ]; then before=${COMP_WORDS[COMP_CWORD - 2]}; fi
  for ((at = 2; at < COMP_CWORD; ++at)); do
    if [[ ${COMP_WORDS[at]} != -* ]]; then operands=$((operands + 1)); fi
  done
  case $before in  # the word in capitals: of an option what follows it in the help, else what the command takes
    --*[!a-z-]*) ;;
    --*) takes=$(sed -n "s/.*$before \([A-Z][A-Z=]*\)\>.*/\1/p" <<< "$_barchan_help" | sort -u) ;;
  esac
  if [ -z "$takes" ]; then
    [[ ${COMP_WORDS[COMP_CWORD]} != = && ${COMP_WORDS[COMP_CWORD - 1]} != = ]] || return  # the value of a key
    if [[ $word == -* ]]; then takes=--; else takes=$(_barchan_operand "$operands"); fi
  fi
  case $takes in
    --) _barchan_offer < <(_barchan_options) ;;
    KEY=VALUE)
      _barchan_offer < <(_barchan_keys | sed -n 's/^key \(.*\)/\1=/p')
      compopt -o nospace +o filenames 2> /dev/null
      ;;
    NAME) [ "$command" != keys ] || _barchan_offer < <(_barchan_keys | sed 's/^[a-z]* //' | sort -u) ;;
    CASE.toml) _barchan_cases -L ;;
    STUDY.toml) _barchan_cases -l ;;
    FIGURE) _barchan_offer < <(_barchan_figures) ;;
    RUN_DIR | FOLDER) _barchan_runs -d ;;
    PATH | FILE) _barchan_runs -f ;;
    DIR) _barchan_add < <(compgen -d -- "$word") ;;
  esac
}

_barchan_add() { while read -r at; do COMPREPLY+=("$at"); done; }

_barchan_offer() {  # those of the lines that begin as the word
  while read -r at; do if [[ $at == "$word"* ]]; then COMPREPLY+=("$at"); fi; done
}

_barchan_commands() { sed -n '/^Cases that/q; s/^  \([a-z].*\)/\1/p' <<< "$_barchan_help"; }

_barchan_options() {  # of the command
  awk -v command="$command" '/^Cases that/ { exit } /^  [a-z]/ { on = $1 == command } on' <<< "$_barchan_help" |
    grep -o -- '--[a-z][a-z-]*'
  echo --help
}

_barchan_operand() {  # _barchan_operand COUNT: what the command takes behind so many others; its last may be repeated
  _barchan_commands | sed 's/  .*//; s/ \.\.\.//; s/[][]//g' |
    awk -v command="$command" -v at="$(($1 + 2))" '$1 == command && NF > 1 { print $(at < NF ? at : NF); exit }'
}

_barchan_keys() {  # lines "section grains.wall" and "key grains.wall.friction"
  zcat -f "$shared"/{docs,../doc/barchan/docs}/keys.md{,.gz} 2> /dev/null | awk -F '[][` ]+' '
    /^## \[/ { section = $2; single = !/\[\[/; print "section", section }
    /^\| `/ && single { print "key", section "." $2 }'
}

_barchan_cases() {  # _barchan_cases -L|-l: ours without or with a [study]; all other TOML files and folders
  _barchan_offer < <(cd "$shared/configs" && grep -r "$1" --include='*.toml' -e '^\[study\]' . | sed 's|^\./||' | sort)
  _barchan_add < <(compgen -f -X '!*.toml' -- "$word"; compgen -d -- "$word")
}

_barchan_runs() {  # _barchan_runs -d|-f: runs and studies below runs, and all other folders or files
  _barchan_offer < <(find runs -maxdepth 6 \( -name run.json -o -name study.json \) -printf '%h\n' 2> /dev/null |
    sort -u)
  _barchan_add < <(compgen "$1" -- "$word" | grep -vxF -- "$(printf '%s\n' "${COMPREPLY[@]}")")
}

_barchan_figures() {
  local python
  for python in "$shared/python" /usr/lib/python3/dist-packages; do
    sed -n 's/.*Entry("\([a-z_]*\)".*/\1/p; s/^    "\(fig[0-9]*\)".*/\1/p' "$python/barchan/figures/registry.py" \
      2> /dev/null && break
  done | sort -u
}

complete -o filenames -o bashdefault -o default -F _barchan barchan
