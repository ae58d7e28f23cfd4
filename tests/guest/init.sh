#!/bin/busybox sh
# First process of the guest: loads the kernel modules, then runs the programs listed in /tests, in order. The last line
# of output reports the result.
b=/bin/busybox
$b mount -t proc proc /proc
$b mount -t sysfs sys /sys
$b mount -t devtmpfs dev /dev
$b mount -t tmpfs tmp /tmp
$b ifconfig lo up
failed=0
while read -r module; do $b insmod "/modules/$module.ko" || failed=1; done </modules/order
while read -r program; do
  echo "== $program"
  LD_LIBRARY_PATH=/libraries $program || failed=1
done </tests
[ $failed = 0 ] || $b dmesg | $b tail -n 60
echo "GUEST rc=$failed after $($b cut -d ' ' -f 1 /proc/uptime) s"
$b reboot -f
