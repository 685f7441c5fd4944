#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# sh format.sh ROOT: the layout of all C++ below ROOT is that of .clang-format. Exit code 77: there is no clang-format 14; others lay out
# some things in another way.

for program in clang-format-14 clang-format ''; do
  if [ -n "$program" ] && "$program" --version 2>/dev/null | grep -q 'version 14\.'; then
    break
  fi
done
if [ -z "$program" ]; then
  echo "Skipped: clang-format 14 is not installed."
  exit 77
fi

cd "$1" || exit 1
count=$(find source include tests -name '*.cc' -o -name '*.h' | wc -l)
echo "$count files"
[ "$count" -gt 100 ] || exit 1
find source include tests \( -name '*.cc' -o -name '*.h' \) -exec "$program" --dry-run -Werror {} + || {
  echo "Remedy: $program -i FILE"
  exit 1
}
