#include "app/devices/calibrate_stick.h"

#include <chrono>
#include <cstdio>
#include <stdexcept>
#include <thread>

#include <fmt/core.h>

#include "app/devices/answers.h"
#include "app/devices/calibration_talk.h"
#include "app/devices/open_stick.h"
#include "app/devices/stop_signals.h"
#include "app/print_out.h"

namespace gearshift {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kTick{1};
constexpr std::chrono::seconds kOpensWithin{10};

void end_where_asked() {
  if (StopSignals::asked()) throw CalibrationEnded("ended: the motors are off");
}

// What was known before and still fits; or nothing but who it is.
KnownStick start_from(const ListedStick& stick, const fs::path& folder, bool again) {
  KnownStick fresh;
  fresh.calibration.vendor = stick.identity.vendor;
  fresh.calibration.product = stick.identity.product;
  fresh.calibration.serial = stick.identity.serial;
  fresh.calibration.name = stick.identity.name;
  fresh.report_descriptor = stick.report_descriptor;
  if (again) return fresh;
  const std::optional<KnownStick> known = read_known(folder, stick.identity);
  if (!known) return fresh;
  const bool is_same = known->report_descriptor.empty() || known->report_descriptor == fresh.report_descriptor;
  if (is_same) return KnownStick{known->calibration, fresh.report_descriptor};
  print_line("It reports otherwise than when it was calibrated: nothing of that counts any more.");
  return fresh;
}

void wait_until_open(LeverKeeper& keeper, const std::string& name) {
  const Clock::time_point end = Clock::now() + kOpensWithin;
  while (!keeper.connected()) {
    end_where_asked();
    if (Clock::now() > end)
      throw std::runtime_error(keeper.take_news().value_or(fmt::format("{} does not answer", name)));
    std::this_thread::sleep_for(kTick);
  }
}

class OpenStick {
 public:
  OpenStick(const KnownStick& stick, PortOpener open)
      : driver_(stick.report_descriptor), keeper_(driver_, std::move(open), kTickNs) {
    wait_until_open(keeper_, stick_name(identity_of(stick.calibration)));
  }
  PidDriver& driver() { return driver_; }
  PidAbility ability() const { return keeper_.ability().value_or(PidAbility{}); }
  void tell_news() {
    while (const std::optional<std::string> news = keeper_.take_news()) print_line(*news);
  }

 private:
  PidDriver driver_;
  LeverKeeper keeper_;
};

std::int64_t tick(OpenStick& stick) {
  end_where_asked();
  stick.tell_news();
  std::this_thread::sleep_for(kTick);
  return std::chrono::nanoseconds(Clock::now().time_since_epoch()).count();
}

std::string ask(OpenStick& stick, Answers& answers, const std::string& question) {
  print_line(question);
  for (;;) {
    if (const std::optional<std::string> line = answers.line(0.2)) return *line;
    end_where_asked();
    stick.tell_news();
    if (answers.ended()) throw CalibrationEnded("standard input is at its end");
  }
}

// Returns what is missing at the end, in words.
std::string talk_through(OpenStick& stick, KnownStick& known, const fs::path& folder, int file) {
  Answers answers(file);
  CalibrationTalk talk;
  talk.say = print_line;
  talk.ask = [&](const std::string& question) { return ask(stick, answers, question); };
  talk.keep = [&](const DeviceCalibration& calibration) {
    known.calibration = calibration;
    keep_known(known, folder);
  };
  Calibrator calibrator(
      stick.driver(), [&stick] { return tick(stick); }, known.calibration);
  for (const std::string& note : stick.ability().notes) print_line(note);
  try {
    calibrate(calibrator, stick.ability().spring, talk);
  } catch (const CalibrationEnded& ended) {
    print_line(ended.what());
  }
  return missing_words(calibrator.calibration());
}

}  // namespace

int calibrate_stick(const std::string& wanted, const fs::path& folder, bool again, int answers) {
  const StopSignals signals;
  const std::vector<ListedStick> plugged = list_sticks(usb_hid_devices(), again ? fs::path() : folder);
  const ListedStick stick = chosen_stick(wanted, plugged);
  check_can_push(stick);
  const auto open = [identity = stick.identity, interface = stick.interface] {
    return open_usb_hid(identity, interface);
  };
  KnownStick known = start_from(stick, folder, again);
  OpenStick held(known, open);
  print_line(fmt::format("{} ({}). Ctrl-C ends at any time: its motors are off then, and what was measured is kept.",
                         stick_name(stick.identity), stick_id(stick.identity)));
  const std::string missing = talk_through(held, known, folder, answers);
  const std::string file = calibration_file(folder, stick.identity).string();
  if (missing.empty()) {
    print_line(fmt::format("Calibrated: {}", file));
    return 0;
  }
  print_line(fmt::format("Still missing: {}. The same command goes on from here.", missing));
  return 1;
}

}  // namespace gearshift
