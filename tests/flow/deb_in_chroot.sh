#!/usr/bin/env bash
# Builds the Debian package in a fresh Debian, and checks it with lintian. Then tests it in another fresh Debian: it
# installs with its dependencies, an ordinary user without a display can run the demo, and purging leaves nothing
# behind. Afterwards, the package is in out/RELEASE. ./test --full runs this test. It takes some minutes for each
# release, and needs what tests/in_debian needs.
# Usage: deb_in_chroot.sh [RELEASE...], e.g. deb_in_chroot.sh bookworm trixie; by default, this machine's release
set -eu
flows=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
cd "$flows/../.."

if [ "${1:-}" != --inside ]; then
  [ $# -gt 0 ] || set -- "$(sed -n 's/^VERSION_CODENAME=//p' /etc/os-release)"
  for release in "$@"; do
    rm -f out/"$release"/gearshift_*.deb
    tests/in_debian "$release" bash -ec '
      .ci/install run package lintian
      cmake --preset release >/dev/null
      cmake --build --preset release --target package -- --quiet
      mkdir out
      mv build/release/gearshift_*.deb out
      lintian --fail-on error,warning out/gearshift_*.deb'
    tests/in_debian "$release" tests/flow/deb_in_chroot.sh --inside <"$(ls out/"$release"/gearshift_*.deb)"
  done
  exit
fi

set +e
cat >/var/tmp/gearshift.deb
source_folder=$PWD
source "$flows/checks.sh"
install_package() {
  sudo apt-get update -qq >update.txt 2>&1 || { tail -n 5 update.txt; return 1; }
  sudo apt-get install -y -qq --no-install-recommends /var/tmp/gearshift.deb >install.txt 2>&1 ||
    { tail -n 5 install.txt; return 1; }
}
is_left() { # prints the package's remaining files, without the user's files
  sudo find /usr /etc /lib /var/lib /var/cache -xdev -iname "*gearshift*" | grep -v "/var/lib/apt/" | grep .
}
fails() { ! "$@"; }

check "no file of the package exists before" fails is_left
check "the package installs" install_package
check "dpkg finds every file unchanged" dpkg --verify gearshift
gearshift --version >version.txt
package_version=$(dpkg-query -W -f '${Version}' gearshift)
check "the version is that of the package, before the +" grep -qx "gearshift ${package_version%+*}" version.txt
check "the commit is that of the source" grep -qE "^commit [0-9a-f]{12}$" version.txt
check "no library is missing" fails grep -q "not found" <(ldd /usr/bin/gearshift)
check "the program does not contain paths of the build machine" fails grep -aqF "$source_folder/" /usr/bin/gearshift
demo() { gearshift demo --out demo >demo.txt 2>demo.err || { tail -n 2 demo.err; return 1; }; }
check "a user runs the demo" demo
check "without output on stderr" test ! -s demo.err
check "the demo's page exists" test -s demo/index.html
check "its pictures exist" is_png demo/contact_sheet.png
check "its plots exist" is_png demo/trajectory.png
check "purged" sudo apt-get purge -y -qq gearshift >purge.txt 2>&1
check "nothing is left" fails is_left
cat version.txt
tail -n 3 demo.txt
finish
