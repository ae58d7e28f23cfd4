#include "app/shifter/virtual_joystick.h"

#include <fcntl.h>
#include <linux/uinput.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include <fmt/format.h>

namespace gearshift::shifter {
namespace {

constexpr const char* kUinput = "/dev/uinput";
constexpr int kJoystickButtons = 16;

[[noreturn]] void fail_uinput(int reason) {
  if (reason == EACCES || reason == EPERM)
    throw std::runtime_error(
        "/dev/uinput may not be used by this user; install assets/udev/70-gearshift.rules as its first lines say");
  if (reason == ENOENT || reason == ENODEV || reason == ENXIO)
    throw std::runtime_error("/dev/uinput is missing; `modprobe uinput` as root loads it");
  throw std::runtime_error(fmt::format("no virtual joystick can be made with /dev/uinput: {}", std::strerror(reason)));
}

void add_axis(int file, const JoystickAxis& axis) {
  uinput_abs_setup setup{};
  setup.code = static_cast<__u16>(axis.code);
  setup.absinfo.value = axis.value;
  setup.absinfo.minimum = axis.minimum;
  setup.absinfo.maximum = axis.maximum;
  setup.absinfo.fuzz = axis.fuzz;
  setup.absinfo.flat = axis.flat;
  if (ioctl(file, UI_ABS_SETUP, &setup) != 0) fail_uinput(errno);
}

std::vector<JoystickAxis> with_x_and_y(std::span<const JoystickAxis> axes) {
  std::vector<JoystickAxis> all(axes.begin(), axes.end());
  for (const int code : {ABS_X, ABS_Y}) {
    const auto is_it = [code](const JoystickAxis& axis) { return axis.code == code; };
    if (std::none_of(axes.begin(), axes.end(), is_it)) all.push_back({code});
  }
  return all;
}

void set_up(int file, int buttons, std::span<const JoystickAxis> axes) {
  if (ioctl(file, UI_SET_EVBIT, EV_KEY) != 0 || ioctl(file, UI_SET_EVBIT, EV_ABS) != 0) fail_uinput(errno);
  for (int i = 0; i < buttons; ++i)
    if (ioctl(file, UI_SET_KEYBIT, button_code(i)) != 0) fail_uinput(errno);
  for (const JoystickAxis& axis : with_x_and_y(axes)) add_axis(file, axis);
  uinput_setup setup{};
  setup.id.bustype = BUS_VIRTUAL;
  setup.id.vendor = setup.id.product = setup.id.version = 1;  // no number is registered for virtual devices
  std::strcpy(setup.name, "gearshift shifter");
  if (ioctl(file, UI_DEV_SETUP, &setup) != 0 || ioctl(file, UI_DEV_CREATE) != 0) fail_uinput(errno);
}

}  // namespace

// As the kernel's own driver numbers the buttons of a USB joystick.
int button_code(int index) noexcept {
  return index < kJoystickButtons ? BTN_JOYSTICK + index : BTN_TRIGGER_HAPPY + index - kJoystickButtons;
}

VirtualJoystick::VirtualJoystick(int buttons, std::span<const JoystickAxis> axes)
    : file_(open(kUinput, O_WRONLY | O_NONBLOCK | O_CLOEXEC)) {
  if (file_ < 0) fail_uinput(errno);
  try {
    set_up(file_, buttons, axes);
  } catch (const std::runtime_error&) {
    close(file_);
    throw;
  }
}

VirtualJoystick::~VirtualJoystick() {
  (void)ioctl(file_, UI_DEV_DESTROY);
  close(file_);
}

void VirtualJoystick::set_button(int index, bool is_down) {
  write_event(EV_KEY, button_code(index), is_down ? 1 : 0);
}

void VirtualJoystick::set_axis(int code, int value) {
  write_event(EV_ABS, code, value);
}

void VirtualJoystick::publish() {
  if (!has_changes_) return;
  write_event(EV_SYN, SYN_REPORT, 0);
  has_changes_ = false;
}

void VirtualJoystick::write_event(int type, int code, int value) {
  input_event event{};
  event.type = static_cast<__u16>(type);
  event.code = static_cast<__u16>(code);
  event.value = value;
  if (write(file_, &event, sizeof event) != static_cast<ssize_t>(sizeof event))
    throw std::runtime_error(fmt::format("the virtual joystick accepts no events: {}", std::strerror(errno)));
  has_changes_ = true;
}

PassedAxes::PassedAxes(const std::string& file) : file_(open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)) {
  if (file_ < 0) throw std::runtime_error(fmt::format("{}: cannot be opened: {}", file, std::strerror(errno)));
  std::array<unsigned char, ABS_CNT / 8> bits{};
  if (ioctl(file_, EVIOCGBIT(EV_ABS, bits.size()), bits.data()) >= 0) {
    for (int code = 0; code < ABS_CNT; ++code) {
      input_absinfo info{};
      const bool is_there = (bits[static_cast<std::size_t>(code / 8)] >> (code % 8) & 1) != 0;
      if (is_there && ioctl(file_, EVIOCGABS(code), &info) == 0)
        axes_.push_back({code, info.value, info.minimum, info.maximum, info.fuzz, info.flat});
    }
  }
  if (!axes_.empty()) return;
  close(file_);
  throw std::runtime_error(fmt::format("{}: is no input device with axes", file));
}

PassedAxes::~PassedAxes() {
  close(file_);
}

bool PassedAxes::pass_to(VirtualJoystick& joystick) {
  input_event event{};
  while (read(file_, &event, sizeof event) == static_cast<ssize_t>(sizeof event)) {
    if (event.type == EV_ABS) joystick.set_axis(event.code, event.value);
    if (event.type == EV_SYN && event.code == SYN_DROPPED) read_all(joystick);
  }
  return errno == EAGAIN || errno == EINTR;
}

// The kernel has dropped events, so the axes' current values are asked for.
void PassedAxes::read_all(VirtualJoystick& joystick) {
  for (const JoystickAxis& axis : axes_) {
    input_absinfo info{};
    if (ioctl(file_, EVIOCGABS(axis.code), &info) == 0) joystick.set_axis(axis.code, info.value);
  }
}

}  // namespace gearshift::shifter
