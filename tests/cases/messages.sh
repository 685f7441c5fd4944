#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# messages.sh SCREE LAUNCHER CASE MESSAGES BYTES: a run on two ranks sends no more messages and bytes than these. (Times depend on what else a
# machine does; these do not.)
set -e
cases=$(dirname -- "$0")
mpicc -shared -fPIC -O2 -o count_mpi.so "$cases/../../doc/studies/count_mpi.c"
# shellcheck disable=SC2086 # The launcher is several words.
$2 2 env LD_PRELOAD=./count_mpi.so "$1" "$SHORT_CASES/$3.prm" >screen 2>counts
# mpi: ranks 2 messages SUM MOST bytes SUM MOST collectives MOST
grep '^mpi:' counts | awk -v messages="$4" -v bytes="$5" '
  { print $5, "messages and", $8, "bytes; at most", messages, "and", bytes
    n = NR; if ($5 > messages || $8 > bytes) exit 1 }
  END { if (n != 1) exit 1 }'
