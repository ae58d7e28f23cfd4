#!/usr/bin/env bash
# Tests the Debian package in a fresh Debian 12: it installs with its dependencies, an ordinary user without a display
# can run the demo, and purging leaves nothing behind. ./test --full runs this test. It takes some minutes. To run it by
# hand, as root and with a network:
#   cmake --preset release && cmake --build --preset release --target package
#   tests/flow/deb_in_chroot.sh build/release/gearshift_*.deb
# Usage: deb_in_chroot.sh PACKAGE
set -u
command -v debootstrap >/dev/null || { echo "deb_in_chroot.sh: debootstrap is missing: apt-get install debootstrap" >&2; exit 2; }
# The script restarts itself with private mounts, which disappear when it ends.
[ "$1" = --in-own-mounts ] || exec unshare --mount "$0" --in-own-mounts "$1"
shift
package=$(realpath "$1")
flows=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$flows/checks.sh"
root=$(mktemp -d -p /var/tmp)
chmod 755 "$root"
end_all() {
  local place
  for place in proc sys dev; do umount -R "$root/$place" 2>/dev/null; done
  rm -rf --one-file-system "$root"
}

inside() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive "$@"; }
as_user() { inside setpriv --reuid=1000 --regid=1000 --clear-groups env HOME=/home/user LANG=C.UTF-8 "$@"; }
bring_up() { # installs a minimal Debian in $root; copies this machine's package sources and the package file into it
  debootstrap --variant=minbase bookworm "$root" >debootstrap.txt 2>&1 || { tail -n 5 debootstrap.txt; return 1; }
  local place
  for place in proc sys dev; do mount --rbind "/$place" "$root/$place" || return 1; done
  cp -r /etc/apt/sources.list* /etc/apt/apt.conf.d /etc/apt/trusted.gpg.d "$root/etc/apt/"
  cp /etc/resolv.conf /etc/hosts "$root/etc/"
  cp "$package" "$root/var/tmp/gearshift.deb"
  chmod 644 "$root/var/tmp/gearshift.deb"
  inside useradd --create-home --uid 1000 user
  inside apt-get update -qq >update.txt 2>&1 || { tail -n 5 update.txt; return 1; }
}
install_package() {
  inside apt-get install -y -qq --no-install-recommends /var/tmp/gearshift.deb >install.txt 2>&1 ||
    { tail -n 5 install.txt; return 1; }
}
is_left() { # prints the package's remaining files, without the user's files
  find "$root/usr" "$root/etc" "$root/lib" "$root/var/lib" "$root/var/cache" -xdev -iname "*gearshift*" |
    grep -v "/var/lib/apt/" | grep .
}
fails() { ! "$@"; }

check "a bare Debian 12" bring_up
check "no file of the package exists before" fails is_left
check "the package installs" install_package
check "dpkg finds every file unchanged" inside dpkg --verify gearshift
as_user gearshift --version >version.txt
check "the version is that of the package" grep -q "^gearshift $(dpkg-deb -f "$package" Version)$" version.txt
check "no library is missing" fails grep -q "not found" <(inside ldd /usr/bin/gearshift)
check "the program does not contain paths of the build machine" fails grep -aqF "$(cd "$flows/../.." && pwd)/" "$root/usr/bin/gearshift"
demo() { as_user gearshift demo --out /tmp/demo >demo.txt 2>demo.err || { tail -n 2 demo.err; return 1; }; }
check "a user runs the demo" demo
check "without output on stderr" test ! -s demo.err
check "the demo's page exists" test -s "$root/tmp/demo/index.html"
check "its pictures exist" is_png "$root/tmp/demo/contact_sheet.png"
check "its plots exist" is_png "$root/tmp/demo/trajectory.png"
check "purged" inside apt-get purge -y -qq gearshift >purge.txt 2>&1
check "nothing is left" fails is_left
cat version.txt
tail -n 3 demo.txt
finish
