#!/usr/bin/env python3
"""Draws CMake's link lists: house.svg (libraries), haptics.svg and engine.svg (rooms). Needs Debian's package graphviz.
Usage: draw_house.py HOUSE_DOT FOLDER
"""
import pathlib
import re
import subprocess
import sys


def group(folder):
    parts = folder.split("/")
    return "/".join(parts[:2]) if parts[0] == "app" else parts[0]


def draw(edges, nodes, file):
    look = 'rankdir=BT; node [shape=box, style="rounded,filled", fillcolor="#fbfcfd", color="#6b7785", fontname="DejaVu Sans", fontsize=12]; edge [color="#6b7785", arrowsize=0.7];'
    graph = "digraph {" + look + "".join(f'"{n}";' for n in sorted(nodes))
    graph += "".join(f'"{a}" -> "{b}";' for a, b in sorted(edges)) + "}"
    reduced = subprocess.run(["tred"], input=graph, capture_output=True, text=True, check=True).stdout
    file.write_bytes(subprocess.run(["dot", "-Tsvg"], input=reduced.encode(), capture_output=True, check=True).stdout)


def main(dot, folder):
    text = dot.read_text()
    nodes = set(re.findall(r'^  "([^"]+)";$', text, re.M))
    edges = set(re.findall(r'^  "([^"]+)" -> "([^"]+)";$', text, re.M))
    draw({(group(a), group(b)) for a, b in edges if group(a) != group(b)}, {group(n) for n in nodes}, folder / "house.svg")
    for top in ("haptics", "engine"):
        inside = {n for n in nodes if n.startswith(top + "/")}
        draw({(a, b) for a, b in edges if a in inside and b in inside}, inside, folder / f"{top}.svg")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))
