#!/usr/bin/env bash
# A PostgreSQL server of a test's own: on a free port of 127.0.0.1, in a temporary folder, with passwords required.
# PostgreSQL refuses to run as root, so root runs it as nobody.
# Usage: postgres.sh new                    prints the server's folder, after creating and starting it
#        postgres.sh start|stop|kill FOLDER   kill: as a power failure would
#        postgres.sh remove FOLDER
# FOLDER/port holds the port; the superuser is "owner", with the password in FOLDER/owner. FOLDER/certificate is the server's.
set -euo pipefail
programs=$(compgen -G "/usr/lib/postgresql/*/bin" | sort -V | tail -n 1) || { echo "no PostgreSQL server found" >&2; exit 1; }
[ "$(id -u)" -ne 0 ] || as_user=(setpriv --reuid=nobody --regid=nogroup --clear-groups)
export LC_ALL=C.UTF-8 TZ=UTC

run() { # program, arguments ...
  local program=$programs/$1
  shift
  (cd "$folder" && "${as_user[@]:-env}" "$program" "$@")
}
start() {
  run pg_ctl start -D "$folder/data" -l "$folder/log" -w -t 60 -s \
    -o "-p $(cat "$folder/port") -c listen_addresses=127.0.0.1 -c unix_socket_directories= -c ssl=on \
      -c ssl_cert_file='$folder/certificate' -c ssl_key_file='$folder/key'"
}
stop_with() { ! [ -e "$folder/data/postmaster.pid" ] || run pg_ctl stop -D "$folder/data" -m "$1" -w -s; }

folder=${2:-}
case ${1:-} in
  new)
    folder=$(mktemp -d /tmp/gearshift_pg_XXXXXX)
    chmod 755 "$folder"
    head -c 12 /dev/urandom | base64 | tr '+/' '-_' >"$folder/owner"
    openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:prime256v1 -nodes -days 2 -subj /CN=school \
      -addext subjectAltName=IP:127.0.0.1 -keyout "$folder/key" -out "$folder/certificate" 2>/dev/null
    chmod 600 "$folder/key"
    [ "$(id -u)" -ne 0 ] || chown -R nobody:nogroup "$folder"
    run initdb -D "$folder/data" -U owner --pwfile="$folder/owner" -A scram-sha-256 -E UTF8 --locale=C.UTF-8 >/dev/null
    for _ in 1 2 3 4 5; do # another program may take the port in between
      python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])' >"$folder/port"
      ! start 2>/dev/null || { echo "$folder"; exit 0; }
    done
    cat "$folder/log" >&2
    exit 1
    ;;
  start) start ;;
  stop) stop_with fast ;;
  kill) # all processes at once; a restart recovers from the log
    pid=$(head -n 1 "$folder/data/postmaster.pid")
    read -ra all <<<"$pid $(cat "/proc/$pid/task/$pid/children")"
    kill -KILL "${all[@]}" 2>/dev/null || true
    is_alive() { [ -e "/proc/$1" ] && ! grep -qs "State:.Z" "/proc/$1/status"; }
    for process in "${all[@]}"; do while is_alive "$process"; do sleep 0.01; done; done
    rm -f "$folder/data/postmaster.pid" # a zombie counts as running
    ;;
  remove)
    stop_with immediate || true
    rm -rf "$folder"
    ;;
  *) exit 2 ;;
esac
