#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# new_case.sh SCREE LAUNCHER: --new lists scenes and writes the case of each, which runs; no file is replaced without being asked.
set -e
program=$(readlink -f -- "$1")
launcher=$2 # several words

rm -rf new
mkdir new
cd new
# The program alone is enough: what it writes does not come from a folder.
cp "$program" copy
scree=$PWD/copy

"$scree" --new >list
cat list
scenes=$(sed -n 's/^  \([a-z_]*\) .*/\1/p' list)
[ "$(echo "$scenes" | wc -l)" -ge 12 ]

# Some time steps of each.
for scene in $scenes; do
  "$scree" --new "$scene" >said
  grep -q "^Written: $scene.prm" said
  grep -q "^set Output directory = results/$scene$" "$scene.prm"
  grep -q "^#" "$scene.prm"
  awk '$2 == "End" { end = $5 } $2 == "Interval" { n = end / $4 } END { exit !(n >= 20 && n <= 32.001) }' "$scene.prm"
  sed 's/^\( *set End time *=\).*/\1 0.2/' "$scene.prm" >short.prm
  "$scree" short.prm >screen
  grep -q '^Checks' screen
  grep -q '^Finished' screen
  grep '^Finished' screen | grep -Eq ' ([2-9]|[1-9][0-9]+) steps'
done
[ -s mountain.asc ]
# The command that is named next is not refused: --advise is, where points enter.
"$scree" --new debris_flow flow.prm --overwrite | grep -q '^Next: scree flow.prm$'
"$scree" --new slope bank.prm | grep -q '^Next: scree bank.prm --advise, then scree bank.prm$'

refused()
{
  if "$scree" "$@" 2>error; then
    echo "accepted: $*"
    exit 1
  fi
  cat error
}

# A changed file stays; an equal one is no obstacle.
"$scree" --new slope >/dev/null
echo '# mine' >>slope.prm
cp slope.prm mine
refused --new slope
grep -q 'slope.prm: the file exists.*--overwrite' error
cmp slope.prm mine
"$scree" --overwrite --new slope >/dev/null
if grep -q mine slope.prm; then exit 1; fi

# Another name, and other ranks: one of them writes.
mkdir sub
$launcher 2 "$scree" sub/bank.prm --new slope
grep -q '^set Output directory = results/bank$' sub/bank.prm
"$scree" --new terrain sub/hill.prm >/dev/null
[ -s sub/release.asc ]

refused --new slope nowhere/slope.prm
grep -q 'cannot be written' error
