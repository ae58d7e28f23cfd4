// A joystick that exists only in the kernel (uinput), and the axes of a real one that it passes on (evdev).
//
// This work is based on:
// Linux, Documentation/input/uinput.rst, event-codes.rst
#pragma once

#include <span>
#include <string>
#include <vector>

namespace gearshift::shifter {

struct JoystickAxis {
  int code = 0;  // ABS_X, ...
  int value = 0, minimum = -1, maximum = 1, fuzz = 0, flat = 0;
};

class VirtualJoystick {
 public:
  static constexpr int kMaxButtons = 56;  // 16 of a joystick, then 40 more

  // The joystick has X and Y in any case, because many programs take a device without them for something else. Throws
  // std::runtime_error with one sentence.
  VirtualJoystick(int buttons, std::span<const JoystickAxis> axes);
  ~VirtualJoystick();
  VirtualJoystick(const VirtualJoystick&) = delete;
  VirtualJoystick& operator=(const VirtualJoystick&) = delete;

  void set_button(int index, bool is_down);  // from 0 on
  void set_axis(int code, int value);
  void publish();  // makes the changes since the last call visible

 private:
  void write_event(int type, int code, int value);

  int file_;
  bool has_changes_ = false;
};

// The kernel's code of a button.
int button_code(int index) noexcept;

// The axes of an input device, such as pedals.
class PassedAxes {
 public:
  explicit PassedAxes(const std::string& file);  // /dev/input/event...; throws std::runtime_error with one sentence
  ~PassedAxes();
  PassedAxes(const PassedAxes&) = delete;
  PassedAxes& operator=(const PassedAxes&) = delete;

  const std::vector<JoystickAxis>& axes() const noexcept { return axes_; }
  // Passes on what moved since the last call; does not wait. Returns false once the device is gone.
  bool pass_to(VirtualJoystick& joystick);

 private:
  void read_all(VirtualJoystick& joystick);

  int file_;
  std::vector<JoystickAxis> axes_;
};

}  // namespace gearshift::shifter
