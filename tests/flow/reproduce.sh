#!/usr/bin/env bash
# Tests the paper's figures from one command: the complete page; some sections with their files; errors before any
# folder is made. A preset with 5 % more mass must change Figs 4, 8 and 9.
# Usage: reproduce.sh GEARSHIFT SOURCE_FOLDER
set -u
gearshift=$1
presets=$2/assets/presets
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"

reproduce() { # takes the output folder and the arguments
  local folder=$1
  shift
  "$gearshift" reproduce --out "$folder" "$@" >"$folder.txt" 2>"$folder.err"
}
refuses() { # takes the exit code and the arguments
  local code=$1
  shift
  reproduce refused "$@"
  [ $? -eq "$code" ] && [ ! -e refused ] && [ "$(wc -l <refused.err)" -eq 1 ]
}
is_svg() { grep -q "</svg>" "$1"; }
differs() { ! cmp -s "whole/$1" "heavier/$1"; }
has_units() { head -n 1 "$1" | grep -qE '_(mm|deg|n|hz|s|gw|raw|1)(,|$)'; }

# Checks that every picture, link and table named on the page exists, and that every opened tag is closed.
page_is_complete() {
  [ -s "$1/index.html" ] || return 1
  local link
  for link in $(grep -oE '(src|href)="[^#"][^"]*"' "$1/index.html" | cut -d '"' -f 2); do
    [ -s "$1/$link" ] || { echo "$1: no $link"; return 1; }
  done
  local tag
  for tag in section h2 p table tr td th figure figcaption nav ol li a style html body head; do
    [ "$(grep -oE "<$tag[ >]" "$1/index.html" | wc -l)" -eq "$(grep -o "</$tag>" "$1/index.html" | wc -l)" ] ||
      { echo "$1: <$tag> does not close"; return 1; }
  done
}

check "the whole page" reproduce whole
check "nothing on stderr if nothing is limited" [ ! -s whole.err ]
check "the page names the existing files" page_is_complete whole
check "thirteen sections" [ "$(grep -c '<section' whole/index.html)" -eq 13 ]
order_of() { grep -oE '<section id="[a-z_]+' "$1/index.html" | cut -d '"' -f 2 | tr '\n' ' '; }
check "in the order of the paper" [ "$(order_of whole)" = \
  "workspace force_map calibration bode table elements deferred_force over_push oscillation rate gate wall tour " ]
for picture in whole/*.png; do check "$picture is a picture" is_png "$picture"; done
for picture in whole/*.svg; do check "$picture is complete" is_svg "$picture"; done
for table in whole/*.csv; do
  case $table in */table_2.csv) continue ;; esac
  check "units in the header of $table" has_units "$table"
done

# The same preset must give the same figures; a preset with a different mass must give different figures.
figures=(bode_x bode_y wall tour)
check "a page of three sections" reproduce again --only tour bode wall
check "it has no other sections" [ "$(grep -c '<section' again/index.html)" -eq 3 ]
for name in "${figures[@]}"; do check "$name again" cmp -s "whole/$name.csv" "again/$name.csv"; done
sed 's/^mass_kg = 0.095/mass_kg = 0.09975/; s/^mass_kg = 0.086/mass_kg = 0.0903/' "$presets/default.toml" >heavier.toml
check "a heavier lever" reproduce heavier --preset heavier.toml --only tour bode wall
for name in "${figures[@]}"; do
  check "$name of the heavier lever" [ -s "heavier/$name.csv" ]
  check "5 % of mass changes $name" differs "$name.csv"
done

sed 's/^name = .*/name = "<b>\&\\""/' "$presets/default.toml" >markup.toml
check "a name with markup" reproduce markup --preset markup.toml --only table
check "the markup is only text" grep -qF '&lt;b&gt;&amp;&quot;' markup/index.html
check "the paper's own wall" reproduce paper --preset paper --only gate

# A section that fails must not affect the others.
sed 's/^coulomb_friction_n = .*/coulomb_friction_n = 20/' "$presets/default.toml" >stuck.toml
reproduce stuck --preset stuck.toml --only bode gate
check "a section with a stuck lever fails: exit 1" [ $? -eq 1 ]
check "and the section is named" grep -q "^gearshift: bode: " stuck.err
check "also on the page" grep -q "Failed: " stuck/index.html
check "the gate is drawn anyway" [ -s stuck/gate.svg ]

check "no such section" refuses 2 --only nothing
check "no such preset" refuses 1 --preset nothing
sed 's/^rate_hz = .*/rate_hz = 1/' "$presets/default.toml" >slow.toml
check "a rate out of range" refuses 1 --preset slow.toml
sed 's/^radius_m = .*/radius_m = 0.03/' "$presets/default.toml" >small.toml
check "a lever that is too small for the gate" refuses 1 --preset small.toml

# Ctrl-C in a terminal ends the run early. All child processes receive the signal, too. No figure may be truncated.
ended() { # takes a file; runs the program and interrupts it when the file appears
  setsid env --default-signal=INT "$gearshift" reproduce --out ended --only wall tour >ended.txt 2>ended.err &
  until [ -e "ended/$1" ] || ! kill -0 $!; do sleep 0.001; done
  kill -INT -- -$!
  wait $!
  [ $? -eq 1 ]
}
for begun in wall.svg tour.csv; do
  rm -rf ended
  check "ended at $begun" ended $begun
  check "it says where, got: $(cat ended.err)" [ "$(cat ended.err)" = \
    "gearshift: interrupted during \"${begun%.*}\"; finished files were kept, but no page was written" ]
  check "there is no page" [ ! -e ended/index.html ]
  check "nothing is half written, got: $(ls ended)" [ -z "$(ls ended | grep part)" ]
  for file in ended/*; do
    case $file in
      *.svg) check "$file is complete" is_svg "$file" ;;
      *.png) check "$file is complete" grep -qa IEND "$file" ;;
      *.trace) check "$file replays" "$gearshift" replay "$file" ;;
      *.csv) check "$file is complete" cmp -s "$file" "whole/${file#*/}" ;;
    esac
  done
done
touch file
"$gearshift" reproduce --out file/below --only table >/dev/null 2>err
check "no folder below a file" [ $? -eq 1 ]
check "reported in one sentence" [ "$(wc -l <err)" -eq 1 ]

finish
