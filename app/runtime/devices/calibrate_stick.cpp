#include "app/runtime/devices/calibrate_stick.h"

#include <chrono>
#include <cstdio>
#include <stdexcept>
#include <thread>

#include <fmt/core.h>

#include "app/base/console.h"
#include "app/base/line_reader.h"
#include "app/base/stop_signals.h"
#include "app/runtime/devices/calibration_dialog.h"
#include "app/runtime/devices/open_stick.h"

namespace gearshift::runtime {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kTick{1};
constexpr std::chrono::seconds kOpensWithin{10};

void throw_if_stopped() {
  if (base::StopSignals::requested()) throw CalibrationEnded("Stopped. The motors are off.");
}

// The calibration to start from: the earlier one if the stick's reports have not changed and `again` is false, else a
// new one that contains only the stick's identity.
KnownStick starting_calibration(const ListedStick& stick, const fs::path& folder, bool again) {
  KnownStick fresh;
  fresh.calibration.vendor = stick.identity.vendor;
  fresh.calibration.product = stick.identity.product;
  fresh.calibration.serial = stick.identity.serial;
  fresh.calibration.name = stick.identity.name;
  fresh.report_descriptor = stick.report_descriptor;
  if (again) return fresh;
  const std::optional<KnownStick> known = read_known_stick(folder, stick.identity);
  if (!known) return fresh;
  const bool is_same = known->report_descriptor.empty() || known->report_descriptor == fresh.report_descriptor;
  if (is_same) return KnownStick{known->calibration, fresh.report_descriptor};
  base::print_line(
      "The stick's report format has changed since the last calibration, so the old calibration is discarded.");
  return fresh;
}

void wait_until_open(haptics::StickConnection& keeper, const std::string& name) {
  const Clock::time_point end = Clock::now() + kOpensWithin;
  while (!keeper.connected()) {
    throw_if_stopped();
    if (Clock::now() > end)
      throw std::runtime_error(keeper.take_message().value_or(fmt::format("{} does not respond", name)));
    std::this_thread::sleep_for(kTick);
  }
}

class OpenStick {
 public:
  OpenStick(const KnownStick& stick, haptics::PortOpener open)
      : driver_(stick.report_descriptor, stick.calibration.style), connection_(driver_, std::move(open), kTickNs) {
    wait_until_open(connection_, stick_name(identity_of(stick.calibration)));
  }
  haptics::PidDriver& driver() { return driver_; }
  haptics::PidAbility ability() const { return connection_.ability().value_or(haptics::PidAbility{}); }
  void report_message() {
    while (const std::optional<std::string> news = connection_.take_message()) base::print_line(*news);
  }

 private:
  haptics::PidDriver driver_;
  haptics::StickConnection connection_;
};

std::int64_t tick(OpenStick& stick) {
  throw_if_stopped();
  stick.report_message();
  std::this_thread::sleep_for(kTick);
  return std::chrono::nanoseconds(Clock::now().time_since_epoch()).count();
}

std::string ask(OpenStick& stick, base::LineReader& answers, const std::string& question) {
  base::print_line(question);
  for (;;) {
    if (const std::optional<std::string> line = answers.read_line(0.2)) return *line;
    throw_if_stopped();
    stick.report_message();
    if (answers.at_end()) throw CalibrationEnded("Stopped because standard input was closed.");
  }
}

// Runs the calibration dialog and saves its results. Returns a list of the measurements that are still missing.
std::string run_dialog(OpenStick& stick, KnownStick& known, const fs::path& folder, int file) {
  base::LineReader answers(file);
  CalibrationDialog dialog;
  dialog.print = base::print_line;
  dialog.ask = [&](const std::string& question) { return ask(stick, answers, question); };
  dialog.save = [&](const haptics::DeviceCalibration& calibration) {
    known.calibration = calibration;
    save_known_stick(known, folder);
  };
  haptics::Calibrator calibrator(
      stick.driver(), [&stick] { return tick(stick); }, known.calibration, stick.ability().spring);
  for (const std::string& note : stick.ability().notes) base::print_line(note);
  try {
    calibrate(calibrator, stick.ability(), dialog);
  } catch (const CalibrationEnded& ended) {
    base::print_line(ended.what());
  }
  for (const std::string& row : calibration_table(calibrator.calibration())) base::print_line(row);
  return describe_missing(calibrator.calibration());
}

}  // namespace

int calibrate_stick(const std::string& wanted, const fs::path& folder, bool again, int answers) {
  const base::StopSignals signals;
  const std::vector<ListedStick> plugged = list_sticks(haptics::usb_hid_devices(), again ? fs::path() : folder);
  const ListedStick stick = select_stick(wanted, plugged);
  check_has_forces(stick);
  const auto open = [identity = stick.identity, interface = stick.interface] {
    return haptics::open_usb_hid(identity, interface);
  };
  KnownStick known = starting_calibration(stick, folder, again);
  OpenStick held(known, open);
  base::print_line(
      fmt::format("Calibrating {} ({}). Press Ctrl-C at any time to stop: the motors turn off, and finished "
                  "measurements are saved.",
                  stick_name(stick.identity), stick_id(stick.identity)));
  const std::string missing = run_dialog(held, known, folder, answers);
  const std::string file = haptics::calibration_file(folder, stick.identity).string();
  if (missing.empty()) {
    base::print_line(fmt::format("Calibrated: {}", file));
    return 0;
  }
  base::print_line(fmt::format("Still missing: {}. Run the same command to continue.", missing));
  return 1;
}

}  // namespace gearshift::runtime
