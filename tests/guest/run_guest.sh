#!/usr/bin/env bash
# Boots Debian's kernel in QEMU and runs programs there.
# Usage: run_guest.sh FOLDER SOURCES "PROGRAM [ARGUMENT...]"...
# FOLDER caches the kernel, which is downloaded once, and the initial file system. SOURCES is the folder that contains
# tests/data and assets.
set -euo pipefail
folder=$1 sources=$2
shift 2
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
modules=(usb-common usbcore usbip-core vhci-hcd hid usbhid hid-generic evdev uinput)
mkdir -p "$folder"
cd "$folder"

get_kernel() { # downloads the kernel's package and extracts vmlinuz and the modules to kernel/
  local package new
  package=$(apt-cache depends linux-image-amd64 | awk '/Depends: linux-image/ { print $2; exit }')
  [ -n "$package" ] || { echo "No package linux-image-amd64 is known: apt-get update" >&2; return 1; }
  new=$(mktemp -d kernel.XXXXXX)
  (cd "$new" && apt-get download -qq "$package" 2>/dev/null) || { echo "$package cannot be downloaded" >&2; return 1; }
  mkdir "$new/package"
  dpkg-deb --fsys-tarfile "$new"/*.deb |
    tar -x -C "$new/package" --wildcards './boot/vmlinuz-*' '*/kernel/drivers/usb/*' '*/kernel/drivers/hid/*' '*/kernel/drivers/input/*'
  mv "$new"/package/boot/vmlinuz-* "$new/vmlinuz"
  find "$new/package" -name '*.ko.xz' -exec unxz {} + # Debian 13 compresses its modules
  for module in "${modules[@]}"; do mv "$(find "$new/package" -name "$module.ko")" "$new/"; done
  rm -rf "$new"/*.deb "$new/package"
  mv "$new" kernel
}
[ -f kernel/vmlinuz ] || get_kernel

copy_program() { # PROGRAM [ARGUMENT...]: copies the program and its libraries, and adds its command line to root/tests
  cp "$1" "root/$(basename "$1")"
  echo "/$(basename "$1") ${*:2}" >>root/tests
  local library
  while read -r library; do cp -L -n "$library" root/libraries/; done < <(ldd "$1" | awk '$2 == "=>" { print $3 }')
  library=$(ldd "$1" | awk '$1 ~ /ld-linux/ { print $1 }')
  mkdir -p "root$(dirname "$library")"
  cp -L -n "$library" "root$library"
}

rm -rf root
mkdir -p root/{bin,proc,sys,dev,tmp,modules,libraries} "root$sources/tests/data" "root$sources/assets"
cp "$(command -v busybox)" root/bin/busybox
cp "$here/init.sh" root/init
chmod +x root/init
for module in "${modules[@]}"; do cp "kernel/$module.ko" root/modules/; echo "$module"; done >root/modules/order
cp -r "$sources/tests/data/hid" "root$sources/tests/data/"
cp -r "$sources"/assets/{gates,presets,cars} "root$sources/assets/"
: >root/tests
for program in "$@"; do copy_program $program; done  # unquoted, to split it into words
(cd root && find . | busybox cpio -o -H newc 2>/dev/null | gzip -1) >initrd

# The guest's clock advances by one nanosecond per instruction and skips idle time. A millisecond in the guest is
# therefore independent of the speed of the emulating machine.
timeout 1200 qemu-system-x86_64 -accel tcg -icount shift=0,sleep=off -rtc clock=vm -cpu max -smp 1 -m 512 \
  -nographic -nodefaults -serial stdio -no-reboot -kernel kernel/vmlinuz -initrd initrd \
  -append "console=ttyS0 loglevel=3 panic=-1 mitigations=off" </dev/null | tee log
grep -q "^GUEST rc=0" log
