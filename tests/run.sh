#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# sh tests/run.sh                      builds, runs the quick tests (label quick)
# sh tests/run.sh --full               the tests with the label full, and the short cases of tests/debug in a Debug build; as root and with
#                                      SCREE_DEBIAN13=1 also the quick start in a Debian 13, if there is time
# sh tests/run.sh -R nor_sand          those of all tests that these arguments of ctest name, whatever their label

begin=$(date +%s)
scope=quick
if [ "$1" = --full ]; then
  scope=full
  shift
elif [ $# -gt 0 ]; then
  scope=named
fi

# For the tests alone: the layout of sources and scripts, docstrings and the site of the documentation.
# shellcheck disable=SC2034  # read in setup.sh
test_packages="clang-format shellcheck pyflakes3 doxygen python3-sphinx python3-myst-parser python3-sphinx-rtd-theme libjs-mathjax python3-sphinxcontrib.bibtex python3-pandas snakemake"
# shellcheck source=doc/setup.sh
. "$(dirname -- "$0")/../doc/setup.sh"

# Without these, tests say that they did not run: a browser for the site, and the maker of a Debian 13, if that is asked for.
if [ "$scope" = full ] && [ "$(id -u)" -eq 0 ]; then
  for program in chromium ${SCREE_DEBIAN13:+debootstrap}; do
    command -v "$program" >/dev/null || DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "$program" >/dev/null 2>&1
  done
fi

# Two tests at a time on whatever cores there are: waiting ranks give way.
export OMPI_MCA_mpi_yield_when_idle=1

# The last of Open MPI's programs to end removes folders that another one is just about to use: ompi.HOST.USER, and jf.0/1/0 in it where no mpirun
# gives a run a number of its own. Here something lies in them.
TMPDIR=$(mktemp -d) || exit 1
export TMPDIR
trap 'rm -rf "$TMPDIR"' EXIT
host=$(uname -n)
mkdir -p "$TMPDIR/ompi.$host.$(id -u)/jf.0/1/0/kept" "$TMPDIR/ompi.${host%%.*}.$(id -u)/jf.0/1/0/kept"

# run_tests FOLDER [ctest arguments]: also keeps what ctest says in FOLDER/tests.log.
run_tests()
{
  log=$root/$1/tests.log
  folder=$root/$1
  shift
  # Is one of the tests asked for here?
  ctest --test-dir "$folder" -N "$@" | grep -q 'Test *#' || return 0
  ctest --test-dir "$folder" --output-on-failure -j2 --output-log "$log" "$@"
}

# The line "100% tests passed, 0 tests failed out of 12".
summary()
{
  grep 'tests passed' "$root/$1/tests.log" 2>/dev/null || echo "no tests were found"
}

# The quick start in a Debian 13, which needs MINUTES: all tests together end within 40 minutes.
minutes_of_debian13=12
debian13()
{
  minutes=$((($(date +%s) - begin) / 60))
  left=$((38 - minutes))
  if [ "$left" -lt "$minutes_of_debian13" ]; then
    echo "Debian trixie: DID NOT RUN, since the other tests took $minutes of 40 min."
    return 0
  fi
  timeout -k 20 "${left}m" sh "$root/tests/debian13.sh" "$root/build-debian13" quickstart
  case $? in
    0 | 77) ;;
    124) echo "Debian trixie: DID NOT RUN to its end within $left min." ;;
    *) return 1 ;;
  esac
}

rm -f "$root/build/tests.log" "$root/build-debug/tests.log"
failed=0
if [ "$scope" = quick ]; then
  run_tests build -L '^quick$' || failed=1
else
  label=.
  [ "$scope" = named ] || label='^full$'
  run_tests build -L "$label" "$@" || failed=1
  # The first of the Debug tests compiles scree. Assertions do without debugging information, which takes time to write.
  [ -f "$root/build-debug/CMakeCache.txt" ] || debug_options=-DSCREE_DEBUG_INFO=OFF
  configure_scree build-debug Debug ${debug_options:+"$debug_options"} && run_tests build-debug -L '^debug$' "$@" || failed=1
fi
system=
if [ "$scope" = full ] && [ $# -eq 0 ] && [ -n "${SCREE_DEBIAN13:-}" ]; then
  system=$(debian13) || failed=1
  # Only its logs are kept.
  rm -rf "$root/build-debian13/root" "$root/build-debian13/system" "$root/build-debian13/is_made"
fi
[ -f "$root/build/tests.log" ] || [ -f "$root/build-debug/tests.log" ] || failed=1

echo
[ "$failed" -eq 0 ] || echo "FAILED: see above, or build/tests.log and build-debug/tests.log"
[ -z "$system" ] || echo "$system"
[ "$scope" = quick ] || echo "Debug:   $(summary build-debug)"
echo "Release: $(summary build)"
exit "$failed"
