#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# doxygen_filter.sh FILE: what Doxygen reads in place of FILE.
# A header: all of it in the group of its folder. Lines keep their numbers.
# A page: links to pages that Doxygen does not read are plain text.
# references.bib (one field a line): the page References, an entry a line, with the anchors that @source{key} links to.

case $1 in
*.h)
  folder=${1#*include/scree/}
  printf '/** @folder{%s} */ ' "${folder%%[/.]*}"
  cat -- "$1"
  printf '/** @} */\n'
  ;;
*.md)
  sed -E '/\]\((doc\/)?(step|developer)\.md\)/!s/\[([^]]*)\]\([^):]*\.md(#[^)]*)?\)/\1/g' "$1"
  ;;
*.bib)
  awk '
    BEGIN { print "# References {#references}\n" }
    /^@/ { split($0, head, /[{, ]+/); key = head[2]; delete field }
    /^ *[a-z]+ *= *[{]/ {
      name = $1
      sub(/=.*/, "", name)
      sub(/^[^{]*[{]/, "")
      sub(/[}],? *$/, "")
      gsub(/[{]\\"u[}]/, "ü"); gsub(/[{]\\"U[}]/, "Ü"); gsub(/[{]\\"a[}]/, "ä"); gsub(/[{]\\"o[}]/, "ö")
      gsub(/[{}]/, ""); gsub(/--/, "-")
      field[name] = $0
    }
    /^[}]/ {
      gsub(/ and /, ", ", field["author"])
      where = field["journal"] field["publisher"] field["institution"] field["howpublished"]
      if ("volume" in field)
        where = where " " field["volume"] ", " field["pages"]
      printf "- \\anchor ref_%s **%s** %s (%s). %s. %s.\n", key, key, field["author"], field["year"], field["title"], where
    }' "$1"
  ;;
esac
