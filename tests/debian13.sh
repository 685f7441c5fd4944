#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# sh tests/debian13.sh [FOLDER]: packages, build, quick start and quick tests in a Debian 13 of its own, made in FOLDER (build-debian13)
# or found there from the last time. Ends with 1 if a part fails, and with 77 if it did not run. Needs root, debootstrap and 8 GB.
# The mirror can be set: MIRROR=http://... sh tests/debian13.sh

source=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd) || exit 1
folder=${1:-$source/build-debian13}
mirror=${MIRROR:-http://deb.debian.org/debian}

did_not_run()
{
  echo "Debian 13: DID NOT RUN, $1"
  exit 77
}

[ "$(id -u)" -eq 0 ] || did_not_run "since a root folder is made by root only."
command -v debootstrap >/dev/null || did_not_run "since there is no debootstrap (apt-get install debootstrap)."
# Mounts of its own, which end with it: whoever deletes FOLDER then deletes nothing of this machine.
if [ -z "$SCREE_OWN_MOUNTS" ]; then
  unshare --mount true 2>/dev/null || did_not_run "since it may not mount anything."
  SCREE_OWN_MOUNTS=yes exec unshare --mount sh "$0" "$@"
fi
mkdir -p "$folder" && folder=$(cd "$folder" && pwd) || exit 1
root=$folder/root
if [ ! -f "$folder/is_made" ]; then
  debootstrap --variant=minbase trixie "$root" "$mirror" >"$folder/debootstrap.log" 2>&1 ||
    did_not_run "since debootstrap found no Debian 13 at $mirror: $(tail -n 1 "$folder/debootstrap.log")"
  # A folder to throw away: nothing waits for the disk.
  echo force-unsafe-io >"$root/etc/dpkg/dpkg.cfg.d/unsafe"
  touch "$folder/is_made"
fi

# The way to the mirror is that of this machine.
cp -L /etc/resolv.conf /etc/hosts "$root/etc/"
apt-config dump | grep -E '^Acquire::(http|https|Check|Retries)' >"$root/etc/apt/apt.conf.d/90machine"
for mounted in proc sys dev dev/shm; do
  mount --bind "/$mounted" "$root/$mounted" || did_not_run "since /$mounted cannot be mounted in the root."
done
# What an interrupted run has left.
chroot "$root" sh -c 'dpkg --configure -a && apt-get -y -f install' >"$folder/repair.log" 2>&1

# What git knows, as it lies here; built files of the last time stay.
mkdir -p "$root/scree"
git -C "$source" ls-files -z | (cd "$source" && tar --null --files-from=- -c) | tar -x -C "$root/scree" || exit 1

failed=0
# part NAME SCRIPT: in the root, with the environment of a fresh login; what it says is in FOLDER/NAME.log.
part()
{
  begin=$(date +%s)
  if chroot "$root" env -i HOME=/root LANG=C.UTF-8 PATH=/usr/sbin:/usr/bin:/sbin:/bin ${CI:+CI="$CI"} sh "/scree/$2" >"$folder/$1.log" 2>&1; then
    state=passed
  else
    state=FAILED
    failed=1
    tail -n 30 "$folder/$1.log"
  fi
  echo "Debian 13, $1: $state after $(($(date +%s) - begin)) s ($folder/$1.log)"
}
part quickstart doc/quickstart.sh
chroot "$root" /scree/build/scree --version
[ "$failed" -eq 1 ] || part tests tests/run.sh
grep 'tests passed' "$folder/tests.log" 2>/dev/null
exit "$failed"
