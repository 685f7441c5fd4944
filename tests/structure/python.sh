#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# sh python.sh ROOT: pyflakes finds no unused or undefined name in the Python below ROOT. Exit code 77: it is not installed.

if ! command -v pyflakes3 >/dev/null; then
  echo "Skipped: pyflakes3 is not installed."
  exit 77
fi

cd "$1" || exit 1
count=$(find source tests -name '*.py' | wc -l)
echo "$count files"
[ "$count" -gt 50 ] || exit 1
pyflakes3 source/python tests doc/conf.py
