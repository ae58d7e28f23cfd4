#!/usr/bin/env bash
# Tests the first start in unusual environments: no home folder, a read-only home folder, folders with spaces, quotes
# and letters of other scripts, a German and a Turkish locale. The output must be the same in all locales, byte for
# byte.
# Usage: first_start.sh GEARSHIFT SOURCE_FOLDER
set -u
gearshift=$1
source=$2
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
unset DISPLAY WAYLAND_DISPLAY XDG_DATA_HOME XDG_CONFIG_HOME XDG_CACHE_HOME XDG_RUNTIME_DIR LC_ALL MESA_SHADER_CACHE_DIR

# As root, the program runs without root's right to write everywhere. (Running it as the user "nobody" would not work,
# because this user cannot enter a source tree in root's home.)
mkdir locked
chmod 555 locked
as_others=()
overrides=-dac_override,-dac_read_search
[ "$(id -u)" -eq 0 ] && as_others=(setpriv --bounding-set=$overrides --inh-caps=$overrides)
locked="locked locked/missing/home"
if ! "${as_others[@]}" true 2>/dev/null; then
  echo "no folder can be locked here: this root may not put its rights away"
  as_others=() locked=""
fi
start() { # takes the name for the output, HOME=..., and the arguments
  local name=$1 home=$2
  shift 2
  "${as_others[@]}" env "$home" "$gearshift" "$@" >"$name.txt" 2>"$name.err" </dev/null
}
# Mesa 25 adds its own lines about a cache that it cannot make.
one_sentence() { sed -i '/^Failed to create .* for shader cache/d' "$1" && [ "$(wc -l <"$1")" -eq 1 ] && grep -q "$2" "$1"; }
for home in $locked; do
  check "$home: a lesson is passed" start lesson "HOME=$work/$home" lesson hill_start --learner Ada
  check "$home: one message that nothing is saved, got: $(cat lesson.err)" \
    one_sentence lesson.err "the history cannot be used because the folder cannot be created (Permission denied)"
  start report "HOME=$work/$home" report --learner Ada --out page
  check "$home: a report fails" test $? -eq 1
  check "$home: in one sentence, got: $(cat report.err)" one_sentence report.err "history not found"
  check "$home: devices are listed" start devices "HOME=$work/$home" devices
done
if [ -n "$locked" ]; then
  check "the cabin is drawn" start train "HOME=$work/locked" train --offscreen drawn --seconds 0.1 --size 320x180
  check "with one sentence, got: $(cat train.err)" one_sentence train.err "the history cannot be used"
  start refused HOME=/ tour --out "$work/locked/tour"
  check "a read-only folder: rejected" test $? -eq 1
  check "in one sentence, got: $(cat refused.err)" one_sentence refused.err "locked/tour: cannot be created (Permission denied)"
  echo mine >locked.svg
  chmod 444 locked.svg
  start refused HOME=/ gate paper --svg locked.svg
  check "a read-only file in a writable folder: rejected" test $? -eq 1
  check "in one sentence, got: $(cat refused.err)" one_sentence refused.err "locked.svg: cannot be written (Permission denied)"
  check "and it is unchanged" test "$(cat locked.svg)" = mine
  cp drawn/train.png train.png
  chmod 444 train.png
  XDG_DATA_HOME=$work/data start refused HOME=/ train --offscreen . --seconds 0.1 --size 320x180
  check "a read-only picture: one sentence, got: $(cat refused.err)" one_sentence refused.err "train.png: the picture cannot be written (Permission denied)"
  check "and it is unchanged" cmp train.png drawn/train.png
fi
nameless() { # takes arguments; runs the program without HOME, as a user unknown to the system
  unshare --user --map-user=4242 env -u HOME "$gearshift" "$@" >nameless.txt 2>nameless.err </dev/null
}
if unshare --user --map-user=4242 "$gearshift" --version >/dev/null 2>&1; then
  check "no home at all: a gate is shown" nameless gate paper
  no_home() { one_sentence nameless.err "cannot find a folder for your files"; }
  check "no home at all: a lesson is passed" nameless lesson hill_start --learner Ada
  check "no home at all: one message that nothing is saved, got: $(cat nameless.err)" no_home
  check "no home at all: devices are listed" nameless devices
  check "no home at all: the cabin is drawn" nameless train --offscreen nameless --seconds 0.1 --size 320x180
  check "no home at all: and reported, got: $(cat nameless.err)" no_home
  nameless report --learner Ada --out page
  check "no home at all: a report fails" test $? -eq 1
  check "no home at all: in one sentence, got: $(cat nameless.err)" no_home
else
  echo "not shown: no home at all (no user may have a namespace of his own here)"
fi

# The same commands must write the same files in each locale, in a folder whose name is hard to quote.
folder="Ordner ä ş ı İ 日本 o'clock \"q\" \`x\` \$HOME #1%41"
session() { # locale
  (
    export LC_ALL=$1 LANG=$1
    mkdir -p "$1/$folder"
    cd "$1/$folder" || exit 1
    export HOME=$PWD
    cp "$source/assets/gates/paper.toml" "gate ı İ.toml"
    {
      "$gearshift" gate "gate ı İ.toml" --json --svg "gate ä.svg" >gate.json &&
        "$gearshift" gate paper >gate.txt &&
        "$gearshift" tour --out "tour $folder" >tour.txt &&
        "$gearshift" lesson hill_start --learner "Ayşe İ ı" --trace "lesson ş.trace" >lesson.txt &&
        "$gearshift" replay "lesson ş.trace" --csv "lesson ş.csv" >replay.txt &&
        "$gearshift" report --learner "Ayşe İ ı" --database "$work/driven before.db" --out "page $folder" --csv >report.txt
    } 2>errors.txt </dev/null || { cat errors.txt; false; }
  )
}
for locale in de_DE tr_TR; do
  check "the locale $locale is compiled" localedef -i $locale -f UTF-8 "$work/$locale.UTF-8.made"
done
mkdir locales
for locale in de_DE tr_TR; do mv "$locale.UTF-8.made" "locales/$locale.UTF-8"; done
export LOCPATH=$work/locales
check "its decimal point is a comma" test "$(LC_ALL=tr_TR.UTF-8 locale decimal_point)" = ,
check "a history for all locales, because its runs contain the time" \
  "$gearshift" lesson hill_start --learner "Ayşe İ ı" --database "$work/driven before.db" >/dev/null
check "everything works in C.UTF-8" session C.UTF-8
check "and the files exist" test "$(find C.UTF-8 -name "*.png" -o -name "*.csv" -o -name "*.svg" -o -name "*.gp" | wc -l)" -ge 11
check "nothing is written elsewhere" test "$(ls C.UTF-8)" = "$folder"
for locale in de_DE.UTF-8 tr_TR.UTF-8; do
  check "everything works in $locale" session $locale
  # Excluded: .local, because its history contains the time, and .cache, because the driver's cache is not reproducible.
  check "and the files are the same, byte for byte" diff -rq -x .local -x .cache C.UTF-8 $locale
done
finish || exit
[ -n "$locked" ] || exit 77
