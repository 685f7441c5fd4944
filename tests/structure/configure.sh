#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# sh configure.sh ROOT: CMake refuses a build in the source, a build type that deal.II does not have, and a folder without deal.II.

folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
# The file alone: nothing that is refused comes as far as the sources.
cp "$1/CMakeLists.txt" "$folder/"

# refused TEXT FOLDER [OPTION...]
refused()
{
  text=$1
  built=$2
  shift 2
  if cmake -S "$folder" -B "$folder/$built" "$@" >"$folder/log" 2>&1 || ! tr -s '\n ' ' ' <"$folder/log" | grep -q "$text"; then
    cat "$folder/log"
    echo "Not found: $text"
    exit 1
  fi
}

refused "built in a folder of its own" .
rm -rf "$folder/CMakeCache.txt" "$folder/CMakeFiles"
refused "is Debug or Release, not RelWithDebInfo" build -DCMAKE_BUILD_TYPE=RelWithDebInfo
refused "no deal.II 9.4 or later in DEAL_II_DIR = $folder/nowhere" build_option -DDEAL_II_DIR="$folder/nowhere"
export DEAL_II_DIR="$folder/elsewhere"
refused "no deal.II 9.4 or later in DEAL_II_DIR = $folder/elsewhere" build_environment
