// Pedals of an emulated kernel input device (evdev), read through the real GLFW and a window. Runs under umockdev-run,
// whose recording tests/data/glfw_stick answers every query about the device. This file sends the events.
#include <fcntl.h>
#include <linux/input.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "app/ui/input/axis_detector.h"
#include "app/ui/input/driver_input.h"
#include "engine/window/window.h"

using namespace gearshift::engine;
using namespace gearshift::ui;

namespace {

// Sends events to the file from which GLFW reads the device. SYN_REPORT is not sent, because GLFW would then query all
// axes again and get their initial values.
class AcmePedals {
 public:
  AcmePedals() {
    const char* root = std::getenv("UMOCKDEV_DIR");
    if (root == nullptr) throw std::runtime_error("this test runs beneath umockdev-run");
    const std::string device = std::string(root) + "/dev/input/event5";
    unlink(device.c_str());
    const bool is_made = mkfifo(device.c_str(), 0600) == 0;
    descriptor_ = is_made ? open(device.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC) : -1;
    if (descriptor_ < 0) throw std::runtime_error("no events can be sent to the emulated device");
  }
  ~AcmePedals() { close(descriptor_); }
  AcmePedals(const AcmePedals&) = delete;
  AcmePedals& operator=(const AcmePedals&) = delete;

  void press_pedal(int value) { send(EV_ABS, ABS_THROTTLE, value); }
  void press_button(bool down) { send(EV_KEY, BTN_THUMB, down ? 1 : 0); }

 private:
  void send(unsigned type, unsigned code, int value) {
    input_event event{};
    event.type = static_cast<unsigned short>(type);
    event.code = static_cast<unsigned short>(code);
    event.value = value;
    if (write(descriptor_, &event, sizeof event) != sizeof event) throw std::runtime_error("an event was not taken");
  }

  int descriptor_ = -1;
};

Bindings foot_on_pedals() {
  Bindings bindings;
  bindings.throttle = AxisBinding{0, 2, -1.0, 1.0, 0.0};
  bindings.throttle->stick = "acme";
  bindings.pad_buttons = {{Action::stop, {1}}};
  bindings.button_stick = "acme";
  return bindings;
}

}  // namespace

TEST_CASE("a kernel input device is listed; its pedal moves the throttle, its button stops, and its axis is learnt") {
  AcmePedals pedals;
  const std::vector<PadState> sticks = glfw_sticks();
  REQUIRE(sticks.size() == 1);
  CHECK(sticks[0].name == "Acme Pedals");
  // SDL's GUID contains bus 3 (USB), vendor 0x1234, product 0x5678 and version 0x0100, each in four little-endian
  // bytes.
  CHECK(sticks[0].guid == "03000000341200007856000000010000");
  CHECK(sticks[0].axes == std::vector<float>{65536.0f / 65535.0f - 1.0f, 65536.0f / 65535.0f - 1.0f, -1.0f});
  CHECK(sticks[0].buttons == std::vector<unsigned char>(6, 0));

  Window window(320, 240, "sticks");
  DriverInput driver({foot_on_pedals()});
  AxisDetector detector(AxisDetector::Control::pedal);
  const auto frame = [&] {
    const WindowInput& input = window.poll();
    driver.update(input, 0.01, false, false);
    return input.pads;
  };
  CHECK_FALSE(sticks[0].is_pad);
  detector.record_move(frame());
  pedals.press_pedal(-120);  // the first report is no motion
  detector.record_move(frame());
  CHECK(driver.controls().pedals.throttle == 0.0);
  for (const int value : {-100, -50, 0, 63, 127, 127, 63, -127}) {
    pedals.press_pedal(value);
    detector.record_move(frame());
    CHECK(driver.controls().pedals.throttle == doctest::Approx((value + 127.0) / 254.0));
  }
  pedals.press_button(true);
  frame();
  CHECK(driver.pressed() == std::vector{Action::stop});
  pedals.press_button(false);
  for (int i = 0; i < 30; ++i) detector.record_rest(frame());
  CHECK(driver.pressed().empty());

  const AxisBinding pedal = detector.result();
  CHECK(pedal.stick == "Acme Pedals");
  CHECK(pedal.axis == 2);
  CHECK(pedal.from == -1.0);
  CHECK(pedal.to == 1.0);
}
