"""Emulated kernel input devices (evdev) beneath umockdev, without force feedback: what real devices report, and devices
that only look like controllers. Axes and buttons by the kernel's codes; values as before the first report.

    devices = write(folder, names)               # the files of these devices of DEVICES and TWINS
    run(devices, [program, argument, ...])       # runs the program with these devices

The program that run() starts sees /dev/input and /sys as if the devices were plugged in. It may send their events itself:

    plug = Plug("g29"); plug.key(plug.BUTTONS[12], 1); plug.axis(ABS_Z, 0)
"""
import ctypes
import os
import struct
import subprocess
import threading

EV_SYN, EV_KEY, EV_ABS = 0, 1, 3
SYN_REPORT, SYN_DROPPED = 0, 3
(ABS_X, ABS_Y, ABS_Z, ABS_RX, ABS_RY, ABS_RZ, ABS_THROTTLE, ABS_HAT0X, ABS_HAT0Y, ABS_VOLUME) = (
    0, 1, 2, 3, 4, 5, 6, 0x10, 0x11, 0x20)
BTN_JOYSTICK, BTN_GAMEPAD, BTN_TRIGGER_HAPPY = 0x120, 0x130, 0x2c0
USB = 3


class Device:
    def __init__(self, number, name, vendor, product, keys, axes, properties=0, opens=True, port=None):
        self.number, self.name, self.vendor, self.product = number, name, vendor, product
        self.keys, self.axes, self.properties, self.opens = sorted(keys), axes, properties, opens
        self.file = f"event{number}"
        self.place = f"usb-0000:00:14.0-{port or number}/input0"


def joystick_buttons(count):
    """The codes that the kernel gives the buttons of a joystick: 16, then up to 40 more."""
    return [(BTN_JOYSTICK + i) if i < 16 else (BTN_TRIGGER_HAPPY + i - 16) for i in range(count)]


BYTE, WORD, SIGNED = (0, 0, 255), (0, 0, 65535), (0, -32768, 32767)
HATS = {ABS_HAT0X: (0, -1, 1), ABS_HAT0Y: (0, -1, 1)}
XPAD = [0x130, 0x131, 0x133, 0x134, 0x136, 0x137, 0x13a, 0x13b, 0x13c, 0x13d, 0x13e]

DEVICES = {
    # A keyboard whose driver also declares an axis (glfw issues 2455, 2856): GLFW lists it as a joystick.
    "keyboard": Device(1, "Keychron Keychron K8", 0x3434, 0x0280, range(1, 128), {ABS_VOLUME: (0, 0, 1)}),
    # The motion sensors of a DualSense: property "accelerometer" (bit 6).
    "sensors": Device(2, "DualSense Wireless Controller Motion Sensors", 0x054c, 0x0ce6, [],
                      {code: SIGNED for code in range(6)}, properties=1 << 6),
    # new-lg4ff issue 91: X 16 bit, Y clutch, Z throttle, RZ brake, 8 bit, 255 released; 25 buttons, 12 to 17 gears 1 to 6,
    # 18 reverse. Before the first report all axes are 0: pedals fully pressed.
    "g29": Device(3, "Logitech G29 Driving Force Racing Wheel", 0x046d, 0xc24f, joystick_buttons(25),
                  {ABS_X: WORD, ABS_Y: BYTE, ABS_Z: BYTE, ABS_RZ: BYTE, **HATS}),
    # Proton issue 7427: a shifter without axes, in gear 2 at the start.
    "shifter": Device(4, "FANATEC ClubSport USB Shifter", 0x0eb7, 0x1a92, joystick_buttons(10), {}),
    # SDL's testevdev.c: pedals without buttons, which udev takes for an accelerometer.
    "pedals": Device(5, "Heusinkveld Heusinkveld Sim Pedals Ultimate", 0x30b7, 0x1003, [],
                     {ABS_RX: WORD, ABS_RY: WORD, ABS_RZ: WORD}),
    # A handbrake with an axis and nothing else.
    "handbrake": Device(6, "FANATEC ClubSport USB Handbrake", 0x0eb7, 0x1a93, [], {ABS_X: BYTE}),
    "box": Device(7, "Button Box", 0x1209, 0x0001, joystick_buttons(32), {}),
    # xpad: GLFW and SDL know the model.
    "pad": Device(8, "Microsoft X-Box 360 pad", 0x045e, 0x028e, XPAD,
                  {ABS_X: SIGNED, ABS_Y: SIGNED, ABS_Z: BYTE, ABS_RX: SIGNED, ABS_RY: SIGNED, ABS_RZ: BYTE, **HATS}),
    # Steam's copy of another controller.
    "steam": Device(12, "Microsoft X-Box 360 pad 0", 0x28de, 0x11ff, XPAD,
                    {ABS_X: SIGNED, ABS_Y: SIGNED, ABS_Z: BYTE, ABS_RX: SIGNED, ABS_RY: SIGNED, ABS_RZ: BYTE, **HATS}),
    # The device file of a set of pedals that this user may not open.
    "closed": Device(9, "Thrustmaster T-Pedals", 0x044f, 0xb678, [], {ABS_X: WORD, ABS_Y: WORD, ABS_Z: WORD},
                     opens=False),
}
# Devices that equal one of the above. Of the boxes, the one that was plugged in last is at the first port; of the pads, the
# one that was plugged in first. GLFW sorts event10 before event8.
TWINS = {"pad2": Device(10, DEVICES["pad"].name, 0x045e, 0x028e, XPAD, DEVICES["pad"].axes, port=9),
         "box2": Device(11, "Button Box", 0x1209, 0x0001, joystick_buttons(32), {}, port=1)}
NO_ANSWERS = "@DEV /dev/input/event9\nEVIOCGVERSION 0 01000100\n"  # libevdev asks for more and fails
HELD_AT_START = {"shifter": [joystick_buttons(10)[2]]}


def bits(codes, size):
    mask = bytearray(size)
    for code in codes:
        mask[code // 8] |= 1 << code % 8
    return bytes(mask)


def sysfs_bits(codes):
    """As the kernel prints them: words of 64 bits, the highest first."""
    number = sum(1 << code for code in codes)
    words = []
    while True:
        words.append(f"{number & (1 << 64) - 1:x}")
        number >>= 64
        if number == 0:
            return " ".join(reversed(words))


def description(device):
    types = [EV_SYN] + ([EV_KEY] if device.keys else []) + ([EV_ABS] if device.axes else [])
    parent = f"/devices/emulated/input/input{device.number}"
    return "\n".join([
        f"P: {parent}", "E: SUBSYSTEM=input", f"A: name={device.name}", f"A: properties={device.properties:x}",
        f"A: phys={device.place}", f"A: id/bustype={USB:04x}", f"A: id/vendor={device.vendor:04x}", f"A: id/product={device.product:04x}",
        "A: id/version=0114", f"A: capabilities/ev={sysfs_bits(types)}", f"A: capabilities/key={sysfs_bits(device.keys)}",
        f"A: capabilities/abs={sysfs_bits(device.axes)}", "", f"P: {parent}/{device.file}",
        f"N: input/{device.file}", f"E: DEVNAME=/dev/input/{device.file}", "E: SUBSYSTEM=input",
        f"A: dev=13:{64 + device.number}", f"L: device=../../input{device.number}", ""])


def answers(name, device):
    """Answers to the ioctl requests with which GLFW and libevdev ask what the device is."""
    def line(request, data):
        return f"{request} 0 {data.hex().upper()}"

    text = device.name.encode().ljust(256, b"\0")
    # umockdev answers only a request whose buffer has the size of the answer; GLFW's and libevdev's sizes differ.
    types = [EV_SYN] + ([EV_KEY] if device.keys else []) + ([EV_ABS] if device.axes else [])
    properties = [i for i in range(8) if device.properties >> i & 1]
    lines = [f"@DEV /dev/input/{device.file}", line("EVIOCGVERSION", struct.pack("<i", 0x010001)),
             line("EVIOCGID", struct.pack("<4H", USB, device.vendor, device.product, 0x114)),
             line("EVIOCGNAME", text), line("EVIOCGNAME", text[:255]), line("EVIOCGPHYS", device.place.encode().ljust(255, b"\0")),
             line("EVIOCGUNIQ", bytes(255)), line("EVIOCGPROP", bits(properties, 8)), line("EVIOCGBIT(0)", bits(types, 4)),
             line("EVIOCGBIT(0)", bits(types, 8)), line("EVIOCGBIT(1)", bits(device.keys, 96)),
             line("EVIOCGBIT(3)", bits(device.axes, 8)), line("EVIOCGKEY", bits(HELD_AT_START.get(name, []), 96))]
    lines += [line(f"EVIOCGBIT({kind})", bytes(8)) for kind in (2, 4, 5, 0x11, 0x12)]
    lines += [line("EVIOCGBIT(21)", bytes(16)), line("EVIOCGLED", bytes(8)), line("EVIOCGSW", bytes(8))]
    lines += [line(f"EVIOCGABS({code})", struct.pack("<6i", *axis, 0, 0, 0)) for code, axis in device.axes.items()]
    return "\n".join(lines) + "\n"


def write(folder, names=tuple(DEVICES)):
    devices = {name: (DEVICES | TWINS)[name] for name in names}
    for name, device in devices.items():
        with open(f"{folder}/{name}.umockdev", "w") as file:
            file.write(description(device))
        with open(f"{folder}/{name}.ioctl", "w") as file:
            file.write(answers(name, device) if device.opens else NO_ANSWERS)
    return [(f"{folder}/{name}", device) for name, device in devices.items()]


def run(devices, command):
    options = []
    for path, device in devices:
        options += ["--device", path + ".umockdev", "--ioctl", f"/dev/input/{device.file}={path}.ioctl"]
    return subprocess.run(["umockdev-run", *options, "--", *command]).returncode


class Plug:
    """Sends a device's events, beneath run(). A program reads them from a pipe in the place of the device file. Like the
    kernel, it gives all events to every reader: as soon as a pipe is opened, another takes its place for the next reader.
    A reader gets only the events after it has opened its pipe. Create this before the program that reads it."""

    IN_OPEN = 0x20
    libc = ctypes.CDLL(None, use_errno=True)
    inotify = None
    watched = {}  # by inotify's number of the pipe

    def __init__(self, name):
        self.device = (DEVICES | TWINS)[name]
        self.path = f"{os.environ['UMOCKDEV_DIR']}/dev/input/{self.device.file}"
        self.pipes = []
        if not self.device.opens:
            os.unlink(self.path)
            os.mkdir(self.path)  # at each open() that fails, umockdev leaks a socket; so libevdev fails instead
            return
        if Plug.inotify is None:
            Plug.inotify = self.libc.inotify_init1(os.O_CLOEXEC)
            threading.Thread(target=Plug.follow_readers, daemon=True).start()
        self.renew()

    def renew(self):
        """Puts a new pipe in the place of the device file. GLFW would take a deleted file for an unplugged device."""
        made = f"{os.environ['UMOCKDEV_DIR']}/next_{self.device.file}"
        os.mkfifo(made, 0o600)
        pipe = os.open(made, os.O_RDWR | os.O_NONBLOCK)
        Plug.watched[self.libc.inotify_add_watch(Plug.inotify, made.encode(), Plug.IN_OPEN)] = self, pipe
        os.rename(made, self.path)

    @staticmethod
    def follow_readers():
        while True:
            data = os.read(Plug.inotify, 4096)
            while data:
                number, _, _, length = struct.unpack_from("iIII", data)
                data = data[16 + length:]
                if number in Plug.watched:
                    plug, pipe = Plug.watched.pop(number)
                    plug.pipes.append(pipe)
                    plug.renew()

    def send(self, kind, code, value):
        for pipe in list(self.pipes):
            try:
                os.write(pipe, struct.pack("<qqHHi", 0, 0, kind, code, value))
            except BlockingIOError:  # nobody has read it for long
                self.pipes.remove(pipe)
                os.close(pipe)

    def button(self, number, down=True):
        self.send(EV_KEY, self.device.keys[number], int(down))

    def axis(self, code, value):
        self.send(EV_ABS, code, value)

    def lose_events(self):
        """The kernel's queue has overflowed: the reader has to ask for the state, which is answered as at the start."""
        self.send(EV_SYN, SYN_DROPPED, 0)
        self.send(EV_SYN, SYN_REPORT, 0)

    def entry(self, prefix=""):
        return f"{os.environ['UMOCKDEV_DIR']}/sys/class/input/{prefix}{self.device.file}"

    def unplug(self):
        Plug.watched = {number: one for number, one in Plug.watched.items() if one[0] is not self}
        os.unlink(self.path)
        os.rename(self.entry(), self.entry("unplugged_"))

    def plug_in_denied(self):
        """The user may not open the device, until renew()."""
        os.rename(self.entry("unplugged_"), self.entry())
