// Tests device driver, calibration and haptic loop with the real libusb and the real kernel. The test takes a stick
// over from the kernel's driver, calibrates it, shifts through every gear with a simulated hand, and returns the stick.
// Runs only in the guest.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "haptics/hardware/calibrator.h"
#include "haptics/hardware/pid_lever.h"
#include "haptics/hardware/stick_connection.h"
#include "haptics/loop/haptic_event.h"
#include "haptics/loop/haptic_loop.h"
#include "haptics/loop/shift_script.h"
#include "haptics/rt/broadcast.h"
#include "haptics/rt/realtime_thread.h"
#include "haptics/usb/usb_hid.h"
#include "tests/guest/guest_bench.h"
#include "tests/haptics/device/still_hand.h"
#include "tests/support/gates.h"

using namespace gearshift::haptics;
using namespace gearshift::test;

namespace {

constexpr std::int64_t kTick = 1'000'000;  // [ns] period of the stick's outputs

std::int64_t monotonic_ns() {
  return std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Returns the name of the kernel driver that is bound to the stick's interface; empty if none is.
std::string kernel_driver() {
  std::error_code none;
  return std::filesystem::read_symlink("/sys/bus/usb/devices/1-1:1.0/driver", none).filename();
}

HidIdentity identity_of(const PluggedStick& plugged) {
  HidIdentity identity;
  identity.vendor = static_cast<std::uint16_t>(plugged.vendor());
  identity.product = static_cast<std::uint16_t>(plugged.product());
  return identity;
}

// The PID driver, connected to a stick as in the program.
struct DrivenStick {
  explicit DrivenStick(const PluggedStick& plugged)
      : driver(plugged.stick.report_descriptor()),
        connection(
            driver, [identity = identity_of(plugged)] { return open_usb_hid(identity); }, kTick) {
    REQUIRE(becomes_true([&] { return connection.connected(); }, 20.0));
  }
  PidDriver driver;
  StickConnection connection;
};

// The part of a calibration that does not come from measurements with forces: the stops in counts, the travel, the full
// force.
DeviceCalibration taught_calibration(const EmulatedStickConfig& config, const PluggedStick& plugged) {
  const bool sidewinder = config.family == StickFamily::sidewinder, vjoy = config.family == StickFamily::vjoy;
  LeverAxisCalibration axis;
  axis.low = sidewinder ? -512.0 : vjoy ? 0.0 : -32767.0;
  axis.high = sidewinder ? 511.0 : 32767.0;
  axis.centre = vjoy ? 16384.0 : 0.0;
  axis.travel = 2.0 * config.half_travel;
  axis.full_force = config.full_force;
  DeviceCalibration calibration;
  calibration.vendor = identity_of(plugged).vendor;
  calibration.product = identity_of(plugged).product;
  calibration.select = calibration.shift = axis;
  calibration.shift.usage = 0x31;
  std::swap(calibration.shift.low, calibration.shift.high);  // counts decrease away from the user
  return calibration;
}

void copy_measured(LeverAxisCalibration& axis, const LeverAxisCalibration& measured) {
  axis.handle = measured.handle;
  axis.spring_sign = measured.spring_sign;
  axis.spring_stiffness = measured.spring_stiffness;
  axis.spring_dead_band = measured.spring_dead_band;
}

// Calibrates a stick. If `measured` is null, measures everything. Otherwise measures only the polarity and copies the
// rest from `measured`, because the families have the same mechanism and measuring takes most of the guest's time.
DeviceCalibration calibrated(const EmulatedStickConfig& config, const DeviceCalibration* measured) {
  IdleHand idle_hand;
  PluggedStick plugged(config, idle_hand);
  CHECK(becomes_true([] { return kernel_driver() == "usbhid"; }, 20.0));
  DrivenStick driven(plugged);
  CHECK(kernel_driver() == "usbfs");
  const CalibrationTick tick = [] {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return monotonic_ns();
  };
  Calibrator calibrator(driven.driver, tick, taught_calibration(config, plugged));
  try {
    std::printf("  %s\n", calibrator.measure_polarity().c_str());
    if (measured == nullptr) {
      std::printf("  %s\n", calibrator.measure_timing().c_str());
      std::printf("  %s\n", calibrator.measure_handle().c_str());
      std::printf("  %s\n", calibrator.measure_springs().c_str());
    }
  } catch (const CalibrationRefused& refused) {
    while (const auto message = driven.connection.take_message()) MESSAGE(*message);
    FAIL(std::string(refused.what()));
  }
  DeviceCalibration calibration = calibrator.calibration();
  if (measured == nullptr) return calibration;
  calibration.timing = measured->timing;
  copy_measured(calibration.select, measured->select);
  copy_measured(calibration.shift, measured->shift);
  return calibration;
}

// A hand that stays at the start position until begin() is called, and then follows its script.
class WaitingHand final : public HandDriver {
 public:
  WaitingHand(glm::dvec2 start, std::vector<HandStroke> strokes, double period)
      : start_(start), script_(touring_hand(start), std::move(strokes), period) {}

  void begin() { started_ = true; }
  double duration() const { return script_.duration(); }

  HandTarget next(double time, glm::dvec2 lever) noexcept override {
    HandTarget target;
    target.position = start_;
    if (!started_) return target;
    if (start_time_ < 0.0) start_time_ = time;
    return script_.next(time - start_time_, lever);
  }

 private:
  glm::dvec2 start_;
  ScriptedHand script_;
  std::atomic<bool> started_{false};
  double start_time_ = -1.0;  // [s]
};

HapticConfig config_at_500_hz() {
  HapticConfig config;
  config.rate = 500.0;
  return config;
}

// The haptic loop on its own thread, and the events that the loop reports.
class RunningLoop {
 public:
  RunningLoop(const DeviceCalibration& calibration, PidDriver& driver, const Gate& gate)
      : config_(config_at_500_hz()),
        lever_(calibration, driver, period_s(config_)),
        loop_(config_, gate, lever_, load_, inputs_) {
    RealtimeConfig thread;
    thread.period_ns = period_ns(config_);
    thread.spin_ns = 0;
    thread_.start(thread, [this](const CycleCall& call) {
      loop_.cycle(call.deadline_ns, call.skipped);
      cycles_.push(loop_.published());
    });
  }
  ~RunningLoop() {
    thread_.stop();
    lever_.release();
  }

  int delay() const { return lever_.spec().delay; }
  double wall() const { return loop_.admitted().tuning.wall_stiffness; }
  GuardState guard() const {
    const std::optional<TraceSample> newest = cycles_.newest();
    return newest ? newest->out.guard : GuardState::idle;
  }
  bool arm() {
    inputs_.commands.push(LoopCommand::arm);
    return becomes_true([&] { return guard() == GuardState::running; }, 5.0);
  }
  // Returns the gears engaged since the last call.
  std::vector<int> gears() {
    std::vector<int> engaged;
    std::vector<HapticEvent> events;
    for (TraceSample cycle; reader_.pop(cycle);) detector_.update(cycle, events);
    for (const HapticEvent& event : events)
      if (event.kind == EventKind::gear_engaged) engaged.push_back(static_cast<int>(event.value));
    return engaged;
  }

 private:
  HapticConfig config_;
  NoLoad load_;
  LoopInputs inputs_;
  PidLever lever_;
  HapticLoop loop_;
  Broadcast<TraceSample> cycles_{8192};
  Broadcast<TraceSample>::Reader reader_{cycles_};
  EventDetector detector_;
  RealtimeThread thread_;
};

bool is_silent(PluggedStick& plugged) {
  return plugged.with_stick(
      [](EmulatedStick& stick) { return stick.force() == glm::dvec2(0.0) && !stick.actuators_on(); });
}

// Shifts through every gear in order. Afterwards the motors must be off before the stick is returned.
void drive_tour(PluggedStick& plugged, WaitingHand& hand, const DeviceCalibration& calibration, const Gate& gate) {
  DrivenStick driven(plugged);
  std::vector<int> engaged;
  double strongest = 0.0;
  {
    RunningLoop running(calibration, driven.driver, gate);
    std::printf("  500 Hz, delay %d cycles, walls of %.0f N/m\n", running.delay(), running.wall());
    REQUIRE(running.arm());
    hand.begin();
    const auto is_over = [&] {
      for (int gear : running.gears()) engaged.push_back(gear);
      strongest = std::max(strongest, plugged.with_stick([](EmulatedStick& s) { return glm::length(s.force()); }));
      return engaged.size() >= tour_order(gate).size() || running.guard() != GuardState::running;
    };
    CHECK(becomes_true(is_over, hand.duration() + 5.0));
    CHECK(running.guard() == GuardState::running);
  }
  CHECK(becomes_true([&] { return is_silent(plugged); }, 0.05));
  CHECK(engaged == tour_order(gate));
  CHECK(strongest > 2.0);
  std::printf("  %zu gears, at most %.1f N\n", engaged.size(), strongest);
  while (const auto message = driven.connection.take_message()) MESSAGE(*message);
}

}  // namespace

TEST_CASE("the six-gear tour: a stick is taken from the kernel's driver, calibrated, driven and returned") {
  const Gate gate = paper_gate();
  const glm::dvec2 start = rest_position(gate, kNeutralGear);
  std::optional<DeviceCalibration> measured;
  for (StickFamily family : {StickFamily::openffboard, StickFamily::sidewinder, StickFamily::vjoy}) {
    CAPTURE(std::string(to_string(family)));
    std::printf("%s\n", to_string(family));
    EmulatedStickConfig config;
    config.family = family;
    config.input_interval = 0.002;
    const DeviceCalibration calibration = calibrated(config, measured ? &*measured : nullptr);
    if (!measured) measured = calibration;
    // A positive device force comes from the right and from the user's side (PID 1.0 section 4.2), so it pushes to the
    // left (negative x) and away from the user (positive y).
    CHECK(calibration.select.constant_sign == -1);
    CHECK(calibration.shift.constant_sign == 1);

    config.lever.hand = kGripHand;
    WaitingHand hand(start, shift_strokes(gate, start, tour_order(gate)), config.plant_period);
    PluggedStick plugged(config, hand);
    drive_tour(plugged, hand, calibration, gate);
    CHECK(becomes_true([] { return kernel_driver() == "usbhid"; }, 5.0));
  }
  // True values of the emulated mechanism: masses of 0.095 kg and 0.086 kg, springs of 400 N/m.
  CHECK(measured->select.handle.mass == doctest::Approx(0.095).epsilon(0.1));
  CHECK(measured->shift.handle.mass == doctest::Approx(0.086).epsilon(0.1));
  CHECK(measured->select.spring_sign == 1);
  CHECK(measured->shift.spring_sign == 1);
  CHECK(measured->select.spring_stiffness == doctest::Approx(400.0).epsilon(0.1));
}

TEST_CASE("a stick unplugged while it pushes is found again without udev, silent until the forces are turned on") {
  const Gate gate = paper_gate();
  EmulatedStickConfig config;
  config.family = StickFamily::openffboard;
  config.input_interval = 0.002;
  StillHand hand(hand_pushing({6.0, 0.0}));  // pushes with 6 N, to the right end of the neutral aisle
  PluggedStick plugged(config, hand);
  DeviceCalibration calibration = taught_calibration(config, plugged);
  calibration.timing = {0.002, 0.001, 0.001, 0.0};
  for (LeverAxisCalibration* axis : {&calibration.select, &calibration.shift}) {
    axis->handle = kPaperAxisY;
    axis->constant_sign = axis == &calibration.select ? -1 : 1;
  }
  DrivenStick driven(plugged);
  RunningLoop running(calibration, driven.driver, gate);
  REQUIRE(running.arm());
  const auto pushes = [&] { return plugged.with_stick([](EmulatedStick& stick) { return stick.force().x < -3.0; }); };
  CHECK(becomes_true(pushes, 5.0));

  plugged.pull_out();
  CHECK(becomes_true([&] { return !driven.connection.connected(); }, 5.0));
  CHECK(becomes_true([&] { return running.guard() == GuardState::damped || running.guard() == GuardState::released; },
                     5.0));
  plugged.plug_in();
  CHECK(becomes_true([&] { return driven.connection.connected(); }, 20.0));
  CHECK(kernel_driver() == "usbfs");
  CHECK_FALSE(becomes_true([&] { return !is_silent(plugged); }, 1.0));
  REQUIRE(running.arm());
  CHECK(becomes_true(pushes, 5.0));
  while (const auto message = driven.connection.take_message()) std::printf("  %s\n", message->c_str());
}
