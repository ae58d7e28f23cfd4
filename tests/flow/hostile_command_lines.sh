#!/usr/bin/env bash
# Tests bad command lines: each must give the documented exit code, one sentence on stderr, nothing on stdout, and leave
# no file behind.
# Usage: hostile_command_lines.sh GEARSHIFT SOURCE_FOLDER
set -u
gearshift=$1
source=$2
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
printf 'name = "x"\n' >nameless.toml
{ printf 'name = """two\nlines"""\n'; grep -v '^name' "$source/assets/gates/paper.toml"; } >two_lines.toml
head -c 64 /dev/zero >zeros.trace
printf '\x89GSTRC\r\n\xff\xff\xff\xff' >newer.trace
mkdir folder
touch empty

refuse() { # takes the expected exit code, a part of the error message, and the arguments of the program
  local code=$1 part=$2
  shift 2
  "$gearshift" "$@" >out 2>err </dev/null
  local got=$?
  if [ $got -ne "$code" ] || [ "$(wc -l <err)" -ne 1 ] || [ -s out ] || ! grep -qF -- "$part" err ||
     LC_ALL=C grep -q '[[:cntrl:]]' err; then
    echo "FAILED: gearshift $*: exit $got (wanted $code), wanted one line with \"$part\", got:"
    sed 's/^/    /' err out
    failed=$((failed + 1))
  else
    passed=$((passed + 1))
  fi
}

# If standard output is full, the program must report the error on stderr and with exit code 1.
for verb in "gate paper" "lesson hill_start" "tour --help"; do
  "$gearshift" $verb >/dev/full 2>err
  if [ $? -ne 1 ] || ! grep -q "standard output" err; then
    echo "FAILED: gearshift $verb >/dev/full"
    failed=$((failed + 1))
  else
    passed=$((passed + 1))
  fi
done

# If the error message cannot be printed, the exit code must still be right.
for way in '2>/dev/full' '2>&-' '>&- 2>&-' '<&- >&- 2>&-'; do
  for wanted in "2 tour --out t --rate 99" "1 gate no_such_gate" "2 fly"; do
    bash -c "\"\$@\" $way" - "$gearshift" ${wanted#* }
    got=$?
    if [ $got -ne "${wanted%% *}" ]; then
      echo "FAILED: gearshift ${wanted#* } $way: exit $got"
      failed=$((failed + 1))
    else
      passed=$((passed + 1))
    fi
  done
done

unset DISPLAY WAYLAND_DISPLAY
refuse 2 "--calibrate: the stick's name must not be empty" devices --calibrate ""
refuse 2 "--csv: the path must not be empty" bench --family feel --csv ""
refuse 2 "--out: the path must not be empty" campaign --out ""
refuse 2 "--shifts excludes --case" campaign --out c --case 5 --shifts 10
refuse 2 "?[31m" $'\e[31m'
refuse 2 "?[31m" tour --out t --rate $'\e[31m'
refuse 1 "?[31m" gate $'\e[31m'
refuse 2 'unknown verb "tuor"; did you mean tour?' tuor --out t
refuse 2 'unknown verb "xyz"; the verbs are train, demo, lesson, drive, tour, ' xyz --out t
refuse 2 'unknown option "--lerner"; did you mean --learner?' train --lerner Ada
refuse 2 'unknown verb "tran"; did you mean train?' help tran
refuse 2 'help takes one verb' help tour train
refuse 2 'unknown verb ""' ""
refuse 1 "no display"
refuse 1 "no display" train
DISPLAY=:987 WAYLAND_DISPLAY=wayland-0 refuse 1 "no display" train
refuse 1 "neither a file nor one of the shipped gates" train --offscreen t --gate nonesuch
refuse 1 "neither a file nor one of the shipped presets" train --offscreen t --preset nonesuch
refuse 1 "neither a file nor one of the shipped bindings" train --offscreen t --bindings nonesuch
refuse 2 "--hand strong" train --offscreen t --hand strong
refuse 2 "--hand bare" train --offscreen t --hand bare
refuse 2 "--camera" train --offscreen t --camera nowhere
refuse 2 "--size" train --offscreen t --size 10x10
refuse 2 "--seconds" train --offscreen t --seconds 0
refuse 1 "name" train --offscreen t --gate nameless.toml
refuse 2 "--out" demo
refuse 2 "--size" demo --out t --size big
refuse 2 "--samples" demo --out t --samples 2
refuse 2 "--film" demo --out t --film 100
refuse 2 "file is required" render
refuse 2 "--out" render nothing.glb
refuse 2 "--fov" render nothing.glb --out t.png --fov 179
refuse 1 "nothing.glb" render nothing.glb --out t.png
refuse 2 "fly" fly
refuse 2 "--speed" --speed 3
refuse 2 "lesson is required" lesson
refuse 1 "neither a file nor one of the shipped lessons" lesson nonesuch
refuse 2 "--fault" lesson hill_start --fault nothing
refuse 2 "--skill-error" lesson hill_start --skill-error 2
refuse 2 "--guidance" lesson hill_start --guidance nan
refuse 1 "which this gate does not have" lesson up_through_the_gears --gate four_speed
refuse 1 "no/such.trace" lesson hill_start --trace no/such.trace
refuse 2 "--out" tour
refuse 2 "--rate" tour --out t --rate 99
refuse 2 "--rate" tour --out t --rate 4001
refuse 2 "--rate" tour --out t --rate nan
refuse 2 "--rate" tour --out t --rate fast
refuse 2 "--rate" tour --out t --rate ""
refuse 2 "--hand" tour --out t --hand bare
refuse 2 "--hand" tour --out t --hand fist
refuse 2 "--hand" tour --out t --hand 1,2
refuse 2 "--hand" tour --out t --hand 1,2,3,4
refuse 2 "--hand" tour --out t --hand -1,2,300
refuse 2 "--hand" tour --out t --hand 0.1,inf,300
refuse 2 "mass_kg = 2000" tour --out t --hand 2000,1,300
refuse 2 "damping_n_s_per_m = 20000" tour --out t --hand 1,20000,300
refuse 2 "stiffness_n_per_m = 2000000" tour --out t --hand 1,1,2000000
refuse 2 "--seed" tour --out t --seed -1
refuse 2 "--seed" tour --out t --seed 1.5
refuse 2 "--seed" lesson moving_off --seed -1
refuse 2 "--seed" lesson moving_off --seed 99999999999999999999
refuse 2 "--seed" identify --seed -1
for number in 0 1e3 0x10 " 5" 5. 010 -1 "" 1000000001 9999999999999999999999; do
  refuse 2 "--shifts: \"$number\" is not a whole number from 1 to 1000000000" campaign --out c --shifts "$number"
  refuse 2 "--runs: \"$number\" is not a whole number from 1 to 1000000" lesson moving_off --runs "$number"
  refuse 2 "--threads: \"$number\" is not a whole number from 1 to 256" campaign --out c --shifts 1 --threads "$number"
  refuse 2 "--shift: \"$number\" is not a whole number from 1 to 1000000" train --replay x --shift "$number"
  refuse 2 "--window: \"$number\" is not a whole number from 1 to 64" stability --window "$number"
done
for number in 010 0x10 "5 "; do
  refuse 2 "--seed: \"$number\" is not a whole number from 0 to 999999999999999" campaign --out c --shifts 1 --seed "$number"
  refuse 2 "--delay: \"$number\" is not a whole number from 0 to 8" stability --delay "$number"
done
refuse 2 "--hand" tour --out t --hand fist --gate spaceship
refuse 1 "nameless.toml" tour --out t --gate nameless.toml
refuse 1 "two_lines.toml" tour --out t --gate two_lines.toml
refuse 1 "paper" tour --out t --gate spaceship
refuse 1 "empty" tour --out empty
refuse 1 "/proc" tour --out /proc/nowhere
refuse 2 "extra" tour --out t extra
refuse 2 "LAYOUT" gate
refuse 1 "paper" gate no_such_gate
refuse 1 "nameless.toml" gate nameless.toml
refuse 1 "two_lines.toml" gate two_lines.toml
refuse 2 "different files" gate ./nameless.toml --svg ./nameless.toml
refuse 1 "folder" gate folder
refuse 1 "empty" gate ./empty
refuse 1 "zeros.trace" gate zeros.trace
refuse 1 "/nowhere/x.svg" gate paper --svg /nowhere/x.svg
cp "$source/assets/gates/paper.toml" own.toml
ln own.toml other_name.svg
refuse 2 "different files" gate own.toml --svg other_name.svg
refuse 2 "different files" gate "$source/assets/gates/paper.toml" --svg "$source/./assets/gates/paper.toml"
cp "$source/assets/lessons/hill_start.toml" hill.toml
refuse 2 "different files" lesson ./hill.toml --trace hill.toml
refuse 2 "different files" lesson hill_start --gate own.toml --trace folder/../own.toml
ln -s new.db link.db
for own in new.db ./new.db link.db new.db-wal new.db-shm new.db-journal; do
  refuse 2 "different files" lesson hill_start --learner A --database new.db --trace $own
done
mkdir gone && cd gone && rmdir ../gone
message=$({ "$gearshift" lesson hill_start --trace x.trace >/dev/null; } 2>&1)
cd ..
grep -q '^gearshift: x.trace: .* (No such file or directory)$' <<<"$message" ||
  { echo "FAILED: where the working folder is gone: $message"; failed=$((failed + 1)); }
cp "$source/assets/models/gearbox.glb" box.glb
refuse 2 "different files" render box.glb --out folder/../box.glb
python3 - <<'TEXTURED' # a triangle whose buffer and texture are in the same folder
import json, struct, zlib
def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
open("triangle.bin", "wb").write(struct.pack("<9f6f", 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1))
open("skin.png", "wb").write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 1, 1, 8, 2, 0, 0, 0)) +
                             chunk(b"IDAT", zlib.compress(b"\0\xff\x80\0")) + chunk(b"IEND", b""))
json.dump({"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}],
           "buffers": [{"byteLength": 60, "uri": "triangle.bin"}], "images": [{"uri": "skin.png"}],
           "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 24}],
           "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                          "min": [0, 0, 0], "max": [1, 1, 0]},
                         {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"}],
           "textures": [{"source": 0}], "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
           "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0}]}]},
          open("triangle.gltf", "w"))
TEXTURED
cp triangle.bin triangle.bin.kept
cp skin.png skin.png.kept
refuse 1 "would overwrite" render triangle.gltf --out folder/../triangle.bin
refuse 1 "would overwrite" render triangle.gltf --out skin.png
for one in triangle.bin skin.png; do cmp $one $one.kept || failed=$((failed + 1)); done
refuse 2 "different files" stability --svg both --csv ./both
refuse 2 "different files" bench --family plant --out t --csv t/bench.csv
refuse 2 "different files" bench --family plant --out folder --csv folder/../folder/bench.html
refuse 2 "different files" bench --family plant --out t --csv t/plant.svg
ln -s map both
refuse 2 "different files" stability --svg both --csv map
long=$(printf 'x%.0s' {1..300})
refuse 1 "cannot be written" stability --svg "$long.svg" --csv "$long.csv"
for one in "own.toml gates/paper.toml" "hill.toml lessons/hill_start.toml" "box.glb models/gearbox.glb"; do
  cmp ${one% *} "$source/assets/${one#* }" || failed=$((failed + 1))
done
refuse 2 "required" replay
refuse 1 "missing.trace" replay missing.trace
refuse 1 "zeros.trace" replay zeros.trace
refuse 1 "newer" replay newer.trace
refuse 1 "empty" replay empty
refuse 1 "folder" replay folder
refuse 2 "--again requires --calibrate or --controls" devices --again
refuse 2 "--controls" devices --controls --calibrate stick
refuse 1 "no wheel, pedals, lever or shifter that needs setting up is plugged in" devices --controls
refuse 2 "--calibrate" devices --json --calibrate stick
refuse 2 "--seconds" tour --out t --seconds 5
refuse 2 "--seconds" tour --out t --device stick --seconds 0
refuse 2 "--hand" tour --out t --device stick --hand grip
refuse 2 "--device" train --offscreen t --device stick
refuse 1 "no display" train --device stick
refuse 2 "--out" campaign
refuse 2 "--shifts" campaign --out t --shifts 0
refuse 2 "--case" campaign --out t --case first
refuse 1 "/proc" campaign --out /proc/nowhere
refuse 2 "--family" bench --family luck
refuse 2 "--block" bench --block 0
refuse 2 "--block" bench --block x
refuse 1 "nameless.toml/x" bench --family plant --out nameless.toml/x
refuse 1 "/nowhere/x.csv" bench --family plant --csv /nowhere/x.csv

for left in t c; do
  [ -e "$left" ] && { echo "FAILED: $left was left behind"; failed=$((failed + 1)); }
done
finish
