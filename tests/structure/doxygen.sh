#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# sh doxygen.sh ROOT [INPUT]: Doxygen has nothing to say on doc/Doxyfile of ROOT: all public members have a text, all @source{key} an entry in
# doc/references.bib. INPUT: the same of other files. Exit code 77: Doxygen is not installed.

if ! command -v doxygen >/dev/null; then
  echo "Skipped: doxygen is not installed."
  exit 77
fi

cd "$1" || exit 1
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
{
  cat doc/Doxyfile
  # References are only looked up where there is output; this one is the fastest.
  printf '%s = %s\n' OUTPUT_DIRECTORY "$folder" GENERATE_HTML NO GENERATE_XML YES XML_PROGRAMLISTING NO
  [ $# -lt 2 ] || printf 'INPUT = %s doc/references.bib\n' "$2"
} | doxygen - >/dev/null 2>"$folder/warnings"

count=$(find "$folder/xml" -name '*.xml' | wc -l)
echo "$count pages"
sort -u "$folder/warnings"
[ "$count" -gt 5 ] && [ ! -s "$folder/warnings" ]
