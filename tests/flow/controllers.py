#!/usr/bin/env python3
"""Tests the whole program with the pads, wheels, pedals and shifters that people own: emulated kernel input devices, a
private X server, the trainer in its window. What the program prints and records shows what the devices have moved.
Usage: xvfb-run controllers.py GEARSHIFT SOURCE_FOLDER [SCENARIO...]
"""
import csv
import json
import os
import re
import subprocess
import sys
import tempfile
import time

gearshift, sources = sys.argv[1:3]
sys.dont_write_bytecode = True  # keeps __pycache__ out of the source tree
sys.path.insert(0, f"{sources}/tests/support/controllers")
import emulated_controllers as emulated  # noqa: E402

G29, SHIFTER, PEDALS, HANDBRAKE = ("Logitech G29", "FANATEC ClubSport USB Shifter", "Heusinkveld", "USB Handbrake")

# The G29's pedals are reversed. The numbers of its axes and buttons are the kernel's order.
SET_UP = """
[keys]
stop = "Space"
[pad_axes.clutch]
stick = "Logitech G29"
axis = 1
from = 1
to = -1
[pad_axes.throttle]
stick = "Logitech G29"
axis = 2
from = 1
to = -1
[pad_axes.hand_brake]
stick = "USB Handbrake"
axis = 0
[pad_axes.brake]
axis = "lt"
[pad_buttons]
starter = "y"
[[controller]]
stick = "ClubSport USB Shifter"
gear_1 = "1"
gear_2 = "2"
gear_3 = "3"
gear_4 = "4"
gear_reverse = "0"
[[controller]]
stick = "Button Box"
record = "0"
quit = "1"
hand_brake = "2"
hand_brake_hold = "3"
shift_up = "30"
shift_down = "31"
"""


with open(f"{sources}/assets/bindings/default.toml") as shipped:
    RECORDED_BY_BOX = shipped.read() + '[[controller]]\nstick = "Button Box"\nrecord = "0"\nquit = "1"\n'


class Failed(Exception):
    pass


def check(what, holds):
    print(("ok: " if holds else "FAILED: ") + what, flush=True)
    if not holds:
        raise Failed(what)


class Trainer:
    """The trainer in its window; `bindings`: text of a bindings file, or nothing for the shipped one."""

    def __init__(self, folder, bindings=None, size="200x140", gate="five_speed_r_right_down"):
        self.folder, self.log = folder, f"{folder}/out.txt"
        options = []
        if bindings:
            with open(f"{folder}/bindings.toml", "w") as file:
                file.write(bindings)
            options = ["--bindings", f"{folder}/bindings.toml"]
        with open(self.log, "w") as out:
            self.process = subprocess.Popen(
                [gearshift, "train", "--size", size, "--silent", "--no-panel", "--lesson", "none", "--gate", gate,
                 "--car", "diesel" if gate == "sequential_six" else "hatchback", *options],
                stdout=out, stderr=subprocess.STDOUT, cwd=folder, env={**os.environ, **homes(folder)})
        self.wait_for("forces on$")

    def text(self):
        with open(self.log) as file:
            return file.read()

    def wait_for(self, pattern, times=1, seconds=30):
        end = time.monotonic() + seconds
        while len(re.findall(pattern, self.text(), re.MULTILINE)) < times:
            if time.monotonic() > end or self.process.poll() is not None:
                raise Failed(f'"{pattern}" was not printed {times} times in:\n{self.text()}')
            time.sleep(0.05)

    def end(self):
        self.process.terminate()
        self.process.wait(timeout=30)

    def replay(self, *options):
        data = f"{self.folder}/data/gearshift"
        traces = [os.path.join(at, name) for at, _, names in os.walk(data) for name in names if name.endswith(".trace")]
        assert len(traces) == 1, traces
        return subprocess.run([gearshift, "replay", traces[0], *options], check=True, capture_output=True, text=True,
                              env={**os.environ, **homes(self.folder)}).stdout

    def recording(self):
        """The rows of the recorded drive, as numbers by column."""
        self.replay("--csv", f"{self.folder}/drive.csv")
        with open(f"{self.folder}/drive.csv") as file:
            return list(csv.DictReader(file))


def homes(folder):
    return {"XDG_CONFIG_HOME": f"{folder}/config", "XDG_DATA_HOME": f"{folder}/data"}


def values(rows, name):
    return [float(row[name]) for row in rows]


def changes(numbers):
    return [number for i, number in enumerate(numbers) if i == 0 or number != numbers[i - 1]]


def devices_are_listed(plugs, folder):
    listed = json.loads(subprocess.run([gearshift, "devices", "--json"], check=True, capture_output=True, text=True,
                                       env={**os.environ, **homes(folder)}).stdout)["controllers"]
    names = {one["name"]: one for one in listed}
    known = [device.name for device in emulated.DEVICES.values()]
    ghosts = [emulated.DEVICES[name].name for name in ("keyboard", "sensors", "steam")]
    check("all controllers are listed in the order of their ports; a keyboard, motion sensors and Steam's copy are not",
          [one["name"] for one in listed] == [name for name in known if name not in ghosts])
    check("a shifter without axes and pedals without buttons have what they report",
          (names[plugs["shifter"].device.name]["buttons"], names[plugs["pedals"].device.name]["axes"]) == (10, 3))
    check("a controller has SDL's identifier: bus, vendor, product and version, each in four little-endian bytes",
          names[plugs["g29"].device.name]["guid"] == "030000006d0400004fc2000014010000")
    check("only the pad is a game pad", [one["name"] for one in listed if one["gamepad"]] == [plugs["pad"].device.name])
    check("pedals that may not be opened are listed as such",
          [one["name"] for one in listed if not one["can_be_read"]] == [plugs["closed"].device.name])


def first_reports(plugs):
    for code in (emulated.ABS_Y, emulated.ABS_Z, emulated.ABS_RZ):
        plugs["g29"].axis(code, 255)
    plugs["g29"].axis(emulated.ABS_X, 32768)
    time.sleep(0.3)


def tap(plug, button):
    plug.button(button)
    time.sleep(0.3)
    plug.button(button, False)
    time.sleep(0.3)


def unknown_devices_do_nothing(plugs, folder):
    trainer = Trainer(folder, RECORDED_BY_BOX)
    tap(plugs["box"], 0)
    trainer.wait_for("recording to")
    first_reports(plugs)
    for number in range(25):
        plugs["g29"].button(number)
        time.sleep(0.02)
        plugs["g29"].button(number, False)
    for value in (0, 128, 255):
        for code in (emulated.ABS_Y, emulated.ABS_Z, emulated.ABS_RZ):
            plugs["g29"].axis(code, value)
        time.sleep(0.1)
    plugs["keyboard"].button(30)
    plugs["steam"].axis(emulated.ABS_RZ, 255)
    plugs["steam"].axis(emulated.ABS_RX, 32767)
    time.sleep(1.0)
    text = trainer.text()
    for name in (G29, SHIFTER, PEDALS, HANDBRAKE):
        check(f"{name} is offered for setting up", re.search(f"{name}.* was found. It has no effect until", text) is not None)
    check("the keyboard and the motion sensors are not mentioned", "Keychron" not in text and "Motion" not in text)
    trainer.wait_for("This user may not read Thrustmaster T-Pedals")
    check("no gear and no stop", not re.search("engaged|motors off|forces off", text))
    tap(plugs["box"], 0)
    tap(plugs["box"], 1)
    trainer.process.wait(timeout=30)
    rows = trainer.recording()
    for pedal in ("throttle", "brake", "clutch", "hand_brake"):
        check(f"no device moves the {pedal}", max(values(rows, pedal)) == 0.0)
    check("nor the lever", max(abs(x) for x in values(rows, "lever_x_mm")) < 1.0)


def everything_set_up_works(plugs, folder):
    trainer = Trainer(folder, SET_UP)
    first_reports(plugs)
    box, shifter, wheel = plugs["box"], plugs["shifter"], plugs["g29"]
    tap(box, 0)  # record
    trainer.wait_for("recording")
    check("a shifter that is in gear 2 at the start moves nothing", "engaged" not in trainer.text())
    shifter.button(2, False)
    time.sleep(0.05)
    wheel.axis(emulated.ABS_Y, 0)  # clutch
    time.sleep(0.2)
    for number, gear in ((3, "3"), (4, "4"), (0, "R"), (1, "1")):
        shifter.button(number)
        trainer.wait_for(f" {gear} engaged")
        shifter.button(number, False)
        time.sleep(0.1)
    time.sleep(1.5)  # the lever goes to neutral
    tap(box, 30)
    trainer.wait_for(" 1 engaged", 2)
    tap(box, 30)
    trainer.wait_for(" 2 engaged")
    tap(box, 31)
    trainer.wait_for(" 1 engaged", 3)
    wheel.axis(emulated.ABS_Z, 64)  # three quarters of the throttle
    time.sleep(0.4)
    wheel.axis(emulated.ABS_Z, 255)
    for value in (20, 128, 255, 0):
        plugs["handbrake"].axis(emulated.ABS_X, value)
        time.sleep(0.3)
    box.button(3)
    time.sleep(0.3)
    box.button(3, False)
    time.sleep(0.3)
    tap(box, 2)
    tap(box, 2)
    tap(box, 0)  # ends the recording
    trainer.wait_for("recorded|saved|Saved|written", 1)
    shifter.unplug()
    trainer.wait_for("ClubSport USB Shifter is not plugged in, so these have no effect: gears")
    box.button(1)
    box.button(1, False)
    check("a button of another device quits, even if it is pressed and released between two frames", trainer.process.wait(timeout=30) == 0)
    rows = trainer.recording()
    throttle, clutch, brake, hand_brake = (values(rows, name) for name in ("throttle", "clutch", "brake", "hand_brake"))
    check("the throttle goes to three quarters", abs(max(throttle) - (255 - 64) / 255) < 0.01)
    check("the clutch goes down", max(clutch) > 0.99)
    check("the brake, which is a pad's trigger that nobody touches, stays up", max(brake) == 0.0)
    check("the handbrake follows its axis to a half and to the end, then two presses of a held button and of a switch",
          [round(value, 1) for value in changes(hand_brake)] == [0.0, 0.5, 1.0, 0.0, 1.0, 0.0, 1.0, 0.0])


# A wheel's hat as buttons (up, right, down, left after its 25 buttons), and the shifter that is in gear 2 at the start.
HAT = """
[keys]
stop = "Space"
[[controller]]
stick = "Logitech G29"
record = "25"
hand_brake_hold = "26"
clutch = "27"
quit = "28"
[[controller]]
stick = "ClubSport USB Shifter"
gear_2 = "2"
gear_3 = "3"
"""


def hats_and_lost_events(plugs, folder):
    trainer = Trainer(folder, HAT)
    wheel, shifter = plugs["g29"], plugs["shifter"]

    def hat(code, value):
        wheel.axis(code, value)
        time.sleep(0.3)
        wheel.axis(code, 0)
        time.sleep(0.3)

    hat(emulated.ABS_HAT0Y, -1)
    trainer.wait_for("recording to")
    hat(emulated.ABS_HAT0X, 1)
    wheel.axis(emulated.ABS_HAT0Y, 1)
    time.sleep(0.3)
    shifter.button(2, False)
    time.sleep(0.3)
    check("a released shifter moves nothing", "engaged" not in trainer.text())
    shifter.lose_events()
    trainer.wait_for(" 2 engaged")  # the state is read again
    hat(emulated.ABS_HAT0Y, -1)
    wheel.axis(emulated.ABS_HAT0X, -1)  # shorter than a frame
    wheel.axis(emulated.ABS_HAT0X, 0)
    check("the hat's left direction quits", trainer.process.wait(timeout=30) == 0)
    rows = trainer.recording()
    check("its right direction pulls the handbrake", changes(values(rows, "hand_brake")) == [0.0, 1.0, 0.0])
    check("its lower direction presses the clutch", max(values(rows, "clutch")) == 1.0)


def access_is_granted_late(plugs, folder):
    late, later = plugs["handbrake"], plugs["pedals"]
    late.unplug()
    later.unplug()
    trainer = Trainer(folder)
    late.plug_in_denied()
    time.sleep(1.0)  # udev needs some time to grant the access
    late.renew()
    trainer.wait_for("USB Handbrake was found")
    check("until then nothing is said", "may not read FANATEC" not in trainer.text())
    later.plug_in_denied()
    trainer.wait_for("This user may not read Heusinkveld")
    later.renew()
    trainer.wait_for("Pedals Ultimate was found")
    trainer.end()


def steams_copy_works_alone(plugs, folder):
    listed = json.loads(subprocess.run([gearshift, "devices", "--json"], check=True, capture_output=True, text=True,
                                       env={**os.environ, **homes(folder)}).stdout)["controllers"]
    check("Steam's copy is listed where there is no other controller",
          [one["name"] for one in listed] == [plugs["steam"].device.name])


def pad_drives_at_once(plugs, folder):
    trainer = Trainer(folder, RECORDED_BY_BOX)
    pad = plugs["pad"]
    tap(plugs["box"], 0)
    trainer.wait_for("recording to")
    for value in (64, 192, 0):  # the right trigger, which GLFW calls the sixth axis
        pad.axis(emulated.ABS_RZ, value)
        time.sleep(0.3)
    def tap_within_a_frame(button):
        pad.button(button)
        pad.button(button, False)
        time.sleep(0.3)

    tap_within_a_frame(0)  # A
    tap(pad, 0)
    tap(pad, 0)
    tap_within_a_frame(0)
    pad.axis(emulated.ABS_RX, 32767)  # the right stick
    trainer.wait_for("recording to")
    time.sleep(1.0)
    tap(plugs["box"], 0)
    tap(plugs["box"], 1)
    trainer.process.wait(timeout=30)
    rows = trainer.recording()
    check("the throttle follows the pad's trigger",
          [round(value, 2) for value in changes(values(rows, "throttle"))] == [0.0, 0.25, 0.75, 0.0])
    check("A moves the handbrake, also by presses that are shorter than a frame, and no other button does",
          changes(values(rows, "hand_brake")) == [0.0, 1.0, 0.0, 1.0, 0.0])
    check("the stick moves the lever to the right", max(values(rows, "lever_x_mm")) > 10)


def renamed_device_works(plugs, folder):
    bindings = SET_UP.replace('stick = "Logitech G29"', 'stick = "G29 Racing Wheel"\nid = "046d:c24f"')
    trainer = Trainer(folder, bindings)
    trainer.wait_for("G29 Racing Wheel is called Logitech G29 Driving Force Racing Wheel today. If its pedals")
    first_reports(plugs)
    tap(plugs["box"], 0)
    trainer.wait_for("recording")
    plugs["g29"].axis(emulated.ABS_Z, 64)
    time.sleep(0.5)
    tap(plugs["box"], 0)
    tap(plugs["box"], 1)
    trainer.process.wait(timeout=30)
    check("the throttle of a renamed wheel works", max(values(trainer.recording(), "throttle")) > 0.7)


# Two boxes and two pads of the same name.
TWINS = """
[keys]
stop = "Space"
[pad_axes.throttle]
axis = "rt"
[pad_axes.brake]
axis = "rt"
pad = 1
[[controller]]
stick = "Button Box"
record = "0"
[[controller]]
stick = "Button Box"
pad = 1
quit = "1"
"""


def equal_devices_are_told_apart_by_their_ports(plugs, folder):
    trainer = Trainer(folder, TWINS)
    tap(plugs["box2"], 0)
    trainer.wait_for("recording to")
    for name, value in (("pad", 64), ("pad2", 128)):
        plugs[name].axis(emulated.ABS_RZ, value)
        time.sleep(0.3)
    tap(plugs["box2"], 0)
    tap(plugs["box"], 1)
    check("the button of the second box quits", trainer.process.wait(timeout=30) == 0)
    rows = trainer.recording()
    check("the first pad is the throttle, the second the brake",
          [round(max(values(rows, name)), 2) for name in ("throttle", "brake")] == [0.25, 0.5])


def calibration_in_a_terminal(plugs, folder):
    home = {**os.environ, **homes(folder)}
    closed = subprocess.run([gearshift, "devices", "--controls"], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                            env=home)
    check("without a name and without an answer, the first question is asked",
          closed.returncode == 1 and re.search("CLUTCH.*you still use the clutch with A", closed.stdout) is not None)
    dialog = subprocess.Popen([gearshift, "devices", "--calibrate", "G29"], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                              text=True, env=home)
    wheel, said = plugs["g29"], []

    def until(text):
        while not said or text not in said[-1]:
            line = dialog.stdout.readline()
            if not line:
                raise Failed(f'"{text}" was not printed in:\n{"".join(said)}')
            said.append(line)

    def say(answer):
        dialog.stdin.write(answer + "\n")
        dialog.stdin.flush()

    def press(code):
        for value in (*range(255, -1, -15), *range(0, 256, 15)):
            wheel.axis(code, value)
            time.sleep(0.02)

    until("CLUTCH")
    first_reports(plugs)
    say("")  # the first report is no motion
    until("Nothing moved.")
    until("CLUTCH")
    for prompt, code in (("", emulated.ABS_Y), ("BRAKE", emulated.ABS_RZ), ("THROTTLE", emulated.ABS_Z)):
        until(prompt)
        press(code)
        say("")
        until("Found: axis")
    until("HANDBRAKE")
    say("-")
    until("How do you shift?")
    say("1")
    until("NEUTRAL")
    say("")
    for gear in (1, 2):
        until(f"gear {gear}")
        wheel.button(11 + gear)
        time.sleep(0.1)
        say("")
        until("Found: button")
        wheel.button(11 + gear, False)
    for prompt in ("gear 3", "gear 4", "gear 5", "gear 6", "REVERSE"):
        until(prompt)
        say("-")
    until("Saved")
    check("the dialogue ends well", dialog.wait(timeout=10) == 0)
    with open(f"{folder}/config/gearshift/bindings/own.toml") as file:
        saved = file.read()
    for line in ('gear_1 = "12"', 'gear_2 = "13"', 'id = "046d:c24f"'):
        check(f"{line} is saved", line in saved)
    trainer = Trainer(folder)  # with the user's own bindings
    first_reports(plugs)
    wheel.axis(emulated.ABS_Y, 0)  # clutch
    time.sleep(0.3)
    wheel.button(12)
    trainer.wait_for(" 1 engaged")
    trainer.end()


def labels_follow_the_layout(plugs, folder):
    trainer = Trainer(folder, size="640x480")

    def picture(name):
        time.sleep(2.5)  # the labels are read once per second
        path = f"{folder}/{name}.png"
        subprocess.run(["import", "-window", "root", "-crop", "180x320+60+40", path], check=True)  # the column of keys
        return path

    def differ(one, other):
        result = subprocess.run(["compare", "-metric", "AE", one, other, "null:"], capture_output=True, text=True)
        return float(result.stderr.split()[0]) > 0

    window = subprocess.run(["xdotool", "search", "--onlyvisible", "--name", "^gearshift$"], check=True,
                            capture_output=True, text=True).stdout.split()[0]
    closed = picture("closed")
    subprocess.run(["xdotool", "windowfocus", window, "sleep", "0.5", "keydown", "F1", "sleep", "0.5", "keyup", "F1"],
                   check=True)
    check("F1 shows the help", any(differ(closed, picture("us")) for _ in range(5)))
    us = picture("us")
    check("the help does not change by itself", not differ(us, picture("again")))
    subprocess.run(["setxkbmap", "fr"], check=True)
    check("the help shows the keys of a French keyboard", any(differ(us, picture("fr")) for _ in range(5)))
    subprocess.run(["setxkbmap", "us"], check=True)
    check("and again those of the first one", any(not differ(us, picture("us_again")) for _ in range(5)))
    trainer.end()


def declined_devices_are_not_mentioned(plugs, folder):
    os.makedirs(f"{folder}/config/gearshift")
    with open(f"{folder}/config/gearshift/declined_controllers.txt", "w") as file:
        file.write(f"{plugs['handbrake'].device.name}\n{plugs['g29'].device.name}\n")
    trainer = Trainer(folder)
    trainer.wait_for("Heusinkveld.* was found")
    time.sleep(1.0)
    for name in (G29, HANDBRAKE):
        check(f"{name}, which was declined, is not mentioned", f"{name}" not in trainer.text())
    plugs["handbrake"].unplug()
    time.sleep(1.0)
    plugs["handbrake"].plug_in_denied()
    plugs["handbrake"].renew()
    trainer.wait_for("USB Handbrake was found")  # it is plugged in again, so the user may want it now
    trainer.end()


# A sequential shifter with two buttons, whose ring releases neutral and reverse.
SEQUENTIAL = """
[keys]
stop = "Space"
[[controller]]
stick = "Button Box"
record = "0"
shift_up = "30"
shift_down = "31"
lift = "2"
clutch = "3"
quit = "1"
"""

# A sprung lever with an axis: each pull is a gear.
SPRUNG_LEVER = SEQUENTIAL + """
[pad_axes.lever_shift]
stick = "USB Handbrake"
axis = 0
from = -1
to = 1
[lever]
mode = "steps"
"""


def sequential_shifters_work(plugs, folder):
    trainer = Trainer(folder, SEQUENTIAL, gate="sequential_six")
    box = plugs["box"]
    box.button(3)  # the clutch, which a key presses in 0.25 s
    time.sleep(0.5)
    for gear in "1", "2", "3", "4", "5", "6":
        tap(box, 30)
        trainer.wait_for(f" {gear} engaged")
        if gear == "3":  # a recording begins with another loop, which must not forget the gear
            tap(box, 0)
            trainer.wait_for("recording to")
            time.sleep(1.0)
    tap(box, 30)
    for gear in "5", "4", "3", "2", "1":
        tap(box, 31)
        trainer.wait_for(f" {gear} engaged", 2)
    tap(box, 31)
    time.sleep(4.0)
    tap(box, 30)
    trainer.wait_for(" 2 engaged", 3)  # not first, because neutral was locked out
    tap(box, 31)
    trainer.wait_for(" 1 engaged", 3)
    box.button(2)
    tap(box, 31)
    time.sleep(1.5)
    tap(box, 31)
    trainer.wait_for(" R engaged")
    box.button(2, False)
    time.sleep(0.5)
    tap(box, 30)
    time.sleep(1.5)
    tap(box, 30)
    trainer.wait_for(" 1 engaged", 4)
    tap(box, 0)
    tap(box, 1)
    check("the trainer ends well", trainer.process.wait(timeout=30) == 0)
    gears = changes([row["gear"] for row in trainer.recording()])
    check(f"the recording begins in third, got {gears}", [int(float(gear)) for gear in gears] ==
          [3, 4, 5, 6, 5, 4, 3, 2, 1, 2, 1, 0, -1, 0, 1])
    check("it replays bit for bit", "identical bit for bit" in trainer.replay())


def sprung_levers_shift_in_steps(plugs, folder):
    for gate in ("sequential_six", "five_speed_r_right_down"):
        with tempfile.TemporaryDirectory() as home:
            trainer = Trainer(home, SPRUNG_LEVER, gate=gate)
            box, lever = plugs["box"], plugs["handbrake"]
            box.button(3)
            time.sleep(0.5)

            def stroke(end):
                for value in (128, (128 + end) // 2, end, (128 + end) // 2, 128):
                    lever.axis(emulated.ABS_X, value)
                    time.sleep(0.25)  # a busy machine shows few frames

            lever.axis(emulated.ABS_X, 100)  # the first report
            lever.axis(emulated.ABS_X, 128)
            time.sleep(0.3)
            for number, gear in enumerate("123"):
                stroke(0)
                trainer.wait_for(f" {gear} engaged")
            stroke(255)
            trainer.wait_for(" 2 engaged", 2)
            check(f"in {gate} each pull of a sprung lever is one gear up, each push one down",
                  re.findall(r"(\d) engaged", trainer.text()) == ["1", "2", "3", "2"])
            tap(box, 1)
            trainer.process.wait(timeout=30)
            box.button(3, False)


SCENARIOS = [devices_are_listed, steams_copy_works_alone, unknown_devices_do_nothing, everything_set_up_works,
             hats_and_lost_events, access_is_granted_late, pad_drives_at_once, renamed_device_works,
             equal_devices_are_told_apart_by_their_ports, calibration_in_a_terminal, labels_follow_the_layout,
             declined_devices_are_not_mentioned, sequential_shifters_work, sprung_levers_shift_in_steps]



def names(scenario):
    """The devices that are plugged in."""
    if scenario is steams_copy_works_alone:
        return ["steam"]
    twins = emulated.TWINS if scenario is equal_devices_are_told_apart_by_their_ports else {}
    return [*emulated.DEVICES, *twins]


def inside():
    """Runs beneath umockdev, with its own emulated devices."""
    scenario = next(one for one in SCENARIOS if one.__name__ == sys.argv[4])
    plugs = {name: emulated.Plug(name) for name in names(scenario)}
    with tempfile.TemporaryDirectory() as folder:
        try:
            scenario(plugs, folder)
        except Failed as failed:
            print(f"FAILED: {failed}")
            return 1
    return 0


def main():
    failed = []
    wanted = sys.argv[3:]
    for scenario in [one for one in SCENARIOS if not wanted or one.__name__ in wanted]:
        with tempfile.TemporaryDirectory() as folder:
            command = [sys.executable, __file__, gearshift, sources, "--inside", scenario.__name__]
            if emulated.run(emulated.write(folder, names(scenario)), command) != 0:
                failed.append(scenario.__name__)
    print("FAILED: " + ", ".join(failed) if failed else "all passed")
    return 1 if failed else 0


sys.exit(inside() if sys.argv[3:4] == ["--inside"] else main())
