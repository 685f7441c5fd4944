#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# sh shell.sh ROOT: shellcheck has nothing to say on the scripts below ROOT. Exit code 77: it is not installed.

if ! command -v shellcheck >/dev/null; then
  echo "Skipped: shellcheck is not installed."
  exit 77
fi

cd "$1" || exit 1
count=$(find doc tests source -name '*.sh' -o -name '*.bash' | wc -l)
echo "$count files, and .ci/run"
[ "$count" -gt 10 ] || exit 1
find doc tests source .ci/run \( -name '*.sh' -o -name '*.bash' -o -path .ci/run \) -exec shellcheck {} +
