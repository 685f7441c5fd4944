#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# sh compile_jobs.sh SETUP: the number of compile jobs that doc/setup.sh finds must not depend on the threads of OpenMP.

eval "$(sed -n '/^compile_jobs()/,/^}/p' "$1")"

# shellcheck disable=SC2030,SC2031  # each for its subshell alone
{
  one=$(export OMP_NUM_THREADS=1 OMP_THREAD_LIMIT=1; compile_jobs)
  many=$(export OMP_NUM_THREADS=64; compile_jobs)
}
echo "1 thread: $one compile jobs; 64 threads: $many"
[ "$one" -ge 1 ] && [ "$one" -eq "$many" ]
