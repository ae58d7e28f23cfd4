#!/usr/bin/env python3
"""Prints the lines and branches covered by tests, per folder, from gcovr's CSV. Exits 1 if less than FLOOR percent of all
lines are covered. Usage: coverage_table.py CSV FLOOR
"""
import collections
import csv
import sys

rooms = collections.defaultdict(collections.Counter)
for row in csv.DictReader(open(sys.argv[1])):
    parts = row["filename"].split("/")
    for room in ("/".join(parts[:2]) if len(parts) > 2 else parts[0], parts[0], "all"):
        for column in ("line_total", "line_covered", "branch_total", "branch_covered"):
            rooms[room][column] += int(row[column] or 0)


def share(room, what):
    total = rooms[room][what + "_total"]
    return f"{100 * rooms[room][what + '_covered'] / total:.1f} %" if total else "-"


print(f"{'room':<24} {'lines':>7} {'reached':>9} {'branches':>9}")
for room in sorted(rooms):
    print(f"{room:<24} {rooms[room]['line_total']:>7} {share(room, 'line'):>9} {share(room, 'branch'):>9}")

total, covered = rooms["all"]["line_total"], rooms["all"]["line_covered"]
if total == 0 or 100 * covered < float(sys.argv[2]) * total:
    sys.exit(f"coverage: {covered} of {total} lines are less than {sys.argv[2]} %")
