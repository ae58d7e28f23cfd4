# Sourced by the flows: an empty folder to work in, check, and the count at the end.
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
passed=0
failed=0

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
  echo "$passed passed, $failed failed"
  [ $failed -eq 0 ]
}
