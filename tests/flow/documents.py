#!/usr/bin/env python3
"""Checks that everything named in the .md files exists: links, pictures, paths, the files listed in a folder's README,
and the function and test of every law in haptics/EQUATIONS.md. Usage: documents.py SOURCE_FOLDER
"""
import fnmatch
import pathlib
import re
import sys
import urllib.parse

SKIPPED_FOLDERS = ("build", "out", ".git")
WALKED = ("app", "engine", "haptics", "shaders", "tests/flow", "tests/support")
SOURCES = (".cpp", ".h", ".sh", ".py", ".vert", ".frag", ".glsl")
MAX_WORDS = 35000  # limit for all .md files together
GUIDES = ("TUNING.md", "BUILDING.md", "GUIDE.md")
ROOMS = "app|assets|engine|haptics|shaders|tests"
FUNCTION = re.compile(r"((?:`[\w:]+`(?:, )?)+) in `([^`]+)`")
TEST = re.compile(r'`([^`]+)`: "([^"]+)"')


class Documents:
    def __init__(self, sources):
        self.sources, self.failures, self.checks = sources, [], 0
        self.cases, self.source_literals = {}, ""

    def check(self, where, ok, what):
        self.checks += 1
        if not ok:
            self.failures.append(f"FAILED: {where}: {what}")

    def pages(self):
        for path in sorted(self.sources.rglob("*.md")):
            if path.relative_to(self.sources).parts[0] not in SKIPPED_FOLDERS:
                yield path, path.relative_to(self.sources), path.read_text()

    def links(self, path, name, text):
        prose = re.sub(r"^```.*?^```", "", text, flags=re.M | re.S)
        for target in re.findall(r"\]\(([^)\s]+)\)", re.sub(r"`[^`]*`", "", prose)):
            if re.match(r"[a-z]+:", target):
                continue
            file, _, heading = urllib.parse.unquote(target).partition("#")
            linked = path.parent / file if file else path
            self.check(name, linked.exists(), f"links to {target}, which is not there")
            if heading and linked.exists():
                self.check(name, heading in anchors(linked.read_text()), f"{file} has no place named {heading}")

    def paths(self, name, text):
        """Inline code that begins with a top folder's name and a slash must be a folder or a file (extension optional)."""
        for word in re.findall(rf"`((?:{ROOMS})/[\w./-]+)`", text):
            path = self.sources / word
            self.check(name, path.exists() or any(path.parent.glob(path.name + ".*")), f"{word} is not there")

    def quotes(self, path, name, text):
        """A ```cpp block must be a part of the .cpp file that the link before it names."""
        parts = text.split("```")
        for before, block in zip(parts[::2], parts[1::2]):
            language, _, quoted = block.partition("\n")
            if language != "cpp":
                continue
            files = re.findall(r"\]\(([^)\s]+\.cpp)\)", before)
            self.check(name, files and quoted in (path.parent / files[-1]).read_text(), "quotes other code than its file has")

    def walked(self, path, name, text):
        """A table with the header "file" must list files of its folder."""
        for table in re.findall(r"^\| files? \|.*\n\|[-| ]+\n((?:\|.*\n?)+)", text, re.M):
            for row in table.splitlines():
                for word in re.findall(r"`([^`]+)`", row.split("|")[1]):
                    found = list(path.parent.glob(word)) or list(path.parent.glob(word + ".*"))
                    self.check(name, bool(found), f"walks {word}, which is not there")

    def unwalked(self):
        """Each source file must be named in its folder's README or, without one, in the nearest README above."""
        for room in WALKED:
            for path in sorted((self.sources / room).rglob("*")):
                if path.suffix not in SOURCES or path.stem.endswith("_test"):
                    continue
                folder = next(f for f in path.parents if (f / "README.md").exists())
                text = (folder / "README.md").read_text()
                words = re.findall(r"`([^`]+)`", text)
                is_named = any(fnmatch.fnmatch(path.name, w) or fnmatch.fnmatch(path.stem, w) for w in words)
                is_named = is_named or re.search(rf"[`/ ]{re.escape(path.stem)}\b", text)
                self.check(path.relative_to(self.sources), is_named, f"not walked by {folder.name}/README.md")

    def sentences(self, name, text):
        """Program output quoted in a guide must occur in the sources, except for numbers and names."""
        prose = re.sub(r"^```.*?^```|^    [^\n]*$|`[^`]*`", "", text, flags=re.M | re.S)
        for quoted in re.findall(r'"([^"]*)"', prose):
            for piece in re.split(r"\.\.\.|[-\d.]*\d[\d.]*", " ".join(quoted.split())):
                if len(piece.strip()) >= 8:
                    self.check(name, piece.strip(" .:") in self.literals(), f'nothing says "{piece.strip()}"')

    def literals(self):
        """All string literals of the program; split literals are joined."""
        if not self.source_literals:
            for room in ("app", "engine", "haptics"):
                for path in (self.sources / room).rglob("*.cpp"):
                    text = re.sub(r'"\s*\n\s*"', "", path.read_text())
                    self.source_literals += "\n".join(re.findall(r'"((?:[^"\\\n]|\\.)*)"', text)) + "\n"
        return self.source_literals

    def test_cases(self, file):
        """The file's test case names, with split literals joined, as they appear in a table."""
        if file not in self.cases:
            text = re.sub(r'"\s*\n\s*"', "", (self.sources / file).read_text())
            names = re.findall(r'TEST_CASE\(\s*"((?:[^"\\]|\\.)*)"', text)
            self.cases[file] = [re.sub(r"\|([^|]+)\|", r"abs(\1)", name.replace('\\"', '"')) for name in names]
        return self.cases[file]

    def equations(self):
        page = self.sources / "haptics/EQUATIONS.md"
        rows = [line for line in page.read_text().splitlines() if re.match(r"\| (?!symbol)", line)]
        self.check("EQUATIONS.md", len(rows) > 80, f"has {len(rows)} laws: the page is not read as it was meant")
        for row in rows:
            cells = [cell.strip() for cell in row.strip("|").split("|")]
            law = f"EQUATIONS.md, {cells[0]}"
            self.check(law, len(cells) == 5, f"has {len(cells)} cells")
            functions, tests = FUNCTION.findall(cells[3]) if len(cells) == 5 else [], TEST.findall(cells[-1])
            self.check(law, functions, "names no function in a file")
            self.check(law, tests, "names no test")
            for names, file in functions:
                exists = (self.sources / file).exists()
                self.check(law, exists, f"{file} is not there")
                for function in re.findall(r"`([^`]+)`", names) if exists else []:
                    text = (self.sources / file).read_text()
                    self.check(law, re.search(rf"\b{function}\b", text), f"{file} has no {function}")
            for file, words in tests:
                exists = (self.sources / file).exists()
                self.check(law, exists, f"{file} is not there")
                found = exists and any(words in case for case in self.test_cases(file))
                self.check(law, found, f'{file} has no case "{words}"')


def anchors(text):
    """The anchors that common renderers make from headings."""
    named = set(re.findall(r'<a id="([^"]+)">', text))
    return named | {re.sub(r"[^\w\- ]", "", h.lower()).replace(" ", "-") for h in re.findall(r"^#+ (.*?)\s*$", text, re.M)}


def main():
    documents = Documents(pathlib.Path(sys.argv[1]).resolve())
    words = sum(len(text.split()) for _, _, text in documents.pages())
    documents.check("all pages", words <= MAX_WORDS, f"have {words} words together, at most {MAX_WORDS} are wanted")
    for path, name, text in documents.pages():
        documents.links(path, name, text)
        documents.paths(name, text)
        documents.quotes(path, name, text)
        documents.walked(path, name, text)
        if path.name in GUIDES:
            documents.sentences(name, text)
    documents.unwalked()
    documents.equations()
    print("".join(failure + "\n" for failure in documents.failures), end="")
    print(f"{documents.checks - len(documents.failures)} passed, {len(documents.failures)} failed")
    return 1 if documents.failures else 0


if __name__ == "__main__":
    sys.exit(main())
