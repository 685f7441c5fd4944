#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# sh expect_error.sh SOURCE DIRECTORY NAME LAUNCHER COMMAND...: runs COMMAND in DIRECTORY beside the cases of SOURCE,
# below LAUNCHER, such as "mpirun -np 2" or "". Passes if all ranks together wrote SOURCE/NAME.expected to standard error,
# and the exit code is 1, or 0 if nothing is expected.

source=$1
directory=$2
name=$3
launcher=$4
shift 4

rm -rf "$directory"
mkdir -p "$directory"
cd "$directory" || exit 2
cp "$source"/*.prm "$source"/*.part "$source"/*.tif .

# Do not wait a second for ranks that end by themselves.
export OMPI_MCA_odls_base_sigkill_timeout=0

# mpirun also remarks on exit codes: each rank's standard error goes to a file of its own.
# shellcheck disable=SC2016,SC2086,SC2094  # for the inner shell; a list of words; other files
$launcher sh -c '"$@" 2>error.$$' scree "$@" >output 2>launcher
code=$?
cat error.* >error

wanted=1
[ -s "$source/$name.expected" ] || wanted=0
diff "$source/$name.expected" error || exit 1
if [ "$code" -ne "$wanted" ]; then
  echo "The exit code is $code and should be $wanted."
  exit 1
fi
