#!/usr/bin/env bash
# Runs `cmake --install` into a folder whose name is hard to quote, moves the folder and hides the source tree, to check
# that everything that the program reads is installed with it. Also checks the output of --version, the changelog, and
# the desktop entry.
# Usage: install.sh GEARSHIFT SOURCE_FOLDER BUILD_FOLDER
set -u
source=$2
build=$3
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
export XDG_DATA_HOME=$work/data XDG_CACHE_HOME=$work/cache
unset DISPLAY WAYLAND_DISPLAY DESTDIR MESA_SHADER_CACHE_DIR # the shader cache's folder is hidden below
fails() { ! "$@"; }

check "the program is installed" cmake --install "$build" --prefix "$work/erste Größe" --strip >install.txt
mv "erste Größe" "zweite 'Größe'"
prefix="$work/zweite 'Größe'"
cd "$prefix" || exit 1
check "the folders of the assets" test "$(ls share/gearshift/assets | tr '\n' ' ')" = \
  "bindings cars gates lessons models presets udev "
as_in_the_source() { # compares every installed asset with its source
  local file
  find share/gearshift/assets -type f | while read -r file; do
    cmp "$file" "$source/assets/${file#share/gearshift/assets/}" || return 1
  done
}
check "their files equal those in the source tree" as_in_the_source
check "every lesson, gate and model" test "$(find share/gearshift -name "*.toml" -o -name "*.glb" | wc -l)" -eq \
  "$(ls "$source"/assets/{bindings,cars,gates,lessons,lessons/norms,presets}/*.toml "$source"/assets/models/*.glb | wc -l)"
check "nothing else" fails grep -q . <(find . -type f ! -path "./share/gearshift/assets/*" ! -path ./bin/gearshift \
  ! -path "./share/doc/*" ! -path "./share/bash-completion/*" ! -path "./share/man/*" ! -path "./share/lintian/*" \
  ! -name gearshift.desktop ! -name gearshift.svg ! -name "*.rules")
check "the rule for udev" cmp lib/udev/rules.d/70-gearshift.rules "$source/assets/udev/70-gearshift.rules"
# Assertions contain the names of .h and .cpp files, so the check ignores these. A release build has no assertions.
[ -n "${GEARSHIFT_SANITIZED:-}" ] || # sanitizer builds contain the names of source files, too
  check "the program does not contain the path of the source tree" fails grep -q . \
  <(strings -a bin/gearshift | grep -F "$source/" | grep -vE "\.(h|cpp)$")

# Uses the installed program. Where mounts are allowed, the source tree and the build folder are hidden meanwhile.
cat >"$work/use.sh" <<'END'
set -e
[ -z "$2" ] || mount -t tmpfs none "$2"
"$1/bin/gearshift" gate paper >gate.txt
"$1/bin/gearshift" lesson hill_start >lesson.txt
"$1/bin/gearshift" tour --out tour >tour.txt
"$1/bin/gearshift" render "$1/share/gearshift/assets/models/gearbox.glb" --size 64x64 --out box.png >render.txt
"$1/bin/gearshift" train --offscreen drawn --seconds 0.1 --size 320x180 >train.txt
END
mkdir "$work/elsewhere"
cd "$work/elsewhere" || exit 1
if unshare -rm true 2>/dev/null; then
  check "the program needs only what is installed with it" unshare -rm bash "$work/use.sh" "$prefix" "$source" 2>use.err
else
  check "the program needs only what is installed with it" bash "$work/use.sh" "$prefix" "" 2>use.err
fi
check "nothing on stderr, got: $(cat use.err)" test ! -s use.err
check "the gate is the installed one" grep -qF "($prefix/share/gearshift/assets/gates/paper.toml)" gate.txt
check "the cabin is drawn" is_png drawn/train.png
mkdir -p alone/bin && cp "$prefix/bin/gearshift" alone/bin
for verb in "gate paper" "campaign --out c"; do
  alone/bin/gearshift $verb >alone.txt 2>alone.err
  code=$?
  check "$verb without its files: one sentence, got: $(cat alone.err)" \
    test $code -eq 1 -a "$(grep -c "^gearshift: .*; reinstall gearshift$" alone.err)" -eq 1 -a ! -s alone.txt
done
ln -s "$prefix/bin/gearshift" link
check "a link to the program finds its files, too" ./link gate paper >gate.txt

# Checks the output of --version.
version=$("$prefix/bin/gearshift" --version)
printed() { grep -qE "$1" <<<"$version"; }
number=$(sed -n 's/^project(gearshift VERSION \([0-9.]*\).*/\1/p' "$source/CMakeLists.txt")
check "the version is that of CMakeLists.txt" printed "^gearshift $number$"
check "the commit" printed "^commit [^ ]+$"
check "build and compiler" printed "^[A-Za-z]+ build by [A-Za-z]+ [0-9.]+$"
check "libraries" printed "fmt [0-9.]+, glfw3 [0-9.]+, .*vulkan [0-9.]+$"
changes="$prefix/share/doc/gearshift/changelog.gz"
check "the changelog begins with this version" grep -q "^gearshift ($number) " <(zcat "$changes" | head -n 1)
page() { zcat "$prefix/share/man/man1/gearshift.1.gz"; }
verbs_of_the_page() { page | sed -n '/^.SH VERBS/,/^.SH OPTIONS/ {/^.TP/ {n; s/^.B //p}}'; }
verbs_of_the_program() { "$prefix/bin/gearshift" --help | sed -n '/^Verbs:/,$ s/^  \([a-z]*\)  .*/\1/p'; }
check "the manual page has a line for each verb" diff <(verbs_of_the_page) <(verbs_of_the_program)
check "and names this version" grep -q "^.TH GEARSHIFT 1 \"[A-Z][a-z]* 20[0-9]*\" \"gearshift $number\"" <(page)
dead_links() { # prints "PAGE: TARGET" for each relative link of an installed page whose target is not installed
  local page target
  find "$prefix/share/doc" -name "*.md" | while read -r page; do
    sed '/^```/,/^```/d; s/`[^`]*`//g' "$page" | grep -oP '\]\(\K[^)\s]+' | grep -vE '^[a-z]+:|^#' | while read -r target; do
      [ -e "$(dirname "$page")/${target%%#*}" ] || echo "$page: $target"
    done
  done
}
check "every page is there" test "$(find "$prefix/share/doc" -name "*.md" | wc -l)" -ge 15
check "no link in the pages is dead, got: $(dead_links)" test -z "$(dead_links)"
named_pages() { grep -oP '^\| `.*' "$prefix/share/doc/gearshift/README.md" | grep -oP '`\K[^`]+\.md(?=`)'; }
all_are_there() { named_pages | while read -r page; do test -s "$prefix/share/doc/gearshift/$page" || return 1; done; }
check "the first page names the other pages" test "$(named_pages | wc -l)" -ge 8
check "which are installed" all_are_there
facts() { # source folder
  cmake -D "source=$1" -D header="$PWD/facts.h" -D type=t -D compiler=c -D libraries=l \
    -P "$source/app/verbs/build_facts.cmake"
}
mkdir unpacked
check "sources without a history" facts "$PWD/unpacked"
check "their commit is unknown" grep -q 'kCommit = "unknown"' facts.h
touch -d 2000-01-01 facts.h
check "the same facts again" facts "$PWD/unpacked"
check "they cause no recompilation" test "$(date -r facts.h +%Y)" = 2000
check "the desktop entry is valid" desktop-file-validate "$prefix/share/applications/gearshift.desktop"
check "and its icon is there" test -s "$prefix/share/icons/hicolor/scalable/apps/gearshift.svg"

# Incomplete installations.
mv "$prefix/share/gearshift/assets" away
"$prefix/bin/gearshift" gate paper >missing.txt 2>missing.err
check "without its files it fails" test $? -eq 1
one_sentence() { [ "$(wc -l <missing.err)" -eq 1 ] && grep -qF "$prefix/share/gearshift/assets: the program's data files" missing.err; }
check "in one sentence that names them, got: $(cat missing.err)" one_sentence
check "a layout given by path needs no assets" "$prefix/bin/gearshift" gate away/gates/paper.toml >gate.txt
check "nor does the version" "$prefix/bin/gearshift" --version >version.txt
finish
