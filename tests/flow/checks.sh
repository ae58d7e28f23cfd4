# Sourced by the flows: an empty folder to work in, check, and the count at the end. Without that a flow has failed: bash
# ends a script early for a line that it cannot run.
work=$(mktemp -d)
passed=0
failed=0
is_finished=
end_all() { :; } # what a flow has started
leave() {
  local code=$?
  end_all
  rm -rf "$work"
  [ -n "$is_finished" ] && exit $code
  echo "FAILED: ended before its finish, $passed passed so far"
  exit 1
}
trap leave EXIT
trap 'exit 1' HUP INT TERM
cd "$work" || exit 1

check() { # what, command ...
  local what=$1
  shift
  if "$@"; then
    passed=$((passed + 1))
  else
    echo "FAILED: $what"
    failed=$((failed + 1))
  fi
}
whole() { [ -n "${GEARSHIFT_FULL:-}" ]; } # ./test --full
is_png() { [ "$(head -c 4 "$1" | tail -c 3)" = PNG ]; }
finish() { # the script's exit code
  is_finished=yes
  echo "$passed passed, $failed failed"
  [ $failed -eq 0 ]
}
