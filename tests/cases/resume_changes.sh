#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# resume_changes.sh SCREE LAUNCHER: what --resume says of a case that is no longer that of the checkpoint. What is appended to a
# case wins over what stands above.
set -e
scree=$1
short='set End time = 0.01
subsection Output
  set Checkpoint interval = 0.005
end'

# base CASE: the short run of the case whose checkpoints are resumed below
base()
{
  printf '%s\n' "include $SHORT_CASES/$1.prm" "$short" >base.prm
  rm -rf results
  "$scree" base.prm >screen
  rm -rf whole
  mv results whole
}

# resume STATEMENTS: with these after the case; the exit code is in $code
resume()
{
  rm -rf results
  cp -r whole results
  printf '%s\n' "$(cat base.prm)" "$1" >changed.prm
  code=0
  "$scree" changed.prm --resume >screen 2>error || code=$?
}

fail()
{
  echo "$1"
  cat screen error
  tail -n 5 results/log.txt
  exit 1
}

# refused STATEMENTS MESSAGE
refused()
{
  resume "$1"
  echo "refused: $(cat error)"
  [ $code -eq 1 ] || fail "The exit code is $code and should be 1."
  grep -qF "$2" error || fail "The error should say: $2"
  [ "$(wc -l <error)" -eq 1 ] || fail "The error should be one line."
  cmp -s results/statistics whole/statistics || fail "The statistics have changed."
}

# goes_on STATEMENTS LINE: nothing in the log if the line is empty
goes_on()
{
  resume "$1"
  [ $code -eq 0 ] || fail "The exit code is $code and should be 0."
  noted=$(grep -F "Changed from here on" results/log.txt || true)
  echo "goes on: $noted"
  [ "$noted" = "$2" ] || fail "The log should say: $2"
}

# in_subsection NAME STATEMENT
in_subsection()
{
  printf 'subsection %s\n  set %s\nend' "$1" "$2"
}

of_run="the run that wrote results/checkpoint/step-"
base column_short
refused "$(in_subsection Mesh 'Upper corner = 4, 1.5')" "subsection Mesh, entry \"Upper corner\" = 4, 1.5: $of_run"
refused "$(in_subsection Mesh 'Cell size = 0.05')" " had 0.1, and --resume cannot change that."
refused "$(in_subsection Mesh 'Basis = linear')" 'entry "Basis" = linear'
refused "set Gravity = 0, -1.62" 'entry "Gravity" = 0, -1.62'
refused "set Dimension = 3
set Gravity = 0, 0, -9.81
$(in_subsection Mesh 'Upper corner = 3, 1, 1.5')
$(in_subsection Mesh 'Lower corner = 0, 0, 0')" 'entry "Dimension" = 3'
refused "set Bodies = Soil, Clay
$(in_subsection Clay 'Region = x > 2 && y < 1')" 'entry "Bodies" = Soil, Clay'
refused "$(in_subsection Soil 'Region = x < 2 && y < 1')" 'subsection Soil, entry "Region" = x < 2 && y < 1'
refused "$(in_subsection Soil 'Material = linear elastic')" 'subsection Soil, entry "Material" = linear elastic'
refused "$(in_subsection Boundaries 'Bottom = free slip')" 'subsection Boundaries, entry "Bottom" = free slip'
refused "$(in_subsection Water 'Region = same')" "subsection Water: $of_run"
refused "$(in_subsection Stabilisation 'F-bar = none')" 'subsection Stabilisation, entry "F-bar" = none'
# TPIC reads no PIC rate.
refused "$(in_subsection Transfer 'PIC rate = auto')
$(in_subsection Transfer 'Method = TPIC')" 'subsection Transfer, entry "Method" = TPIC'
refused "$(in_subsection 'Time step' 'Mass scaling = 2')" 'subsection Time step, entry "Mass scaling" = 2'
refused "$(in_subsection Transfer 'Method = AFLIP')" 'subsection Transfer, entry "Method" = AFLIP'
refused "set End time = 0.004" 'entry "End time" = 0.004: the checkpoint results/checkpoint/step-'
goes_on "" ""
goes_on "set End time = 1.5e-2
$(in_subsection Mesh 'Upper corner = 3.0, 15e-1')
$(in_subsection Output 'Statistics interval = 0.002')" ""
goes_on "$(in_subsection 'Time step' 'Courant number = 0.3')" \
  'Changed from here on: subsection Time step, entry "Courant number" = 0.3, before auto.'
goes_on "$(in_subsection Transfer 'PIC rate = 2')" \
  'Changed from here on: subsection Transfer, entry "PIC rate" = 2, before 5.'
base water_short
refused "$(in_subsection Water 'Density = 1020')" 'subsection Water, entry "Density" = 1020'
goes_on "$(in_subsection Transfer 'Method = TPIC')" \
  'Changed from here on: subsection Transfer, entry "Method" = TPIC, before AFLIP.'
goes_on "subsection Water
$(in_subsection Pressure 'Relative tolerance = 1e-9')
end" 'Changed from here on: subsection Water/Pressure, entry "Relative tolerance" = 1e-9, before 1e-12.'
