# SPDX-License-Identifier: LGPL-2.1-or-later
# Completion of the command lines of scree, scree-element, scree-fit and scree-scenarios, for bash, and for zsh after `autoload -U bashcompinit; bashcompinit`:
# options, case files, scenes of --new, subsections of --print-parameters. The program itself lists scenes and subsections.

# The replies that begin with the word before the cursor, from lines of standard input; blanks are quoted.
_scree_reply()
{
  local line word=${COMP_WORDS[COMP_CWORD]} quote=
  case $word in
    \"* | \'*)
      quote=${word:0:1}
      word=${word:1}
      ;;
  esac
  word=${word//\\/}
  while IFS= read -r line; do
    if [[ $line == "$word"* ]]; then
      [ -n "$quote" ] || printf -v line %q "$line"
      COMPREPLY+=("$line")
    fi
  done
}

# Case files, or files with another ending, and folders on the way to them.
_scree_case_files()
{
  local file word=${COMP_WORDS[COMP_CWORD]}
  if type compopt >/dev/null 2>&1; then
    compopt -o filenames 2>/dev/null
  fi
  while IFS= read -r file; do
    COMPREPLY+=("$file")
  done < <(compgen -f -X "!*.${1:-prm}" -- "$word"; compgen -d -- "$word")
}

_scree()
{
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} program=${COMP_WORDS[0]/#\~/$HOME}
  local task='' case_file='' w
  COMPREPLY=()
  for ((w = 1; w < ${#COMP_WORDS[@]}; ++w)); do
    if [ "$w" -eq "$COMP_CWORD" ]; then
      continue
    fi
    case ${COMP_WORDS[w]} in
      --resume | --safety | --show | --advise | --new | --print-parameters | --version | --help | -h) task=${COMP_WORDS[w]} ;;
      *.prm) case_file=${COMP_WORDS[w]/#\~/$HOME} ;;
    esac
  done
  if [[ $word == -* ]]; then
    case $task in
      --safety) _scree_reply <<<'--stage' ;;
      --advise) _scree_reply <<<$'--accuracy\n--ranks' ;;
      --new) _scree_reply <<<'--overwrite' ;;
      --print-parameters) _scree_reply <<<$'--json\n--sections' ;;
      '') _scree_reply <<<$'--resume\n--safety\n--show\n--advise\n--new\n--print-parameters\n--version\n--help' ;;
    esac
    return
  fi
  case $before in
    --accuracy | --ranks) return ;;
    --stage)
      [ -z "$case_file" ] || _scree_reply < <(sed -n 's/^ *subsection  *Stage  *//p' "$case_file" 2>/dev/null)
      return
      ;;
    --new) _scree_reply < <("$program" --new 2>/dev/null | sed -n 's/^  \([a-z_]*\) .*/\1/p') ;;
    --print-parameters) _scree_reply < <("$program" --print-parameters --sections ${case_file:+"$case_file"} 2>/dev/null) ;;
  esac
  # Readline quotes the names of files, and would quote other replies again.
  if [ -z "$case_file" ] && [ "$before" != --new ] && [ "${#COMPREPLY[@]}" -eq 0 ]; then
    _scree_case_files
  fi
}

_scree_element()
{
  local word=${COMP_WORDS[COMP_CWORD]}
  COMPREPLY=()
  if [[ ${COMP_WORDS[1]} == --fit && $COMP_CWORD -gt 1 ]]; then
    _scree_of_fit
  elif [[ $word == -* ]]; then
    _scree_reply <<<$'--fit\n--version\n--help'
  else
    _scree_case_files
  fi
}

_scree_of_fit()
{
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}
  COMPREPLY=()
  if [[ $word == -* ]]; then
    _scree_reply <<<$'--cores\n--help'
  elif [[ $before != --cores ]]; then
    _scree_case_files toml
  fi
}

_scree_scenarios()
{
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}
  COMPREPLY=()
  if [[ $word == -* ]]; then
    _scree_reply <<<$'--dry-run\n--evaluate\n--cores\n--ranks\n--profile\n--help'
  elif [[ $before != --cores && $before != --ranks ]]; then
    _scree_case_files toml
  fi
}

complete -F _scree scree
complete -F _scree_element scree-element
complete -F _scree_scenarios scree-scenarios
complete -F _scree_of_fit scree-fit
