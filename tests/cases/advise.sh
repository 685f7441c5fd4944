#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# advise.sh SCREE LAUNCHER: cases of all kinds of prm/ get an advice with all its parts, and nothing is left behind; two ranks count the same points.
# The study "advice" asks for that of all other cases.
set -e
prm=$(cd -- "$(dirname -- "$0")/../../prm" && pwd)
scree=$1
launcher=$2 # several words
rm -rf prm results advice
mkdir advice
export TMPDIR="$PWD/advice"

# Whole runs with wider cells, of which later steps are told, for three cases; the others end in their first steps.
whole="columns/column_saturated_3d bed/slit_dam benchmarks/elastic_2d"
first_steps="bed/piston clay/quick_clay contact/slide_over_slab dynamics/shaken_block seepage/capillary_fringe
  slopes/slope_saturated_dense_single slopes/slope_jefferies_been slopes/rain terrain/mountain_dry water/hydrostatic quickstart"
"$PYTHON" - "$prm" "$whole" <<END
import pathlib, shutil, sys
from scree.variants import read_case, set_entry
shutil.copytree(sys.argv[1], "prm", ignore=shutil.ignore_patterns("element"))
for case in pathlib.Path("prm").rglob("*.prm"):
    text = read_case(case)
    case.with_suffix(".whole").write_text(text if str(case)[4:-4] in sys.argv[2].split() else set_entry(text, "End time", 0.02))
for case in pathlib.Path("prm").rglob("*.whole"):
    case.rename(case.with_suffix(".prm"))
END

for name in $whole $first_steps; do
  case=prm/$name.prm
  "$scree" --advise "$case" >text
  for part in Scales Size "Estimated cost of this case" "Recommendation for a relative error of 0.05"; do
    grep -q "^$part" text || { echo "$case: no part \"$part\""; exit 1; }
  done
  # Numbers of steps, seconds and memory, and the recommended cell, are there and above 0.
  for line in "steps to" "run  " "memory" "cell size"; do
    awk -v line="  $line" 'index($0, line) == 1 { found = 1; match($0, / [0-9.e+-]+( |$)/) || bad = 1
      value = line ~ /steps to/ ? $NF : $(line ~ /cell size/ ? 3 : 2); if (!(value > 0)) bad = 1 } END { exit bad || !found }' text ||
      { echo "$case: line \"$line\" has no number"; cat text; exit 1; }
  done
  case " $whole " in *" $(expr "$case" : 'prm/\(.*\).prm') "*)
    grep -q "^  later: the case was run with cells  *[2-9]" text || { echo "$case: later steps are not known"; cat text; exit 1; } ;;
  esac
  wet=0
  grep -q "^Soil and water" text && wet=1
  # Rigid bodies only are no soil whose drainage could matter.
  awk '/^subsection Water/ { water = 1 } /^set Bodies *= none/ { none = 1 }
    $2 == "Material" { if ($4 == "rigid") rigid = 1; else moves = 1 } END { exit !(water && !none && !(rigid && !moves)) }' "$case" && wanted=1 || wanted=0
  [ "$wet" -eq "$wanted" ] || { echo "$case: a part of soil and water: $wet, wanted $wanted"; exit 1; }
done

count="^  (soil points|water points|cells of|steps to|cell size)"
"$scree" --advise prm/columns/column_saturated.prm --accuracy 0.1 | grep -E "$count" >one_rank
$launcher 2 "$scree" --advise prm/columns/column_saturated.prm --accuracy 0.1 | grep -E "$count" >two_ranks
diff one_rank two_ranks
grep -q "as now: the error is not known" one_rank # fronts of saturated soil have not converged
"$scree" --advise prm/slopes/first_slope.prm --accuracy 0.1 >text
grep -q "cell size .*H/h = 1[6-9]" text # ten per cent of the dry run-out on a base with friction: 1.6 (h/H) = 0.1
"$scree" --advise prm/columns/mohr_coulomb_collapse.prm --accuracy 0.1 >text
grep -q "^  measured in such scenes .*10 to 19 % of the displacement of the front" text
grep -q "^  do not refine .*Set Grain diameter" text
"$scree" --advise prm/terrain/mountain_dry.prm >text
grep -q "cell size .* m, H/h = 3\.[0-9]* (now 10 m: the error is not known)" text # on a bed the thickness counts
"$PYTHON" - <<END
import pathlib
from scree.variants import read_case, set_entry
text = read_case("prm/columns/column_saturated.prm")
pathlib.Path("undrained.prm").write_text(set_entry(text, "Water/Hydraulic conductivity", 1e-9))
END
"$scree" --advise undrained.prm >text
grep -q "^  do not refine .*grows with finer cells" text
# Unusual values come first, as in a run; a run on other ranks is estimated.
sed "s/Grain density *= .*/Grain density = 2.0/" prm/slopes/first_slope.prm >light.prm
"$scree" --advise light.prm --ranks 64 >text
grep -q '^Unusual value: .*entry "Grain density" = 2.0: usual are 900 to 8000 kg/m^3' text
grep -q '^  on 64 ranks, if shared out evenly ' text

[ ! -e results ] || { echo "a run folder was made"; exit 1; }
[ -z "$(ls advice)" ] || { echo "left behind: $(ls advice)"; exit 1; }
