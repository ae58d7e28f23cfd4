#!/usr/bin/env python3
"""Checks the rules of the source tree: a room links what it includes, each library has one namespace and each type one
definition, app has exactly the known folders, and retired names are not used.
Usage: house.py SOURCE_FOLDER HOUSE_DOT (written by CMake from its link lists)
"""
import collections
import pathlib
import re
import sys

APP = {"base", "cabin", "demo", "lab", "lessons", "package", "runtime", "session", "shifter", "ui", "vehicle", "verbs"}
RETIRED = re.compile(r"\bk(?:Most|Least)[A-Z]\w*|\b\w+_words\(")
COMMENT_OR_STRING = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'', re.S)


def links(dot):
    """Folder -> folders that it links, directly or through others."""
    direct = collections.defaultdict(set)
    for line in dot.read_text().splitlines():
        names = re.findall(r'"([^"]+)"', line)
        if len(names) == 2 and "->" in line:
            direct[names[0]].add(names[1])
        elif len(names) == 1:
            direct[names[0]]
    def reach(room, seen):
        for other in direct[room]:
            if other not in seen:
                seen.add(other)
                reach(other, seen)
        return seen
    return {room: reach(room, set()) for room in list(direct)}


def namespace_of(file):
    """Namespace of the file's library: gearshift::haptics, gearshift::lessons, ..."""
    folder, *rest = file.parts
    if folder != "app":
        return {"shaders": "shader"}.get(folder, folder)
    return rest[0] if len(rest) > 1 else "verbs"


def types_defined(code):
    """Names of classes and enums that are defined at namespace level, outside of unnamed namespaces."""
    scopes, names, start = [], [], 0  # scopes: for each open brace, whether it is a named namespace
    for brace in re.finditer(r"[{};]", code):
        if brace[0] == ";":
            start = brace.end()
            continue
        if brace[0] == "{":
            head = code[start:brace.start()].strip()
            opened = re.search(r"\bnamespace\s+([\w:]+)\s*$", head)
            defined = re.search(r"(?:class|struct|union|enum(?: class)?)\s+(?:alignas\([^)]*\)\s*)?(\w+)(?:\s+final)?(?:\s*:[^:].*)?$", head, re.S)
            if defined and all(scopes) and "(" not in head.split(defined[0])[0]:
                names.append(defined[1])
            scopes.append(bool(opened))
        elif scopes:
            scopes.pop()
        start = brace.end()
    return names


class House:
    def __init__(self, sources, dot):
        self.sources, self.links, self.passed, self.failures = sources, links(dot), 0, []

    def check(self, ok, what):
        self.passed += bool(ok)
        if not ok:
            self.failures.append(f"FAILED: {what}")

    def files(self):
        for top in ("app", "engine", "haptics", "shaders"):
            for path in sorted((self.sources / top).rglob("*")):
                if path.suffix in (".cpp", ".h"):
                    yield path.relative_to(self.sources), path.read_text()

    def includes(self, file, text):
        room = str(file.parent) if str(file.parent) != "app" else "app/verbs"
        self.check(room in self.links, f"{file}: no library of CMake's is the folder {room}")
        seen = {room, *self.links.get(room, ())}
        for target in re.findall(r'^#include "([^"]+)"', text, re.M):
            folder = str(pathlib.Path(target).parent)
            self.check(folder in seen, f"{file} includes {target}, which {room} does not link")

    def namespaces(self, file, code):
        for name in re.findall(r"^namespace\s+(gearshift[\w:]*)", code, re.M):
            right = f"gearshift::{namespace_of(file)}"
            describes = name == "gearshift::haptics" and "kParameters<" in code  # must be specialised where it is declared
            self.check(name == right or name.startswith(right + "::") or describes, f"{file} opens {name}, its library has {right}")

    def run(self):
        defined, words = collections.defaultdict(set), 0
        for file, text in self.files():
            code = COMMENT_OR_STRING.sub(lambda m: '""' if m[0][0] in "\"'R" else "", text)
            code = re.sub(r"^\s*#.*$", "", code, flags=re.M)
            self.includes(file, text)
            self.namespaces(file, code)
            for name in types_defined(code):
                defined[name].add(str(file))
            for name in RETIRED.findall(code):
                self.check(False, f"{file}: {name} is a retired name")
        for name, files in sorted(defined.items()):
            self.check(len(files) == 1, f"{name} is defined by {', '.join(sorted(files))}")
        folders = {path.name for path in (self.sources / "app").iterdir() if path.is_dir()}
        self.check(folders == APP, f"folders of app: {sorted(folders ^ APP)}")
        loose = {path.name for path in (self.sources / "app").iterdir() if path.is_file()}
        self.check(loose == {"main.cpp", "CMakeLists.txt", "README.md"}, f"loose in app: {sorted(loose)}")
        print(f"{len(defined)} types")
        print("\n".join(self.failures + [f"{self.passed} passed, {len(self.failures)} failed"]))
        return 1 if self.failures else 0


if __name__ == "__main__":
    sys.exit(House(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])).run())
