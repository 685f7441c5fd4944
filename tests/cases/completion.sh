#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# completion.sh SCREE LAUNCHER: what bash completes; the options are those of --help.
set -e
cases=$(dirname -- "$0")
script=$cases/../../source/program/scree.bash
scree=$1

rm -rf files
mkdir -p files/sub.d
cd files
touch my.prm mine.prm other.txt

# completed WORD...: what bash offers for the last word, one reply a line.
completed()
{
  # shellcheck disable=SC2016 # of the inner shell
  bash --norc -c '. "$0"; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _scree; printf "%s\n" "${COMPREPLY[@]}" | sort' "$script" "$scree" "$@"
}

expect()
{
  wanted=$1
  shift
  got=$(completed "$@" | tr '\n' ' ')
  echo "scree $*: $got"
  [ "$got" = "$wanted " ] || { echo "wanted: $wanted"; exit 1; }
}

expect 'mine.prm my.prm' m
expect '--resume' --re
expect '--new' my.prm --n
expect '--show' my.prm --sh
expect '--accuracy --ranks' my.prm --advise --
expect '--json --sections' --print-parameters --
printf 'subsection Stage Lift 1\nend\n' > staged.prm
expect 'Lift\ 1' staged.prm --safety --stage ''
rm staged.prm
expect 'slope' --new sl
expect '' --accuracy ''
expect 'Time\ step' --print-parameters Ti
expect 'Time\ step' --print-parameters 'Time\ s'
expect 'Time step' --print-parameters '"Time s'
expect 'Soil/Initial\ state' --print-parameters Soil/I
expect 'sub.d' sub

options=$("$scree" --help | grep -o -e '--[a-z-]*' | sort -u)
offered=$({ completed --; completed --advise --; completed --safety --; completed --new --; completed --print-parameters --; } | sort -u)
[ "$options" = "$offered" ] || { echo "--help: $options"; echo "completion: $offered"; exit 1; }

# shellcheck disable=SC2016 # of the inner shell
touch study.toml
studies=$(bash --norc -c '. "$0"; COMP_WORDS=(scree-scenarios "$1"); COMP_CWORD=1; _scree_scenarios; printf "%s " "${COMPREPLY[@]}"' "$script" s)
[ "$studies" = 'study.toml sub.d ' ] || { echo "scree-scenarios s: $studies"; exit 1; }

of_element=$(bash --norc -c '. "$0"; COMP_WORDS=(scree-element --fit "$1"); COMP_CWORD=2; _scree_element; printf "%s " "${COMPREPLY[@]}"' "$script" s)
[ "$of_element" = 'study.toml sub.d ' ] || { echo "scree-element --fit s: $of_element"; exit 1; }

# The file loads with the name of each command, as it is installed.
bash --norc -c ". '$script'; complete -p scree scree-element scree-fit scree-scenarios"
