#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# doxygen_filter.sh FILE: what Doxygen reads in place of FILE.
# A header: all of it in the group of its folder. Lines keep their numbers.
# A page: links to other pages are plain text, as Doxygen does not read all of them.
# references.bib: the page References.

case $1 in
*.h)
  folder=${1#*include/scree/}
  printf '/** @folder{%s} */ ' "${folder%%[/.]*}"
  cat -- "$1"
  printf '/** @} */\n'
  ;;
*.md)
  sed -E 's/\[([^]]*)\]\([^):]*\.md(#[^)]*)?\)/\1/g' "$1"
  ;;
*.bib)
  /usr/bin/python3 "${0%/*}/doxygen_references.py" "$1"
  ;;
esac
