#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# sh tests/sanitise.sh: builds scree with the sanitisers of addresses and of undefined behaviour in build-sanitise, and runs the short
# cases of tests/debug, tests/cases and tests/errors with it. Not one of the tests: the build takes long. Ends with an error if
# a sanitiser has found something; what it said is then in build-sanitise/runs.

# Leaks are not looked for: MPI and its plug-ins keep what they have allocated. deal.II's package is not instrumented, so that containers
# that cross its border must not be annotated.
export ASAN_OPTIONS=detect_leaks=0:detect_container_overflow=0:abort_on_error=0:exitcode=99
export UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=0
root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd) || exit 1
# shellcheck source=doc/mpi.sh
. "$root/doc/mpi.sh"
export OMPI_MCA_mpi_yield_when_idle=1
build=${1:-$root/build-sanitise}
cmake -S "$root" -B "$build" -GNinja -DCMAKE_BUILD_TYPE=Release -DSCREE_NATIVE=OFF -DSCREE_SANITISE=ON &&
  cmake --build "$build" --target scree scree-element errors_messages || exit 1

failed=0
# check CODE NAME COMMAND...: runs it in a folder of its own; sanitisers must have been silent, and the exit code at most CODE.
check()
{
  most=$1
  name=$2
  shift 2
  folder=$build/runs/$name
  rm -rf "$folder"
  mkdir -p "$folder"
  code=0
  (cd "$folder" && "$@" >screen 2>errors </dev/null) || code=$?
  if [ "$code" -gt "$most" ] || grep -Eq 'ERROR: AddressSanitizer|runtime error:' "$folder/errors"; then
    echo "$name: FAILED, exit code $code"
    grep -E -A8 'ERROR: AddressSanitizer|runtime error:' "$folder/errors" | head -20
    failed=1
  else
    echo "$name: clean"
  fi
}

cases=$root/tests/cases/short.table
python3 "$root/tests/errors/tables.py" "$build/cases" "$cases" &&
  python3 "$root/tests/errors/tables.py" "$build/cases" "$root/tests/debug/debug.table" "$cases" || exit 1
for case in "$build"/cases/*.prm; do
  name=$(basename "$case" .prm)
  check 0 "$name" "$build/scree" "$case"
  check 0 "$name.mpirun=2" mpirun -np 2 "$build/scree" "$case"
done
for name in column_short water_short; do
  # shellcheck disable=SC2016  # for the inner shell
  check 0 "$name.resume" sh -c '"$0" "$1" && "$0" "$1" --resume' "$build/scree" "$build/cases/$name.prm"
done
check 0 errors python3 "$root/tests/errors/errors.py" --folder "$folder/errors" --command "$build/tests/errors/errors_messages"
for case in "$root"/prm/element/*.prm; do
  check 0 "element/$(basename "$case" .prm)" "$build/scree-element" "$case"
done
exit "$failed"
