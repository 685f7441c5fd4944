#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# sh lint.sh TOOL ROOT: a tool has nothing to say on the files below ROOT. Exit code 77: it is not installed.
#   format   clang-format 14 on the layout of C++ (others lay out some things in another way); clang-format-14 -i FILE mends it
#   shell    shellcheck on scripts
#   python   pyflakes on unused and undefined names

tool=$1
cd "$2" || exit 1
case $tool in
  format) pattern='^(source|include|tests)/.*\.(cc|h)$' least=100 && set -- clang-format-14 --dry-run -Werror ;;
  shell) pattern='\.(sh|bash)$|^\.ci/run$' least=10 && set -- shellcheck ;;
  python) pattern='^(source/python|tests)/.*\.py$|^doc/conf\.py$' least=50 && set -- pyflakes3 ;;
esac
if ! command -v "$1" >/dev/null; then
  echo "Skipped: $1 is not installed."
  exit 77
fi

files=$(find doc include source tests .ci/run -type f | grep -E "$pattern")
count=$(echo "$files" | wc -l)
echo "$count files"
[ "$count" -gt "$least" ] && echo "$files" | xargs "$@"
