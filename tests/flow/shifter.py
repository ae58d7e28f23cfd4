#!/usr/bin/env python3
"""Tests `gearshift shifter` with an emulated /dev/uinput (tests/support/preloaded/uinput.cpp): buttons against what the
lever did, telemetry packed here by the documented layout, every kind of bad packet, messages told once, refusals.
Usage: shifter.py GEARSHIFT SOURCE_FOLDER PRELOADED_UINPUT
"""
import errno
import os
import pathlib
import re
import socket
import struct
import subprocess
import sys
import tempfile
import time

GEARSHIFT, SOURCE, PRELOADED = sys.argv[1:4]
PORT = 47000 + os.getpid() % 1000
EV_SYN, EV_KEY, EV_ABS, BTN_JOYSTICK, BUS_VIRTUAL = 0, 1, 3, 0x120, 6
failed = passed = 0


def check(what, holds, seen=""):
    global failed, passed
    passed, failed = passed + bool(holds), failed + (not holds)
    if not holds:
        print(f"FAILED: {what} {seen}")


def outgauge(time_ms, gear, speed, rpm, throttle, clutch, ident=None):
    """struct OutGaugePack of Live for Speed's docs/InSim.txt: unsigned, char[4], word, 2 bytes, 7 floats, 2 unsigned, 3
    floats, char[16] twice, and an int if an ID is set."""
    packet = struct.pack("<I4sHBB7f2I3f16s16s", time_ms, b"XRG\0", 0, gear + 1, 1, speed, rpm, 0.3, 90, 0.5, 0, 95, 0, 0,
                         throttle, 0, clutch, b"Fuel 50%", b"")
    return packet if ident is None else packet + struct.pack("<i", ident)


def start(folder, *options, problem=None):
    log = folder / "uinput.log"
    for old in (log, folder / "uinput.log.errno"):
        old.unlink(missing_ok=True)
    if problem is not None:
        (folder / "uinput.log.errno").write_text(str(problem))
    environment = dict(os.environ, LD_PRELOAD=PRELOADED, UINPUT_LOG=str(log))
    return subprocess.Popen([GEARSHIFT, "shifter", *options], env=environment, stdin=subprocess.DEVNULL, text=True,
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE), log


def run(folder, *options, **choices):
    program, log = start(folder, *options, **choices)
    out, error = program.communicate(timeout=120)
    return program.returncode, out, error, log.read_text().splitlines() if log.exists() else []


def keys(log):
    return [(int(code) - BTN_JOYSTICK, int(value)) for kind, code, value in
            (line.split()[2:] for line in log if line.startswith("event")) if int(kind) == EV_KEY]


def presses(gears):
    """The events of buttons that are pressed one after the other."""
    return [event for gear in gears for event in ((gear, 1), (gear, 0))]


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    # The tour of the paper's gate: first to fifth, then reverse. The last gear is left when the hand ends.
    code, out, error, log = run(folder, "--gate", "paper")
    check("the tour ends", code == 0, error)
    check("a virtual joystick with a name", f"setup {BUS_VIRTUAL} gearshift shifter" in log, log[:9])
    check("six buttons", sum("UI_SET_KEYBIT" in line for line in log) == 6)
    check("X and Y", [line for line in log if line.startswith("abs")] == ["abs 0 -1 1", "abs 1 -1 1"])
    check("made before the first event, removed after the last",
          log.index("ioctl UI_DEV_CREATE 0") < min(i for i, line in enumerate(log) if line.startswith("event")) and
          log[-1] == "ioctl UI_DEV_DESTROY 0")
    check("each gear's button is held while it is in, in order", keys(log)[:11] == presses(range(6))[:11], keys(log))
    listed = re.findall(r"s: (\w+), button (\d+)", out)
    check("each change is printed", listed == [(g, str(i + 1)) for i, g in enumerate("12345R")], out)
    events = [line.split() for line in log if line.startswith("event")]
    check("each change is followed by a report", all(events[i + 1][2] == str(EV_SYN) or events[i + 1][2] == str(EV_KEY)
                                                     for i in range(len(events) - 1)) and events[-1][2] == str(EV_SYN))

    code, out, error, log = run(folder, "--gate", "sequential_six")
    strokes = [gear for gear, value in keys(log) if value == 1]
    check("a sequential gate's strokes: up six times, down seven", (strokes.count(0), strokes.count(1)) == (6, 7), strokes)
    code, out, error, log = run(folder, "--gate", "selector_p_r_n_d")
    check("places by their labels", {"R", "P", "D", "M", "+", "-"} <= {label for label, _ in
                                                                         re.findall(r"s: (\S+), button (\d+)", out)}, out)

    # Refusals: one sentence, exit 1, no joystick.
    for problem, words in ((errno.EACCES, "may not be used by this user; install assets/udev/70-gearshift.rules"),
                           (errno.ENOENT, "modprobe uinput"), (errno.EIO, "Input/output error")):
        code, out, error, log = run(folder, problem=problem)
        check(f"uinput fails with {problem}", code == 1 and words in error and error.count("\n") == 1, error)
    for options, words in ((("--telemetry", "4444"), "must be HOST:PORT"),
                           (("--telemetry", "192.0.2.1:4444"), "Cannot assign requested address"),
                           (("--pedals", "/dev/null"), "is no input device with axes"),
                           (("--pedals", str(folder / "none")), "cannot be opened")):
        code, out, error, log = run(folder, *options)
        check(f"{options}", code == 1 and words in error and error.count("\n") == 1 and not log, error)

    # Telemetry: both lengths, then every kind of packet that does not count, then silence.
    program, log = start(folder, "--gate", "paper", "--telemetry", f"127.0.0.1:{PORT}")
    sender, stranger = (socket.socket(socket.AF_INET, socket.SOCK_DGRAM) for _ in range(2))
    for each in (sender, stranger):
        each.connect(("127.0.0.1", PORT))
    time.sleep(1.0)
    for i in range(100):
        try:
            sender.send(outgauge(1000 + 10 * i, 0, 5.0, 1500.0, 0.1, 1.0, 7 if i % 2 else None))
            if i > 10:
                sender.send(outgauge(1000 + 10 * i - 50, 0, 5.0, 1500.0, 0.1, 1.0))  # late
                stranger.send(outgauge(1000 + 10 * i, 0, 50.0, 1500.0, 0.1, 1.0))    # of another sender
                sender.send(outgauge(1000 + 10 * i, 0, float("nan"), 1500.0, 0.1, 1.0))
                sender.send(b"GET / HTTP/1.1\r\n")
        except ConnectionRefusedError:
            pass  # the program has not opened the port yet
        time.sleep(0.01)
    out, error = program.communicate(timeout=120)
    for words in ("telemetry arrives", "arrived late", "second sender", "stopped; the gate continues"):
        check(f"told once: {words}", out.count(words) == 1, out)
    check("told once: malformed", len(re.findall("impossible values|OutGauge packets have 92 or 96", out)) == 1, out)
    check("with telemetry, too, every gear goes in", program.returncode == 0 and
          [g for g, _ in re.findall(r"s: (\w+), button (\d+)", out)][-1] == "R", out + error)

    # At 15 m/s with the engine at idle and the clutch up, first gear's ring blocks, so its button stays up.
    def first_gear(rpm):
        program, log = start(folder, "--gate", "paper", "--telemetry", f"127.0.0.1:{PORT}")
        began = time.monotonic()
        while program.poll() is None and time.monotonic() - began < 8.0:
            try:
                sender.send(outgauge(0, 0, 15.0, rpm, 0.0, 0.0))
            except ConnectionRefusedError:
                pass
            time.sleep(0.01)
        program.terminate()
        out, _ = program.communicate(timeout=60)
        return re.findall(r"s: (\w+), button (\d+)", out)[:1]

    def places(brake):
        """The selector's places, after each other, while the other car's brake is pressed so far."""
        program, log = start(folder, "--gate", "selector_p_r_n_d", "--telemetry", f"127.0.0.1:{PORT}")
        packet = bytearray(outgauge(0, 0, 0.0, 700.0, 0.0, 0.0))
        packet[52:56] = struct.pack("<f", brake)
        while program.poll() is None:
            try:
                sender.send(packet)
            except ConnectionRefusedError:
                pass
            time.sleep(0.02)
        return [label for label, _ in re.findall(r"s: (\S+), button (\d+)", program.communicate()[0])]

    check("P is not left without the brake", places(0.0)[-1] == "P")
    check("and with it the tour goes on", places(1.0)[-1] == "-")
    check("a gear whose ring blocks is no button", first_gear(800.0) == [])
    # The hatchback's first gear: 3.45 times 4.08, wheels of 303.2 mm.
    check("at the speed of the gear it goes in", first_gear(15.0 / 0.3032 * 3.45 * 4.08 * 30 / 3.14159265) == [("1", "1")])

print(f"{passed} passed, {failed} failed")
sys.exit(failed > 0)
