#!/usr/bin/env bash
# Tests pictures of any glTF file: sizes, samples, cameras, stereo. Broken files and arguments must give one error.
# Usage: render.sh GEARSHIFT SOURCE_FOLDER
set -u
gearshift=$1
models=$2/assets/models
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
unset DISPLAY WAYLAND_DISPLAY
export GEARSHIFT_VALIDATION=1 XDG_CACHE_HOME=$work/cache XDG_RUNTIME_DIR=$work/runtime
mkdir -m 700 runtime

render() { # takes the picture file and the arguments
  local picture=$1
  shift
  "$gearshift" render "$@" --out "$picture" >"$picture.txt" 2>"$picture.err" && is_png "$picture" && [ ! -s "$picture.err" ]
}
size_of() { od -An -t u1 -j 16 -N 8 "$1" | awk '{print $3*256+$4 "x" $7*256+$8}'; }
refused() { # takes the expected exit code, a part of the error message, and the arguments of the program
  local code=$1 sentence=$2
  shift 2
  "$gearshift" render "$@" >refused.txt 2>refused.err
  [ $? = "$code" ] && [ "$(wc -l <refused.err)" = 1 ] && grep -qE -- "$sentence" refused.err
}
alike() { # takes two pictures and an RMS difference; succeeds if theirs is smaller
  [ "$(compare -metric RMSE "$1" "$2" null: 2>&1 | sed "s/.*(\(.*\))/\1/" | awk "{print (\$1 < $3)}")" = 1 ]
}
not_alike() { ! alike "$@"; }

cabin=$models/cabin.glb
check "the cabin from the driver's eye" render driver.png "$cabin" --camera driver --size 320x180
check "its size" [ "$(size_of driver.png)" = 320x180 ]
check "one sample" render one.png "$cabin" --camera driver --size 320x180 --samples 1
check "stereo" render stereo.png "$cabin" --camera driver --size 320x180 --stereo
check "from a point to a point" render point.png "$cabin" --camera 0,0.6,0.1:0.3,0,-0.3 --size 64x64
for model in "$models"/*.glb; do
  check "$(basename "$model")" render "$(basename "$model").png" "$model" --size 160x120
done

# A cube of any size must fill the same fraction of the picture when the camera is fitted to the cube.
cube() { # edge in metres
  python3 - "$1" <<'END'
import base64, json, struct, sys
half = float(sys.argv[1]) / 2
corners = [(x * half, y * half, z * half) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
indices = [i for a, b, c, d in faces for i in (a, b, c, a, c, d)]
points = b"".join(struct.pack("<3f", *corner) for corner in corners)
data = points + struct.pack("<36H", *indices)
json.dump({
    "asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
    "accessors": [
        {"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3", "min": [-half] * 3, "max": [half] * 3},
        {"bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR"}],
    "bufferViews": [{"buffer": 0, "byteLength": 96}, {"buffer": 0, "byteOffset": 96, "byteLength": 72}],
    "buffers": [{"byteLength": 168,
                 "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}]}, sys.stdout)
END
}
for edge in 1 0.05 0.01; do
  cube $edge >"cube_$edge.gltf"
  check "a cube of $edge m" render "cube_$edge.png" "cube_$edge.gltf" --size 96x96
done
check "the cube of 5 cm looks like that of 1 m: no corner is clipped" alike cube_0.05.png cube_1.png 0.01
check "the cube of 1 cm, too, except for the grain of its shadow" alike cube_0.01.png cube_1.png 0.08
check "the cube of 1 m from afar" render afar.png cube_1.gltf --size 96x96 --camera 3,3,5:0,0,0
check "which differs, as the comparison notices" not_alike afar.png cube_1.png 0.08

# The cube of 5 cm, skinned to one joint that scales it by twenty and moves it away.
python3 - >skinned.gltf <<'END'
import base64, json, struct
model = json.load(open("cube_0.05.gltf"))
more = bytes(4 * 8) + struct.pack("<4f", 1, 0, 0, 0) * 8
start = model["buffers"][0]["byteLength"]
data = base64.b64decode(model["buffers"][0]["uri"].split(",")[1]) + more
model["buffers"][0] = {"byteLength": len(data),
                       "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}
model["bufferViews"] += [{"buffer": 0, "byteOffset": start, "byteLength": 32},
                         {"buffer": 0, "byteOffset": start + 32, "byteLength": 128}]
model["accessors"] += [{"bufferView": 2, "componentType": 5121, "count": 8, "type": "VEC4"},
                       {"bufferView": 3, "componentType": 5126, "count": 8, "type": "VEC4"}]
model["meshes"][0]["primitives"][0]["attributes"] |= {"JOINTS_0": 2, "WEIGHTS_0": 3}
model["nodes"] = [{"mesh": 0, "skin": 0}, {"translation": [3, 1, 0], "scale": [20, 20, 20]}]
model["skins"] = [{"joints": [1]}]
model["scenes"] = [{"nodes": [0, 1]}]
print(json.dumps(model))
END
check "a skinned cube" render skinned.png skinned.gltf --size 96x96
check "it fits where its joint places it" alike skinned.png cube_1.png 0.01
sed 's/"primitives": \[{/"primitives": [{"mode": 1, /' skinned.gltf >skinned_lines.gltf
reports_only_lines() { "$gearshift" render skinned_lines.gltf --size 96x96 --out lines.png 2>&1 | grep -q "not drawn: lines" && is_png lines.png; }
check "a skin with only lines is named and not drawn" reports_only_lines
check "an odd width for two eyes is rejected" refused 2 "width must be even" cube_1.gltf --out x.png --stereo --size 161x91

printf 'glTF' >short.glb
printf '{"asset":{"version":"2.0"},"extensionsRequired":["EXT_nobody_knows"]}' >required.gltf
check "no such file" refused 1 "nothing.glb" nothing.glb --out x.png
check "a folder" refused 1 "." . --out x.png
check "a short file" refused 1 "short.glb" short.glb --out x.png
check "an unknown required extension" refused 1 "EXT_nobody_knows" required.gltf --out x.png
check "an unknown camera names them all" refused 2 "driver.*lever.*gate" "$cabin" --out x.png --camera nowhere
check "a camera of five numbers" refused 2 "X,Y,Z:X,Y,Z" "$cabin" --out x.png --camera 0,0,0:1,1
check "a camera whose target is its position" refused 2 "X,Y,Z:X,Y,Z" "$cabin" --out x.png --camera 0,0,0:0,0,0
check "a picture that cannot be written" refused 1 "/nonesuch/x.png" "$cabin" --out /nonesuch/x.png --size 64x64
check "no file was written" [ ! -e x.png ]
finish
