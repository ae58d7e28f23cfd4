// Game controllers: pads, sticks, wheels, pedals and shifters, as Linux's input devices (evdev) report them, without
// their force. GLFW lists only those of them that have axes, and does not read which buttons are held at the start; it
// is used for its table of game pads.
#pragma once

#include <sys/stat.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gearshift::engine {

// Controls of a game pad, the same for every model.
struct Gamepad {
  std::array<float, 6> axes{};              // [-1, 1] GLFW_GAMEPAD_AXIS_LEFT_X, ...; a released trigger is -1
  std::array<unsigned char, 15> buttons{};  // 0 or 1; GLFW_GAMEPAD_BUTTON_A, ...
};

struct Controller {
  std::string name;
  std::string id;           // "046d:c24f": USB vendor and product
  std::string guid;         // identifies the model, as GLFW and SDL write it
  std::string file;         // "event5": name of the device file
  std::vector<float> axes;  // [-1, 1] in the order of the kernel's codes
  // 0 or 1, in the order of the kernel's codes, then up, right, down, left per hat. A button that was pressed and released
  // since the last poll is 1.
  std::vector<unsigned char> buttons;
  std::vector<std::size_t> tapped;  // those of `buttons` that are up again
  std::vector<unsigned> codes;      // the kernel's code of each button; the directions of hats have none
  std::optional<Gamepad> gamepad;   // if GLFW knows the model as a game pad
  bool can_be_read = true;          // false: the user lacks permission; there are no axes and no buttons
};

class Controllers {
 public:
  // `grant_delay`: how long after its appearance a controller that may not be read is left out. udev grants access some
  // time after the kernel has made the device file.
  explicit Controllers(std::chrono::milliseconds grant_delay = std::chrono::seconds(2));
  ~Controllers();
  Controllers(const Controllers&) = delete;
  Controllers& operator=(const Controllers&) = delete;

  // Returns the controllers that are plugged in now, in the order of their ports, so that equal ones keep their order. Passes
  // over devices that only look like controllers: keyboards,
  // mice, touchpads, motion sensors, and Steam's copy of another controller. Marks game pads only while GLFW is in use.
  const std::vector<Controller>& poll();

 private:
  struct Node;

  bool is_outdated() const;
  void scan();

  std::chrono::milliseconds grant_delay_;
  std::vector<std::unique_ptr<Node>> nodes_;
  std::vector<Controller> controllers_;
  timespec changed_{};       // last change of the folder of device files at the last scan
  bool is_settled_ = false;  // it had not changed since the scan before
  std::chrono::steady_clock::time_point scanned_;
};

// Returns the controllers that are plugged in, for a program without a window. Marks game pads only if there is a
// display, because GLFW needs one.
std::vector<Controller> list_controllers();

}  // namespace gearshift::engine
