#!/usr/bin/env python3
"""Checks that the figures quoted in app/lab/bench/README.md equal run.csv beside it, to the digit, that README.md repeats
five of them, and that the rows named there exist. Usage: quoted_figures.py SOURCE_FOLDER
"""
import csv
import pathlib
import re
import sys

ALONE, BUSY, CABIN = ("jitter", "alone"), ("jitter", "with one busy thread per core"), ("beside", "while the cabin is drawn at full speed")
# Placeholders in row names; each matches any words.
ANY_WORDS = ("RATE", "DRIVE", "LOAD", "...", "N")


class Rows:
    def __init__(self, file):
        self.rows = {(row["family"], row["what"]): row for row in csv.DictReader(file.open())}

    def of(self, family, name, field="value"):
        return float(self.rows[family, name][field])

    def beside(self, family, name, what):
        return float(re.search(rf"(?:^|; ){re.escape(what)} = (\S+)", self.rows[family, name]["beside"])[1])

    def all(self, family, name):
        return [float(row["value"]) for (f, n), row in self.rows.items() if f == family and re.search(name, n)]

    def missed(self, *names):
        """The ending of the goal's cell."""
        return ": not met" if any(self.rows[name]["verdict"].startswith("NOT MET") for name in names) else ""


def lateness(rows, how):
    """Lateness relative to cyclictest's, and absolute: idle, beside busy threads, beside the cabin."""
    words = []
    for (family, where), label in ((ALONE, "alone"), (BUSY, "beside a busy thread per core"), (CABIN, "beside the cabin")):
        ratios = [rows.of(family, f"ours / cyclictest, {how}, {q}, {where}") for q in ("p99", "p99.9")]
        us = [rows.of(family, f"ours, {how}, {q}, {where}") for q in ("p99", "p99.9")]
        words.append("{:.2f} and {:.2f} {} ({:.0f} and {:.0f} us)".format(*ratios, label, *us))
    return ", ".join(words)


def quoted(rows):
    """The cells as the bench's README must quote them."""
    of, beside = rows.of, rows.beside
    ripple = lambda place: of("contact", f"{place}: final peak-to-peak motion, p95")
    worst = "energy added by the wall, worst impact, "
    lost = lambda place: -beside("energy", worst + place, "worst fraction of the impact energy")
    fast = [lost(f"{rate} Hz") for rate in (500, 1000, 2000)]
    others = [lost(name.removeprefix(worst)) for family, name in rows.rows if name.startswith(worst) and "device walls" not in name]
    in_motion = [beside("contact", "1000 Hz, delay 2: final peak-to-peak motion, p95", f"Re Z at {f} Hz, of K") for f in (2, 5, 10)]
    p50, p99 = ("cycle", "whole cycle p50"), ("cycle", "whole cycle p99")
    cabin, driver = (("picture", f"cabin 1280x720, 1x, {what}") for what in ("shadow and mirror", "as the driver sees it"))
    at_once = max(value for value in rows.all("faults", "^(?!consecutive overruns)"))
    verdicts = [row["verdict"] for row in rows.rows.values() if row["goal"]]
    yield f"{sum(verdict.startswith('met') for verdict in verdicts)} of the {len(verdicts)} goals are met"
    yield "p50 {:.0f} ns, p99 {:.0f} ns | 150, 400 ns{} |".format(of(*p50), of(*p99), rows.missed(p50, p99))
    lever, driven, lesson = (("headless", name) for name in ("simulation at 1 kHz", "simulation at 1 kHz with the driveline", "a whole lesson"))
    yield "{:.0f} x real time | 3500 x{} |".format(of(*lever), rows.missed(lever))
    yield "{:.3f}, {:.3f}, {:.3f} mm | 0.04, 0.06, 0.10 |".format(*map(ripple, ("2000 Hz", "1000 Hz", "500 Hz")))
    yield "{:.3f}, {:.3f}, {:.3f} mm; with three".format(*(ripple(f"1000 Hz, delay {n}") for n in (1, 2, 3)))
    unchecked = ("contact", "unchecked 5000 N/m wall, reversal limiter only, 100 Hz: final peak-to-peak motion, maximum")
    yield "{:.2f} mm | 0.40 mm{} |".format(of(*unchecked), rows.missed(unchecked))
    shown = [beside(*key, "displayed") for key, row in rows.rows.items()
             if key[0] == "contact" and "displayed = " in row["beside"] and not key[1].startswith("20 kN/m")]
    yield "at least {:.1f} % | 95 % |".format(min(shown))
    yield "{:.1f}, {:.1f}, {:.1f} % | 95 % |".format(*in_motion)
    yield "it takes {:.0f} to {:.0f} % of it, and {:.0f} to {:.0f} % at every other".format(
        min(fast), max(fast), min(set(others) - set(fast)), max(others))
    yield "within {:.1f} % | 3 % |".format(of("delivered", "tip force against a steady push of 6 to 31 N, mean over 50 ms"))
    levers = ("boundary", "predicted against simulated, 100 random levers")
    yield "{:.2f} % median, {:.1f} % worst | 2 % |".format(beside(*levers, "median"), of(*levers))
    yield "at most {:.0f} ms: [each]".format(at_once)
    yield "{:.0f} ms | 1000 ms |".format(of("picture", "start to first frame, cabin loaded, no pipeline cache"))
    yield "{:.0f} ms (quartiles {:.0f} and {:.0f}); as the driver sees it {:.0f} ms | 60 ms{} |".format(
        of(*cabin), of(*cabin, "quartile_low"), of(*cabin, "quartile_high"), of(*driver), rows.missed(cabin, driver))
    yield "{:.3f} px at most | 0.1 px |".format(*rows.all("quality", "^projection of"))
    yield "{:.0f} ms | 104 ms |".format(of("picture", "222000 untextured GGX triangles, 1280x720, 1x"))
    yield "within {:.4f} % of the reference; {:.0f} ns a step | 0.01 % |".format(
        max(rows.all("driveline", ", 1 ms: event midpoint$")), of("driveline", "one step of 1 ms without display"))
    yield "{:.0e} and {:.0e} %; {:.0e} and {:.0e} | 0.01 %; rounding |".format(
        *(of("driveline", name) for name in ("lock-up time compared with Jr dw / T", "slip energy compared with Jr dw^2 / 2",
                                             "momentum balance", "energy balance, worst drive")))
    yield "{:.0f} x, {:.0f} x real time | 2200, 1300 x{} |".format(of(*driven), of(*lesson), rows.missed(driven, lesson))
    yield "{:.1e} relative at 1 ms, {:.1f} ns a step | 1e-12 |".format(of("plant", "exact at 1 ms"), beside("plant", "exact at 1 ms", "cost"))
    yield "within {:.2f} % of the peak | 3 % |".format(of("feel", "commanded force along a slot, worst error"))
    yield "{:.2f} % (worst gate) to {:g} % | 99 % |".format(min(rows.all("intent", "")), max(rows.all("intent", "")))
    yield lateness(rows, "sleep only")
    yield lateness(rows, "spin 50 us")
    for fault in ("frozen", "drifts out of the workspace", "far outside the workspace"):
        yield "| reading {} | {:.0f} |".format(fault, of("faults", f"reading {fault}: time to zero force"))


def named_rows(page):
    """(families, name) of the rows named in the table of the defaults."""
    for row in re.findall(r"^\|.*\|$", page[page.index("## Defaults"):], re.M):
        for families, names in re.findall(r"((?:`?[a-z]+`?, )*`?[a-z]+`?): ((?:(?:RATE|a row)?[^|:`]*`[^`]+`)+)", row):
            for name in re.findall(r"`([^`]+)`", names):
                if name != "feel":  # a family name among the rows
                    yield re.findall(r"[a-z]+", families), name


def pattern(name):
    """A pattern for a name with placeholders: the whole name, or its beginning."""
    words = re.split(r"(\.\.\.|\b(?:RATE|DRIVE|LOAD|N)\b)", name)
    return "".join(".*" if word in ANY_WORDS else re.escape(word) for word in words)


def main():
    sources = pathlib.Path(sys.argv[1]).resolve()
    rows = Rows(sources / "app/lab/bench/run.csv")
    page = " ".join((sources / "app/lab/bench/README.md").read_text().split())
    failures = [f'app/lab/bench/README.md does not say "{words}", as run.csv does' for words in quoted(rows) if words not in page]
    five = re.findall(r"^\|.*\|$", (sources / "README.md").read_text().split("## Five figures")[1].split("\n\n", 3)[2], re.M)[2:]
    failures += [f"README.md has {len(five)} figures, not five"] * (len(five) != 5)
    failures += [f"README.md's row is not one of app/lab/bench/README.md: {row}" for row in five if row not in page]
    named = list(named_rows((sources / "app/lab/bench/README.md").read_text()))
    if len(named) < 15:
        failures.append(f"app/lab/bench/README.md names {len(named)} rows: the page is not read as it was meant")
    for families, name in named:
        candidates = [what for family, what in rows.rows if family in families]
        if not any(re.search(pattern(name), what) for what in candidates):
            failures.append(f'no row of {", ".join(families)} is named "{name}"')
    checks = len(list(quoted(rows))) + len(named) + 7
    print("".join(f"FAILED: {failure}\n" for failure in failures), end="")
    print(f"{checks - len(failures)} passed, {len(failures)} failed")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
