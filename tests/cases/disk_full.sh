#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# disk_full.sh SCREE LAUNCHER: a checkpoint that finds no room stops the run with an error; the older ones
# stay whole, and the run can be resumed as if nothing had happened. A limit on the size of files stands for the full disk.
set -e
cases=$(dirname -- "$0")
scree=$1
printf '%s\n' "include $cases/column_short.prm" 'subsection Output' '  set Checkpoint interval = 0.03' 'end' >case.prm
printf '%s\n' "$(cat case.prm)" 'set End time = 0.08' >begin.prm

rm -rf results whole
"$scree" case.prm >screen
cp results/statistics whole

# begin: a run that has got to 0.08 s, with checkpoints at 0.03 and 0.06 s
begin()
{
  rm -rf results
  "$scree" begin.prm >screen
}

# full CASE BLOCKS [--resume]: a run with room for so many blocks of 512 bytes in a file
full()
{
  (
    trap '' XFSZ
    ulimit -f "$2"
    export PMIX_MCA_gds=hash OMPI_MCA_btl=self # Open MPI without files of its own
    code=0
    "$scree" "$1" ${3:+"$3"} >screen 2>error || code=$?
    echo $code >code
  )
}

begin
newest=$(echo results/checkpoint/*)
full case.prm 200 --resume
cat error
[ "$(cat code)" -eq 1 ]
grep -q "^scree: case.prm: results/checkpoint/unfinished/points.0: cannot be written: " error
grep -q "bytes are needed" error
grep -q "Still whole: results/checkpoint/step-[0-9]* and results/checkpoint/step-[0-9]*.$" error
[ "$(echo results/checkpoint/*)" = "$newest" ]
"$scree" case.prm --resume >screen
"$PYTHON" "$cases/compare_statistics.py" whole results/statistics 1e-12

printf '%s\n' "$(cat case.prm)" 'subsection Output' '  set Graphics = points' 'end' 'subsection Soil' '  set Points per cell = 5' 'end' >pictures.prm
rm -rf results
full pictures.prm 54 # the pictures need more, parameters.prm less
cat error
[ "$(cat code)" -eq 1 ]
grep -q "^scree: pictures.prm: results/solution/points_0000[01].0.vtu: cannot be written: " error
