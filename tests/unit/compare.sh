#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# sh compare.sh EXPECTED DIRECTORY COMMAND...: what COMMAND prints in the empty folder DIRECTORY is the comment that ends the file EXPECTED.
# Numbers are compared as in deal.II's tests: relative 1e-8 or absolute 1e-6.

expected=$1
directory=$2
shift 2

rm -rf "$directory"
mkdir -p "$directory"
cd "$directory" || exit 2

if ! "$@" >output 2>&1; then
  cat output
  exit 1
fi
sed -En '1,/^(\/\/|#) Output.*:$/d; s/^(\/\/|#) ?//p' "$expected" >wanted
if ! numdiff -a 1e-6 -r 1e-8 -s ' \t\r\n=,:;<>[](){}^' wanted output >difference; then
  head -n 50 difference
  echo "Expected: $expected"
  echo "Got:      $directory/output"
  exit 1
fi
