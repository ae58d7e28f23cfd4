# All flow tests source this file. It changes to an empty working folder, defines check(), and counts the results. A
# flow test that ends before finish() fails. Bash ends a script early at a line that it cannot run.
work=$(mktemp -d)
passed=0
failed=0
is_finished=
end_all() { :; } # a flow test overrides this to end the processes that it started
leave() {
  local code=$?
  end_all
  [ -n "$is_finished" ] || is_reported
  rm -rf "$work"
  [ -n "$is_finished" ] && exit $code
  echo "FAILED: ended before its finish, $passed passed so far"
  exit 1
}
trap leave EXIT
trap 'exit 1' HUP INT TERM
cd "$work" || exit 1

check() { # takes a description and a command that must succeed
  local what=$1
  shift
  if "$@"; then
    passed=$((passed + 1))
  else
    echo "FAILED: $what"
    failed=$((failed + 1))
  fi
}
# If the host of a virtual machine takes CPU time away, all real-time programs are late. Failed checks of a test that
# sets needs_machine=yes then only print a message, and the test counts as skipped (ctest's SKIP_RETURN_CODE).
stolen_ticks() { awk '$1 == "cpu" {print $9}' /proc/stat; }
began_at=$EPOCHREALTIME began_stolen=$(stolen_ticks)
host_took() { # prints the CPU time that the host took since the test began, in % of the time of all cores
  awk -v ticks=$(($(stolen_ticks) - began_stolen)) -v from="$began_at" -v to="$EPOCHREALTIME" -v cores="$(nproc)" \
    -v rate="$(getconf CLK_TCK)" 'BEGIN {printf "%.0f", 100 * ticks / (rate * cores * (to - from))}'
}
# Programs are late under a sanitizer. In a test that sets needs_machine=yes, failed checks therefore count only if no
# check passed. Otherwise only the sanitizer's reports, which include aborts, fail the test. The reports go to stderr,
# which the tests save in files. The sanitizers' option log_path is not used: its file would be opened before umockdev
# is ready, and the program would end.
if [ -n "${GEARSHIFT_SANITIZED:-}" ]; then
  for sanitizer in ASAN_OPTIONS UBSAN_OPTIONS TSAN_OPTIONS; do export $sanitizer="${!sanitizer:-}:handle_abort=1"; done
fi
is_reported() { [ -n "${GEARSHIFT_SANITIZED:-}" ] && grep -rIhE -A 20 "Sanitizer: |runtime error: " "$work"; }
is_full_run() { [ -n "${GEARSHIFT_FULL:-}" ]; } # ./test --full sets this variable
is_png() { [ "$(head -c 4 "$1" | tail -c 3)" = PNG ]; }
finish() { # prints the summary and returns the script's exit code
  is_finished=yes
  echo "$passed passed, $failed failed"
  [ -z "${GEARSHIFT_SANITIZED:-}" ] || { end_all; wait; } # leaks are reported only when a program ends
  if is_reported; then
    echo "FAILED: a sanitizer's report"
    return 1
  fi
  if [ $failed -gt 0 ] && [ -n "${needs_machine:-}" ]; then
    [ -z "${GEARSHIFT_SANITIZED:-}" ] || [ $passed = 0 ] || { echo "judged by its reports alone: none"; return 77; }
    [ "$(host_took)" -lt 15 ] || { echo "not judged: the host took $(host_took) % of the cores meanwhile"; return 77; }
  fi
  [ $((passed + failed)) -gt 0 ] || echo "FAILED: nothing was checked"
  [ $failed -eq 0 ] && [ $passed -gt 0 ]
}
