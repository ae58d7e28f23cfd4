#!/usr/bin/env bash
# Any glTF file as a picture: sizes, samples, cameras, stereo; broken files and arguments in one sentence.
# Usage: render.sh GEARSHIFT SOURCE_FOLDER
set -u
gearshift=$1
models=$2/assets/models
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
unset DISPLAY WAYLAND_DISPLAY
export GEARSHIFT_VALIDATION=1 XDG_CACHE_HOME=$work/cache XDG_RUNTIME_DIR=$work/runtime
mkdir -m 700 runtime

render() { # picture, arguments ...
  local picture=$1
  shift
  "$gearshift" render "$@" --out "$picture" >"$picture.txt" 2>"$picture.err" && is_png "$picture" && [ ! -s "$picture.err" ]
}
size_of() { od -An -t u1 -j 16 -N 8 "$1" | awk '{print $3*256+$4 "x" $7*256+$8}'; }
refused() { # sentence, arguments ...
  local sentence=$1
  shift
  "$gearshift" render "$@" >refused.txt 2>refused.err && return 1
  [ "$(wc -l <refused.err)" = 1 ] && grep -qE -- "$sentence" refused.err
}

cabin=$models/cabin.glb
check "the cabin from the driver's eye" render driver.png "$cabin" --camera driver --size 320x180
check "its size" [ "$(size_of driver.png)" = 320x180 ]
check "one sample" render one.png "$cabin" --camera driver --size 320x180 --samples 1
check "stereo" render stereo.png "$cabin" --camera driver --size 320x180 --stereo
check "from a point to a point" render point.png "$cabin" --camera 0,0.6,0.1:0.3,0,-0.3 --size 64x64
for model in "$models"/*.glb; do
  check "$(basename "$model")" render "$(basename "$model").png" "$model" --size 160x120
done

printf 'glTF' >short.glb
printf '{"asset":{"version":"2.0"},"extensionsRequired":["EXT_nobody_knows"]}' >required.gltf
check "no such file" refused "nothing.glb" nothing.glb --out x.png
check "a folder" refused "." . --out x.png
check "a short file" refused "short.glb" short.glb --out x.png
check "an unknown required extension" refused "EXT_nobody_knows" required.gltf --out x.png
check "an unknown camera names them all" refused "driver.*lever.*gate" "$cabin" --out x.png --camera nowhere
check "a camera of five numbers" refused "X,Y,Z:X,Y,Z" "$cabin" --out x.png --camera 0,0,0:1,1
check "a camera that looks at itself" refused "X,Y,Z:X,Y,Z" "$cabin" --out x.png --camera 0,0,0:0,0,0
check "a picture that cannot be written" refused "/nonesuch/x.png" "$cabin" --out /nonesuch/x.png --size 64x64
check "nothing was written" [ ! -e x.png ]
finish
