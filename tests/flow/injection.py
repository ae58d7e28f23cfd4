#!/usr/bin/env python3
"""Puts hostile text into every field that a person can fill: names, comments, authors, titles, labels, file names, and
every text of a history that somebody has edited. Every page, drawing, table and CSV file must show it as text.

Python's own parsers read the output. Pages and drawings must have the tags and attributes of those with plain text. No
cell of a CSV file may be a formula for a spreadsheet (OWASP, CSV Injection). No output may contain control characters or
ones that change the direction of writing (CVE-2021-42574).
Usage: injection.py GEARSHIFT SOURCE_FOLDER FILL_HISTORY
"""
import csv
import html.parser
import io
import json
import pathlib
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

MARKUP = "</title></svg><script>alert(1)</script>\"'><img src=x onerror=alert(1)>&lt;b&gt;<!--"
FORMULAS = ("=HYPERLINK(\"http://example.org\";\"x\")", "+1+cmd|' /C calc'!A0", "-2+3", "@SUM(1;2)", "\t=1+1", "\r=1+1")
QUOTES = "a\"b;c,d'e\nsecond line"
REVERSED = "abc\u202edcb\u2066x\u2028y"
CONTROLS = "red\x1b[31m\x9b31m\x07"
SQL = "x'); DROP TABLE learner; --"
HOSTILE = (MARKUP, *FORMULAS, QUOTES, REVERSED, CONTROLS, SQL)
DIRECTIONS = set("\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069\u2028\u2029")


class Tags(html.parser.HTMLParser):
    """The tags of a page, each with the names of its attributes."""

    def __init__(self, text):
        super().__init__()
        self.tags, self.words = [], ""
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attributes):
        self.tags.append((tag, tuple(name for name, _ in attributes)))

    def handle_comment(self, data):
        self.tags.append(("comment", ()))

    def handle_data(self, data):
        self.words += data


def is_number(text):
    try:
        float(text.replace(",", "."))
        return True
    except ValueError:
        return False


def is_formula(cell):
    return len(cell) > 1 and cell[0] in "=+-@\t\r\uff1d\uff0b\uff0d\uff20" and not is_number(cell)


def unsafe_characters(text):
    return {hex(ord(c)) for c in text if (ord(c) < 32 and c not in "\n\r\t") or 127 <= ord(c) < 160 or c in DIRECTIONS or 0xd800 <= ord(c) < 0xe000}


class Injection:
    def __init__(self, gearshift, source, fill):
        self.gearshift, self.source, self.fill = gearshift, pathlib.Path(source), fill
        self.passed, self.failed = 0, []

    def check(self, what, ok, seen=""):
        if ok:
            self.passed += 1
        else:
            self.failed.append(f"FAILED: {what}{': ' if seen else ''}{seen}")

    def run(self, *arguments, codes=(0,)):
        result = subprocess.run([self.gearshift, *map(str, arguments)], capture_output=True, stdin=subprocess.DEVNULL)
        told = (result.stdout + result.stderr).decode(errors="surrogateescape")
        what = f"gearshift {arguments[0]}"
        self.check(f"{what} exits with one of {codes}, not {result.returncode}", result.returncode in codes, told[:300])
        self.check(f"{what} prints no unsafe characters", not unsafe_characters(told), str(unsafe_characters(told)))
        return told

    def page(self, file, plain):
        """Compares a page or drawing with the one that has plain text."""
        text = file.read_text(errors="surrogateescape")
        self.check(f"{file.name}: characters", not unsafe_characters(text), str(unsafe_characters(text)))
        self.check(f"{file.name}: tags", Tags(text).tags == Tags(plain.read_text(errors="surrogateescape")).tags)
        if file.suffix == ".svg":
            try:
                xml.etree.ElementTree.fromstring(text)
                self.check("", True)
            except xml.etree.ElementTree.ParseError as problem:
                self.check(f"{file.name} is XML", False, str(problem))

    def table(self, file, separator, plain):
        text = file.read_bytes().decode("utf-8-sig")
        self.check(f"{file.name}: characters", not unsafe_characters(text), str(unsafe_characters(text)))
        rows = list(csv.reader(io.StringIO(text, newline=""), delimiter=separator))
        wanted = list(csv.reader(io.StringIO(plain.read_bytes().decode("utf-8-sig"), newline=""), delimiter=separator))
        self.check(f"{file.name}: rows and columns", [len(row) for row in rows] == [len(row) for row in wanted])
        formulas = [cell for row in rows for cell in row if is_formula(cell)]
        self.check(f"{file.name}: formulas", not formulas, str(formulas[:3]))

    def history(self, folder, text):
        """A history in which somebody has replaced every text. Texts that must differ get a number behind."""
        folder.mkdir()
        file = folder / "history.db"
        (folder / "near.trace").write_bytes(b"")
        subprocess.run([self.fill, file, "near.trace"], check=True)
        self.run("report", "--database", file, "--learner", "Bob", "--next", "hill_start")
        self.run("report", "--database", file, "--learner", "Ada <i>Löwe</i>", "--comment", "3", "fine", "--by", "Bo")
        base = sqlite3.connect(file)
        # Words of the program, which a reader must know.
        kept = {("driving_error", "kind"), ("shift", "steps"), ("last_number", "kind"), ("unsent", "kind")}
        for (table,) in base.execute("SELECT name FROM sqlite_master WHERE type = 'table'").fetchall():
            for _, column, kind, *_ in base.execute(f"PRAGMA table_info({table})").fetchall():
                if kind != "TEXT" or (table, column) in kept:
                    continue
                unique = " || rowid" if (table, column) == ("learner", "name") else ""
                base.execute(f"UPDATE {table} SET {column} = ?{unique}", (text,))
        base.commit()
        self.names = [name for (name,) in base.execute("SELECT name FROM learner ORDER BY id")]
        base.close()
        return file

    def reports(self, folder, text):
        file = self.history(folder, text)
        self.run("report", "--database", file)
        for separator in ("comma", "semicolon"):
            self.run("report", "--database", file, "--out", folder / f"class_{separator}", "--csv", "--separator", separator)
            self.run("report", "--database", file, "--learner", self.names[0], "--out", folder / f"one_{separator}", "--csv",
                     "--separator", separator)
        self.run("report", "--database", file, "--learner", self.names[0])

    def edited_histories(self, work):
        plain = work / "plain"
        self.reports(plain, "word")
        for i, text in enumerate(HOSTILE):
            folder = work / f"hostile_{i}"
            self.reports(folder, text)
            for file in sorted(folder.rglob("*")):
                other = plain / file.relative_to(folder)
                if file.suffix in (".html", ".svg"):
                    self.page(file, other)
                elif file.suffix == ".csv":
                    self.table(file, ";" if "semicolon" in file.parent.name else ",", other)

    def typed_texts(self, work):
        """What the command line takes, it stores and shows as typed, and SQL in it is never run."""
        file = work / "typed.db"
        subprocess.run([self.fill, file, "near.trace"], check=True)
        report = ("report", "--database", file, "--learner")
        name = SQL
        self.run("lesson", "start_and_stop", "--learner", name, "--database", file, codes=(0, 1))
        run = sqlite3.connect(file).execute("SELECT max(id) FROM lesson_run").fetchone()[0]
        comment = "y'); DELETE FROM lesson_run; --"
        self.run(*report, name, "--comment", run, comment, "--by", "Bo'; DROP TABLE comment; --")
        base = sqlite3.connect(file)
        self.check("the comment is there as typed",
                   base.execute("SELECT text, author FROM comment").fetchall() == [(comment, "Bo'; DROP TABLE comment; --")])
        number = base.execute("SELECT id FROM comment").fetchone()[0]
        base.close()
        self.run(*report, name, "--edit-comment", number, "z'); DROP TABLE shift; --")
        self.run(*report, name, "--rename", "n'; DROP TABLE session; --")
        self.run(*report, "n'; DROP TABLE session; --", "--next", "l'; DROP TABLE learner; --", codes=(1,))
        self.run(*report, "nobody' OR '1'='1", "--delete", "--yes", codes=(1,))
        base = sqlite3.connect(file)
        self.check("the history is whole", base.execute("PRAGMA integrity_check").fetchone()[0] == "ok")
        counts = [base.execute(f"SELECT count(*) FROM {t}").fetchone()[0] for t in ("learner", "lesson_run", "comment")]
        self.check("nothing was dropped or deleted", counts[0] >= 3 and counts[1] >= 13 and counts[2] == 1, str(counts))
        for text in (CONTROLS, REVERSED):
            self.run(*report, text, codes=(1, 2))
            self.run("lesson", "start_and_stop", "--learner", text, "--database", file, codes=(1, 2))

    def files(self, work):
        """Titles, labels and file names of lessons, cars and gates."""
        for i, text in enumerate(("word", MARKUP, FORMULAS[0], "a\"b;c,d'e")):
            folder = work / f"files_{i}"
            folder.mkdir()
            quoted = json.dumps(text, ensure_ascii=False)
            stem = text.replace("/", "_")[:60]
            lesson = folder / f"{stem}.toml"
            original = (self.source / "assets/lessons/hill_start.toml").read_text()
            lesson.write_text("\n".join(f"{line.split(' =')[0]} = {quoted}" if line.startswith(("title =", "goal =", "prompt =",
                                        "says =")) else line for line in original.splitlines()))
            car = folder / f"car {stem}.toml"
            car.write_text((self.source / "assets/cars/hatchback.toml").read_text().replace(
                'title = "Hatchback, 1.6 l petrol, five speeds"', f"title = {quoted}"))
            gate = folder / f"gate {stem}.toml"
            gate.write_text((self.source / "assets/gates/four_speed.toml").read_text().replace(
                'name = "Four speeds"', f"name = {quoted}"))
            self.run("gate", gate, "--svg", folder / "gate.svg")
            self.run("gate", gate, "--json")
            self.run("tour", "--gate", gate, "--out", folder / "tour")
            self.run("lesson", lesson, "--car", car, "--learner", "Kim", "--database", folder / "history.db", codes=(0, 1))
            self.run("report", "--database", folder / "history.db")
            self.run("report", "--database", folder / "history.db", "--learner", "Kim", "--out", folder / "page", "--csv",
                     "--separator", "semicolon")
            for file in sorted(folder.rglob("*")):
                plain = work / "files_0" / file.relative_to(folder)
                if i and file.suffix in (".html", ".svg"):
                    self.page(file, plain)
                elif i and file.suffix == ".csv" and file.parent.name == "page":
                    self.table(file, ";", plain)
        for text in (CONTROLS, REVERSED):
            odd = work / "odd.toml"
            odd.write_text((self.source / "assets/gates/four_speed.toml").read_text().replace(
                'name = "Four speeds"', f"name = {json.dumps(text, ensure_ascii=True)}"))
            self.check("a title with such characters is refused",
                       "must be one line without control characters" in self.run("gate", odd, codes=(1,)))

    def finish(self):
        print("\n".join(self.failed))
        print(f"{self.passed} passed, {len(self.failed)} failed")
        return 1 if self.failed else 0


def main():
    test = Injection(*sys.argv[1:4])
    work = pathlib.Path(tempfile.mkdtemp())
    try:
        test.edited_histories(work)
        test.typed_texts(work)
        test.files(work)
    finally:
        shutil.rmtree(work)
    return test.finish()


if __name__ == "__main__":
    sys.exit(main())
