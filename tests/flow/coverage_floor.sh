#!/usr/bin/env bash
# Tests the minimum coverage that tests/coverage requires, with tables at the minimum, below it, and empty.
# Usage: coverage_floor.sh GEARSHIFT SOURCE_FOLDER
set -u
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
table=$2/tests/coverage_table.py

counted() { # prints a table of two folders with 100 lines each; arguments: the numbers of covered lines
  echo "filename,line_total,line_covered,branch_total,branch_covered"
  printf 'app/%s/x.cpp,100,%s,,\n' a "$1" b "$2"
}
floor() { counted "$1" "$2" >counted.csv; python3 "$table" counted.csv 95 >out 2>err; }
check "coverage at the floor: exit 0" floor 100 90
check "nothing on stderr" [ ! -s err ]
check "there is a row for all rooms together" grep -qE "^all +200 +95\.0 % +-$" out
floor 100 89
check "a line below it: exit 1" [ $? -eq 1 ]
check "in one sentence" grep -qx "coverage: 189 of 200 lines are less than 95 %" err
head -n 1 counted.csv >empty.csv
python3 "$table" empty.csv 95 >out 2>err
check "nothing counted: exit 1" [ $? -eq 1 ]
finish
