#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# sh tests/debian13.sh [FOLDER [PART...]]: in a Debian 13 of its own, made in FOLDER (build-debian13) or found there from the last time:
#   quickstart   packages, build, first run
#   tests        quick tests
#   package      cpack -G DEB; the package is installed and runs the quick start's case in another Debian 13, which has nothing else
# Without PART all of these. Ends with 1 if a part fails, and with 77 if it did not run. Needs root, debootstrap and 12 GB.
# Another mirror or Debian: MIRROR=http://... SUITE=bookworm sh tests/debian13.sh FOLDER quickstart

source=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd) || exit 1
mirror=${MIRROR:-http://deb.debian.org/debian}
suite=${SUITE:-trixie}

did_not_run()
{
  echo "Debian $suite: DID NOT RUN, $1"
  exit 77
}

[ "$(id -u)" -eq 0 ] || did_not_run "since a root folder is made by root only."
command -v debootstrap >/dev/null || did_not_run "since there is no debootstrap (apt-get install debootstrap)."
# Mounts of its own, which end with it: whoever deletes FOLDER then deletes nothing of this machine.
if [ -z "$SCREE_OWN_MOUNTS" ]; then
  unshare --mount true 2>/dev/null || did_not_run "since it may not mount anything."
  SCREE_OWN_MOUNTS=yes exec unshare --mount sh "$0" "$@"
fi
folder=${1:-$source/build-debian13}
[ $# -eq 0 ] || shift
parts=${*:-quickstart tests package}
mkdir -p "$folder" && folder=$(cd "$folder" && pwd) || exit 1
root=$folder/root
clean=$folder/clean
if [ ! -f "$folder/is_made" ]; then
  rm -rf "$folder/system" "$root"
  debootstrap --variant=minbase "$suite" "$folder/system" "$mirror" >"$folder/debootstrap.log" 2>&1 ||
    did_not_run "since debootstrap found no $suite at $mirror: $(tail -n 1 "$folder/debootstrap.log")"
  # A folder to throw away: nothing waits for the disk.
  echo force-unsafe-io >"$folder/system/etc/dpkg/dpkg.cfg.d/unsafe"
  cp -a "$folder/system" "$root" && touch "$folder/is_made" || exit 1
fi

# use_machine ROOT: its way to the mirror is that of this machine, and so are its devices.
use_machine()
{
  cp -L /etc/resolv.conf /etc/hosts "$1/etc/"
  apt-config dump | grep -E '^Acquire::(http|https|Check|Retries)' >"$1/etc/apt/apt.conf.d/90machine"
  for mounted in proc sys dev dev/shm; do
    mount --bind "/$mounted" "$1/$mounted" || did_not_run "since /$mounted cannot be mounted in the root."
  done
}
use_machine "$root"
chroot "$root" apt-get -o APT::Update::Error-Mode=any -o Acquire::Retries=0 update >"$folder/update.log" 2>&1 ||
  did_not_run "since the packages at $mirror cannot be reached: $(tail -n 1 "$folder/update.log")"
# What an interrupted run has left.
chroot "$root" sh -c 'dpkg --configure -a && apt-get -y -f install' >"$folder/repair.log" 2>&1

# What git knows, as it lies here, and nothing that it knew the last time; built files stay.
mkdir -p "$root/scree"
find "$root/scree" -mindepth 1 -maxdepth 1 ! -name 'build*' -exec rm -rf {} +
git -C "$source" ls-files -z | (cd "$source" && tar --null --files-from=- -c) | tar -x -C "$root/scree" || exit 1

failed=0
# part NAME ROOT COMMAND: a command of the shell in ROOT, in the environment of a fresh login; what it says is in FOLDER/NAME.log.
part()
{
  begin=$(date +%s)
  if chroot "$2" env -i HOME=/root LANG=C.UTF-8 PATH=/usr/sbin:/usr/bin:/sbin:/bin ${CI:+CI="$CI"} sh -ec "$3" >"$folder/$1.log" 2>&1; then
    state=passed
  else
    # Packages that cannot be downloaded are no fault of Scree.
    ! tail -n 5 "$folder/$1.log" | grep -q '^E: .*[Ff]etch' || did_not_run "since packages cannot be downloaded: $folder/$1.log"
    state=FAILED
    failed=1
    tail -n 30 "$folder/$1.log"
  fi
  echo "Debian $suite, $1: $state after $(($(date +%s) - begin)) s ($folder/$1.log)"
}

for name in $parts; do
  [ "$failed" -eq 0 ] || break
  case $name in
    quickstart)
      part quickstart "$root" 'sh /scree/doc/quickstart.sh; /scree/build/scree --version'
      ;;
    tests)
      part tests "$root" 'sh /scree/tests/run.sh'
      grep 'tests passed' "$folder/tests.log"
      ;;
    package)
      part package "$root" 'DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends dpkg-dev file
        cd /scree
        cmake --preset package
        cmake --build --preset package --target scree scree-element
        cd build-package
        rm -f scree_*.deb
        cpack -G DEB'
      [ "$failed" -eq 0 ] || break
      rm -rf "$clean"
      cp -a "$folder/system" "$clean" && use_machine "$clean" && cp "$root"/scree/build-package/scree_*.deb "$clean/tmp/" || exit 1
      # Nobody needs a compiler or headers to run it, nor to be root.
      # shellcheck disable=SC2016  # for dpkg-query
      part installed "$clean" 'apt-get update
        DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends /tmp/scree_*.deb
        du -ch /tmp/scree_*.deb
        dpkg-query -W -f "\${Depends}\n" scree
        if dpkg-query -W -f "\${Depends}" scree | grep -e "-dev"; then exit 1; fi
        useradd --create-home somebody
        su - somebody -c "scree --version && mpirun --oversubscribe -np 2 scree /usr/share/scree/prm/quickstart.prm &&
          scree-render results/quickstart --field plastic_shear_strain && scree-element /usr/share/scree/prm/element/oedometer.prm"'
      ;;
    *)
      echo "Debian 13: there is no part $name." >&2
      exit 1
      ;;
  esac
done
exit "$failed"
