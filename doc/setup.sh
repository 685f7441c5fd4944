# SPDX-License-Identifier: LGPL-2.1-or-later
# shellcheck shell=sh
#
# Everything between a fresh Debian 12 or 13 and a build: packages, environment, build/. Called (sh doc/setup.sh) or sourced by
# doc/quickstart.sh and tests/run.sh; leaves the variable `root` (this repository) and the function configure_scree behind.
# Installs the packages in the variable test_packages, too, and hands the words of configure_options to CMake.

root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd) || exit 1
if [ ! -f "$root/doc/setup.sh" ]; then
  echo "setup.sh: call it (sh doc/setup.sh), or source it from a script in doc/ or tests/." >&2
  exit 1
fi

# Packages -------------------------------------------------------------------------------------------------------------

packages="libdeal.ii-dev libcgal-dev libgdal-dev libopenmpi-dev openmpi-bin numdiff cmake ninja-build g++ python3-vtk9 python3-matplotlib python3-numpy python3-scipy python3-gdal xvfb${test_packages:+ $test_packages}"

# deal.II of Debian 13 links with mold, which its package does not bring.
grep -q '^12' /etc/debian_version 2>/dev/null || packages="$packages mold"

missing_packages()
{
  for package in $packages; do
    dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'install ok installed' || printf '%s ' "$package"
  done
}

install_packages()
{
  # shellcheck disable=SC2086  # a list of words
  $as_root apt-get update && $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends $missing
}

if command -v dpkg-query >/dev/null; then
  missing=$(missing_packages)
  if [ -n "$missing" ]; then
    as_root=
    if [ "$(id -u)" -ne 0 ]; then
      as_root=sudo
      if ! command -v sudo >/dev/null; then
        echo "setup.sh: as root, please: apt-get install --no-install-recommends $missing" >&2
        exit 1
      fi
    fi
    echo "Installing $missing"
    if ! install_packages; then
      echo "setup.sh: the installation failed; once more." >&2
      sleep 10
      install_packages || exit 1
    fi
  fi
else
  echo "setup.sh: not a Debian; deal.II 9.4 or later, numdiff, CMake, Ninja and the VTK module of Python must be there." >&2
fi

# Environment ----------------------------------------------------------------------------------------------------------

# Debian's programs, and not those of another Python or MPI earlier in the path.
PATH=/usr/bin:/bin:$PATH
export PATH

# shellcheck source=doc/mpi.sh
. "$root/doc/mpi.sh"

# Build ----------------------------------------------------------------------------------------------------------------

# How many compilers fit: one for each processor, and 1.5 GB of free memory for each (deal.II's headers are large).
compile_jobs()
{
  # nproc would obey OMP_NUM_THREADS, which is 1 by now.
  jobs=$(env -u OMP_NUM_THREADS -u OMP_THREAD_LIMIT nproc)
  memory=$(awk '/^MemAvailable:/ { print int($2 / 1024) }' /proc/meminfo)
  limit=$(cat /sys/fs/cgroup/memory.max 2>/dev/null)
  case $limit in
    '' | *[!0-9]*) ;;
    *)
      limit=$((limit / 1048576))
      [ "$limit" -lt "$memory" ] && memory=$limit
      ;;
  esac
  [ $((memory / 1500)) -lt "$jobs" ] && jobs=$((memory / 1500))
  [ "$jobs" -lt 1 ] && jobs=1
  echo "$jobs"
}

# Also for the builds that a test starts.
CMAKE_BUILD_PARALLEL_LEVEL=$(compile_jobs)
export CMAKE_BUILD_PARALLEL_LEVEL

# configure_scree FOLDER TYPE [OPTION...]: FOLDER is relative to the root, TYPE is Release or Debug.
configure_scree()
{
  folder=$1
  type=$2
  shift 2
  generator=
  [ -f "$root/$folder/CMakeCache.txt" ] || generator=-GNinja
  cmake -S "$root" -B "$root/$folder" ${generator:+"$generator"} -DCMAKE_BUILD_TYPE="$type" \
    ${CI:+-DSCREE_WARNINGS_AS_ERRORS=ON} "$@"
}

# shellcheck disable=SC2086  # a list of words
configure_scree build Release ${configure_options:-} && cmake --build "$root/build" --target scree scree-element || exit 1
