#!/usr/bin/env python3
"""Runs every command in every .md file, and every example in a verb's --help, two documents at a time.

Usage: documented_commands.py GEARSHIFT SOURCE_FOLDER

A command is a line of a code block, or inline code, that begins with one of PROGRAMS. A document's commands are run in
order in one initially empty folder, with a separate home folder, the files of make_fixtures(), and the document's fenced
blocks with a file name (```toml my.toml). Words in capitals are replaced from VALUES. The expected exit code is 0 or the
one in the comment after the command: "# exits 1"; quoted text in the comment must be printed: # says "may not". Commands
that need a user, a headset, a stick or many minutes are in ELSEWHERE, with the reason and, unless they are only run by
hand, the file that runs them: their verb and options must still exist, and a guide says "# not run: why". Commands that
only take long are in LONG; ./test --full runs them. Ranges and defaults in the tuning guide are compared with the program's, too.
"""
import concurrent.futures
import os
import pathlib
import re
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile

PROGRAM = (r"(cp|sed|sudo|gearshift|ctest|cmake|python3|blender|umockdev-wrapper|\w+_fuzz|\w+_tests"
           r"|tests/\S+\.sh|tests/fuzz/run|tests/coverage|tests/in_debian|build/\S+)")
PROGRAMS = re.compile(rf"^([A-Z_]+=\S+ )*(\./run|\./test|{PROGRAM})( |$)")
BARE = re.compile(rf"^{PROGRAM}$")  # the program's name without arguments
# In these guides, each command that this test does not run must be marked with "# not run: REASON".
GUIDES = ("TUNING.md", "GUIDE.md", "BUILDING.md")
SKIPPED_FOLDERS = {"build", "out", ".git"}

# Values for the arguments in capitals, for one verb ("gate NAME") or for all verbs ("FILE").
VALUES = {"gate NAME": "paper", "gate LAYOUT": "dog_leg_five", "lesson NAME": "moving_off",
          "replay TRACE": "tour.trace", "replay FILE": "killed.trace", "render FILE": "assets/models/hand.glb",
          "drive SCRIPT": "script.csv",
          "FILE": "bindings.toml", "DIR": "made", "PNG": "made.png", "OUT": "out.csv", "WHO": "Ada"}

# Commands that are not run here. Key: a pattern of the command. Value: the reason; the file that runs the command
# instead; words in that file that prove it. \1 in these words is the pattern's first group. At least one of the words
# must also occur in the command. An entry without a file is a command that is only run by hand.
ELSEWHERE = {
    r"\./run$": ("installs and opens a window",),
    r"\./test": ("runs this test",),
    r"ctest": ("runs this test", "test", "ctest --preset dev"),
    r"cmake --workflow": ("builds and tests all of it",),
    r"cmake --(preset release|build) .*--target package":
        ("makes the package", "tests/flow/deb_in_chroot.sh", "--target package"),
    r"cmake --build": ("builds all of it anew", "test", "cmake --build --preset"),
    r"gearshift .*--database postgresql://": ("wants a server", "tests/flow/school.sh", "postgresql://"),
    r"gearshift report .*--database a.db": ("wants files of two seats", "tests/flow/school.sh",
                                            '"$gearshift" report "${files[@]}"'),
    r"gearshift tour .*--device ": ("wants a stick and who holds it", "tests/flow/devices.sh", "tour --device"),
    r"gearshift .*--device ": ("the same, and a window", "tests/flow/headset_stick.sh", "--device ffboard"),
    r"gearshift devices --calibrate": ("wants a stick and a person", "tests/flow/calibrate.sh", "devices --calibrate"),
    r"gearshift devices --controls": ("wants pedals and a person", "tests/flow/controllers.py", "--controls"),
    r"gearshift train.* --xr": ("wants a headset", "tests/flow/no_headset.sh", "--xr --silent"),
    r"gearshift demo ": ("takes minutes on a busy machine", "tests/flow/demo.sh", '"$gearshift" demo'),
    r"gearshift reproduce --out \S+$": ("takes long", "tests/flow/reproduce.sh", '"$gearshift" reproduce'),
    r"gearshift contact --stick": ("needs a stick", "tests/flow/devices.sh", "contact --stick"),
    r"gearshift bench --family (contact|boundary)":
        ("takes minutes; its campaign is this test's", "tests/haptics/loop/contact_goals_test.cpp", r"bench_\1"),
    r"gearshift bench --family methods": ("takes minutes", "tests/flow/bench.sh", "bench --quick --family methods"),
    r"gearshift bench --family hard": ("takes minutes",),
    r"gearshift bench($| --family (jitter|beside|picture|quality|light))":
        ("takes minutes, and the machine for itself",),
    r"gearshift campaign (--seed 1 )?--out \S+$": ("a million shifts; fewer there", "tests/flow/campaign.sh",
                                                  '"$gearshift" campaign --seed'),
    r"gearshift campaign --merge": ("wants shards", "tests/flow/campaign.sh", "--merge part/*"),
    r"cmake --preset (release|dev) && cmake --build": ("builds all of it anew", "test", "cmake --build --preset"),
    r"cmake --install": ("installs what was built", "tests/flow/install.sh", "cmake --install"),
    r"gearshift report .*--delete$": ("asks for the name", "tests/flow/report.sh", 'report --learner "$ada" --delete'),
    r"blender ": ("Blender is not installed for the tests",),
    r"tests/fuzz/run": ("takes minutes: ./test --full", "test", "tests/fuzz/run"),
    r"tests/coverage": ("takes minutes: ./test --full", "test", "tests/coverage"),
    r"GEARSHIFT_\w+=": ("writes pictures",),
    r"(hid_descriptor|gltf)_fuzz": ("searches for ever; for a minute there", "tests/fuzz/run", r"\1"),
    r"tests/guest/run_guest\.sh": ("boots a kernel: ./test --full", "tests/guest/CMakeLists.txt", "run_guest.sh"),
    r"tests/flow/deb_in_chroot\.sh": ("makes a Debian of its own: ./test --full", "test", "tests/flow/deb_in_chroot.sh"),
    r"tests/in_debian ": ("makes a Debian of its own", "tests/flow/deb_in_chroot.sh", "tests/in_debian"),
    r"tests/flow/soak\.sh": ("takes hours",),
    r"tests/flow/(\w+)\.sh": ("a flow itself", "tests/flow/CMakeLists.txt", r"\1"),
    r"umockdev-wrapper ": ("an emulated stick in real time", "tests/flow/sticks.sh", "umockdev-wrapper"),
    r"sudo ": ("changes the machine",),
}

LONG = {
    r"gearshift bench --(quick|out bench)$": ("all families", "tests/flow/bench.sh", "bench --quick"),
    r"gearshift campaign --shifts 1000 ": ("shorter there", "tests/flow/campaign.sh", "campaign --seed 11 --shifts"),
}
if not os.environ.get("GEARSHIFT_FULL"):
    ELSEWHERE |= LONG


class Command:
    def __init__(self, document, line, text, comment="", inline=False):
        self.inline = inline
        self.document, self.line, self.text = document, line, re.sub(r"^\./run ", "gearshift ", text.strip())
        code = re.search(r"exits (\d)", comment)
        self.code = int(code.group(1)) if code else 0
        self.says = re.findall(r'says "([^"]*)"', comment)
        self.is_said_not_run = "not run" in comment

    def where(self):
        return f"{self.document}:{self.line}: {self.text}"


class Document:
    def __init__(self, name):
        self.name, self.commands, self.files = name, [], {}


def split_comment(line):
    """Splits off the comment after a command: after a # or, in a table of commands, after two spaces."""
    parts = re.split(r"\s+# |\s{2,}#? ?", line.strip(), maxsplit=1)
    return parts[0], parts[1] if len(parts) > 1 else ""


def read_document(path, name):
    document = Document(name)
    fence = file = None
    held, started = "", 0
    for number, line in enumerate(path.read_text().splitlines(), 1):
        opening = re.match(r"^\s*```(\S*)\s*(\S*)", line)
        if opening:
            fence = None if fence else "```"
            file = opening.group(2) if fence else None
            if file:
                document.files[file] = ""
        elif file:
            document.files[file] += line + "\n"
        elif fence or line.startswith("    "):
            held, started = (held + " " if held else "") + line.strip(), started or number
            if held.endswith("\\"):
                held = held[:-1].rstrip()
                continue
            text, comment = split_comment(held)
            if PROGRAMS.match(text):
                document.commands.append(Command(name, started, text, comment))
            held, started = "", 0
    text = re.sub(r"^```.*?^```", lambda block: "\n" * block.group().count("\n"), path.read_text(), flags=re.M | re.S)
    for inline in re.finditer(r"`([^`]+)`", text):
        command = " ".join(inline.group(1).split())
        if PROGRAMS.match(command) and not BARE.match(command):
            document.commands.append(Command(name, text.count("\n", 0, inline.start()) + 1, command, inline=True))
    return document


def read_help(gearshift, verb):
    document = Document(f"gearshift {verb} --help")
    printed = subprocess.run([gearshift, verb, "--help"], capture_output=True, text=True, check=True).stdout
    for number, line in enumerate(printed.splitlines(), 1):
        if line.startswith("  gearshift "):
            document.commands.append(Command(document.name, number, *split_comment(line)))
    return document


def read_verbs(gearshift):
    printed = subprocess.run([gearshift, "--help"], capture_output=True, text=True, check=True).stdout
    return re.findall(r"^  (\w+)  ", printed[printed.index("Verbs:"):], re.M)


def documents(sources, gearshift, verbs):
    found = []
    for folder, folders, names in os.walk(sources):
        folders[:] = [f for f in folders if f not in SKIPPED_FOLDERS]
        for name in names:
            if name.endswith(".md"):
                path = pathlib.Path(folder, name)
                found.append(read_document(path, str(path.relative_to(sources))))
    found += [read_help(gearshift, verb) for verb in verbs]
    return sorted((d for d in found if d.commands), key=lambda d: d.name)


class Runner:
    def __init__(self, gearshift, sources, verbs, work):
        self.sources, self.verbs, self.work = sources, verbs, work
        (work / "bin").mkdir()
        (work / "bin" / "gearshift").write_text(f'#!/bin/sh\nexec {shlex.quote(gearshift)} "$@"\n')
        (work / "bin" / "gearshift").chmod(0o755)
        self.help, self.seen, self.failures, self.run_count, self.elsewhere = {}, {}, [], 0, 0
        self.make_fixtures()

    def environment(self, folder):
        env = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
        env.update(PATH=f"{self.work / 'bin'}:{env['PATH']}", HOME=str(folder / "home"))
        env["XDG_CACHE_HOME"] = str(self.work / "cache")  # a shared cache, so that pipelines are compiled only once
        for kind in ("DATA", "CONFIG"):
            env[f"XDG_{kind}_HOME"] = str(folder / "home" / kind.lower())
        return env

    def shell(self, text, folder):
        process = subprocess.Popen(["bash", "-c", text], cwd=folder, env=self.environment(folder), text=True,
                                   stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                   start_new_session=True)
        try:
            printed, _ = process.communicate(timeout=120)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)  # ends bash and the processes that it started
            process.communicate()
            raise
        return subprocess.CompletedProcess(text, process.returncode, printed)

    def make_fixtures(self):
        folder = self.work / "fixtures"
        folder.mkdir()
        for name in ("assets", "tests"):
            (folder / name).symlink_to(self.sources / name)
        shutil.copy(self.sources / "assets/gates/paper.toml", folder / "my_gate.toml")
        shutil.copy(self.sources / "assets/bindings/default.toml", folder / "bindings.toml")
        for command in ("gearshift tour --gate my_gate.toml --out drive && cp drive/tour.trace .",
                        "gearshift lesson reverse --trace lesson.trace", "cp lesson.trace drive.trace",
                        "head -c 100000 lesson.trace >killed.trace",
                        "printf 'time_s,throttle\\n0,0\\n1,0.2\\n' >script.csv",
                        "gearshift lesson moving_off --learner Ada --runs 12",
                        "gearshift report --learner Ada --comment 12 Good. --by Bo",
                        "gearshift report --learner Ada --comment 11 Calm. --by Bo",
                        "gearshift report --learner Ada --comment 10 Fair. --by Bo"):
            done = self.shell(command, folder)
            if done.returncode:
                sys.exit(f"a fixture failed: {command}\n{done.stdout}")

    def fail(self, command, why):
        self.failures.append(f"FAILED: {command.where()}\n  {why}")

    def parses(self, command):
        """Checks that the command's verb and options exist."""
        words = command.text.split()
        if words[0] != "gearshift" or len(words) < 2:
            return
        verb = words[1]
        if verb not in self.help:
            self.help[verb] = self.shell(f"gearshift {verb} --help", self.work / "fixtures").stdout
        for option in re.findall(r" (--[a-z-]+)", command.text):
            if not re.search(rf"{option}\b", self.help[verb]):
                self.fail(command, f"{verb} has no {option}")
        for family in re.findall(r" --family (\w+)", command.text):
            if not re.search(rf"[{{,]{family}\b", self.help[verb]):
                self.fail(command, "there is no such family")

    def only_names_verb(self, command):
        """For prose: checks that the word is a verb."""
        if not command.inline or not re.match(r"gearshift \w+$", command.text):
            return False
        if command.text.split()[1] not in self.verbs:
            self.fail(command, "is no verb")
        return True

    def is_shown(self, command, file, words):
        """Checks that the file contains the words, which must be long enough and share a word with the command."""
        own = set(re.findall(r"[a-z]{2,}", words)) - {"gearshift", "tests", "flow", "build"}
        if len(words) < 4 or not any(re.search(rf"(?<![a-z]){word}(?![a-z])", command.text) for word in own):
            self.fail(command, f'"{words}", by which {file} is to show it, is nothing of its own')
        if words not in self.text_of(file):
            self.fail(command, f"{file}, which is to show it, has no {words}")

    def shown_elsewhere(self, command):
        for pattern, (_, *shown_by) in ELSEWHERE.items():
            found = re.match(pattern, command.text)
            if found:
                if shown_by:
                    self.is_shown(command, shown_by[0], found.expand(shown_by[1]))
                program = command.text.split()[0]
                if program.startswith("tests/") and not (self.sources / program).exists():
                    self.fail(command, "is not there")
                self.parses(command)
                if command.document.endswith(GUIDES) and not (command.inline or command.is_said_not_run):
                    self.fail(command, 'is not run, and does not say so: "# not run: why"')
                self.elsewhere += 1
                return True
        return False

    def text_of(self, name):
        path = self.sources / name
        return path.read_text() if path.exists() else ""

    def as_run(self, command):
        text = command.text
        for name, value in VALUES.items():
            verb, _, word = name.rpartition(" ")
            if not verb or text.startswith(f"gearshift {verb} "):
                text = re.sub(rf"(?<=[ =]){word}(?= |$)", value, text)
        if text.startswith("gearshift train") and "--offscreen" not in text:
            text += " --offscreen picture"
        if text.startswith("gearshift train") and "--replay" not in text:
            text += " --seconds 0.1"
        if re.match("gearshift (train|render)", text) and "--size" not in text:
            text += " --size 64x48 --samples 1"
        if text.startswith("gearshift bench") and "--quick" not in text:
            text += " --quick"
        return text

    def first_time(self, command):
        """True once per command, so that one repeated in prose is run only once."""
        return self.seen.setdefault(command.text, command) is command

    def run(self, command, folder):
        text = self.as_run(command)
        try:
            done = self.shell(text, folder)
        except subprocess.TimeoutExpired:
            return self.fail(command, "takes more than two minutes")
        self.run_count += 1
        if done.returncode != command.code:
            self.fail(command, f"exits {done.returncode}, not {command.code}: {done.stdout.strip()[-500:]}")
        printed = " ".join(done.stdout.split())
        for words in command.says:
            if words not in printed:
                self.fail(command, f'does not say "{words}": {printed[-500:]}')

    def check_parameters(self):
        """The shipped default preset and the pages' tables of parameters must be what the program prints."""
        table = "gearshift parameters --table"
        for page, command in (("assets/presets/default.toml", "gearshift parameters"),
                              ("haptics/TUNING.md", f"{table} haptics"), ("assets/cars/README.md", f"{table} car"),
                              ("assets/gates/README.md", f"{table} gate"),
                              ("assets/lessons/GUIDE.md", f"{table} lesson"),
                              ("assets/lessons/README.md", f"{table} condition")):
            printed = self.shell(command, self.work).stdout
            row = Command(page, 0, command)
            if not printed or printed not in (self.sources / page).read_text():
                self.fail(row, "prints other parameters than the page has; renew the page")
            self.run_count += 1

    def run_document(self, document):
        wanted = []
        for command in document.commands:
            if self.only_names_verb(command) or self.shown_elsewhere(command):
                continue
            if not command.inline or self.first_time(command):
                wanted.append(command)
        if not wanted:
            return
        folder = pathlib.Path(tempfile.mkdtemp(dir=self.work))
        shutil.copytree(self.work / "fixtures", folder, symlinks=True, dirs_exist_ok=True)
        for name, text in document.files.items():
            (folder / name).write_text(text)
        in_blocks = {command.text for command in wanted if not command.inline}
        for command in wanted:
            if not command.inline or command.text not in in_blocks:
                self.run(command, folder)
        shutil.rmtree(folder)


def main():
    gearshift, sources = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2]).resolve()
    verbs = read_verbs(gearshift)
    found = documents(sources, gearshift, verbs)
    with tempfile.TemporaryDirectory() as work:
        runner = Runner(gearshift, sources, verbs, pathlib.Path(work))
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            list(pool.map(runner.run_document, found))
        runner.check_parameters()
    print("".join(failure + "\n" for failure in runner.failures), end="")
    print(f"{runner.run_count} run, {runner.elsewhere} shown elsewhere, {len(runner.failures)} failed")
    return 1 if runner.failures or runner.run_count < 20 else 0


if __name__ == "__main__":
    sys.exit(main())
