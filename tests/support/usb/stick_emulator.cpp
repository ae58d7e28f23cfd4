// Runs a program with an emulated force-feedback stick plugged in beneath its libusb:
//
//   umockdev-wrapper stick_emulator --family sidewinder [options] -- PROGRAM ARGUMENTS
//
// Times are seconds from the program's start, with --tour from when the motors first came on; at 0 it happens before the
// program looks. Its exit status is the program's; at the end it says on stderr how long after the start, each fault, unplug,
// stop and continue, and the program's end the emulated motors still pushed.

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <mutex>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>
#include <glm/geometric.hpp>

#include "haptics/gate/gate_compiler.h"
#include "haptics/gate/gate_layout.h"
#include "haptics/joystick/kinematics.h"
#include "tests/support/usb/mock_usb.h"
#include "tests/support/usb/ordered_hand.h"
#include "tests/support/usb/touring_hand.h"

namespace gearshift {
namespace {

using Clock = std::chrono::steady_clock;
constexpr double kFreeOfForce = 1e-9;  // [N]
constexpr double kQuietAfter = 0.5;    // [s] without force, after the program's end
constexpr double kLongest = 5.0;       // [s] that it is watched after its end

struct Options {
  std::string family = "sidewinder", tour;
  std::vector<double> unplug_at, replug_at, stop_at, continue_at;
  std::vector<std::string> faults, command;
  std::filesystem::path log, orders;
  bool own_power = false;
};

const std::map<std::string, void (*)(StickFaults&)> kFaults{
    {"jump", [](StickFaults& faults) { faults.jump = true; }},
    {"wrong-length", [](StickFaults& faults) { faults.wrong_length = true; }},
    {"stuck", [](StickFaults& faults) { faults.stuck = true; }},
    {"silent", [](StickFaults& faults) { faults.silent = true; }},
    {"refuses-effects", [](StickFaults& faults) { faults.refuses_effects = true; }},
    {"pool-full", [](StickFaults& faults) { faults.pool_full = true; }},
    {"stalls-outputs", [](StickFaults& faults) { faults.stalls_outputs = true; }},
    {"slow", [](StickFaults& faults) { faults.slow = 0.05; }},
};

StickFamily family_of(const std::string& name) {
  for (const StickFamily family : {StickFamily::sidewinder, StickFamily::openffboard, StickFamily::vjoy}) {
    if (name == stick_family_name(family)) return family;
  }
  throw std::runtime_error("--family " + name + ": sidewinder, openffboard or vjoy");
}

// A file, or the name of a gate that ships.
Gate gate_of(const std::string& name, const SimulatedLeverConfig& lever) {
  const std::filesystem::path shipped = std::filesystem::path(GEARSHIFT_ASSETS) / "gates" / (name + ".toml");
  const std::filesystem::path file = std::filesystem::exists(name) ? std::filesystem::path(name) : shipped;
  return compile_gate(read_gate_layout(file), workspace_half_extent(lever.yoke), lever.yoke.radius);
}

// What happens to the stick, and when its motors pushed last after it.
struct Event {
  double at = 0.0;  // [s] of the event's time until it happens, then of now()
  std::string name;
  std::function<void()> happen;
  double last_force = -1.0;  // [s]
};

volatile std::sig_atomic_t asked_to_end = 0;
void note_end(int) {
  asked_to_end = 1;
}

class Emulation {
 public:
  explicit Emulation(const Options& options);
  int run();

 private:
  void plan();
  void plug(bool in);
  void plan_fault(const std::string& text);
  void take_orders(double time);
  void obey(const std::string& order, double time);
  void start();
  void watch();      // one look
  bool has_ended();  // the program
  void settle();
  void say() const;
  double now() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  double event_time();  // [s]

  const Options& options_;
  EmulatedStickConfig config_;
  RestingHand resting_;
  std::unique_ptr<TouringHand> touring_;
  std::unique_ptr<OrderedHand> ordered_;
  int orders_ = -1;    // file
  std::string order_;  // as far as it has come
  std::unique_ptr<EmulatedStick> stick_;
  std::unique_ptr<StickGadget> gadget_;
  std::unique_ptr<MockUsb> usb_;
  std::ofstream log_;
  std::vector<Event> events_;  // in time
  std::size_t happened_ = 0;
  Clock::time_point start_;
  double motors_on_ = -1.0;  // [s] first
  bool is_in_ = false;       // plugged
  pid_t child_ = -1;
  int status_ = 0;
};

Emulation::Emulation(const Options& options) : options_(options) {
  config_.family = family_of(options.family);
  if (!options.tour.empty() || !options.orders.empty()) config_.lever.hand = kGripHand;  // else nobody holds it
  config_.own_power = options.own_power;
  if (!options.tour.empty()) {
    touring_ = std::make_unique<TouringHand>(gate_of(options.tour, config_.lever), config_.plant_period);
  }
  if (!options.orders.empty()) {
    orders_ = open(options.orders.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (orders_ < 0) throw std::runtime_error("cannot read " + options.orders.string());
    ordered_ = std::make_unique<OrderedHand>(config_.plant_period);
  }
  HandDriver* hand = &resting_;
  if (ordered_) hand = ordered_.get();
  if (touring_) hand = touring_.get();
  stick_ = std::make_unique<EmulatedStick>(config_, *hand);
  stick_->logs = !options.log.empty();
  if (stick_->logs) {
    log_.open(options.log);
    if (!log_) throw std::runtime_error("cannot write " + options.log.string());
  }
  gadget_ = std::make_unique<StickGadget>(*stick_);
  usb_ = std::make_unique<MockUsb>();
  plug(true);
  plan();
}

void Emulation::plug(bool in) {
  if (in) {
    const std::lock_guard<std::mutex> lock(usb_->mutex());
    stick_->control({0x80, 0, 0, 0, 2}, {});  // the host enumerates it: it begins anew
  }
  in ? usb_->plug(*gadget_) : usb_->unplug(*gadget_);
  is_in_ = in;
}

void Emulation::plan() {
  events_.push_back({0.0, "the start", {}});
  for (const std::string& fault : options_.faults) plan_fault(fault);
  for (const double at : options_.unplug_at) events_.push_back({at, "the unplug", [this] { plug(false); }});
  for (const double at : options_.replug_at) events_.push_back({at, "", [this] { plug(true); }});
  for (const double at : options_.stop_at) events_.push_back({at, "the stop", [this] { kill(child_, SIGSTOP); }});
  for (const double at : options_.continue_at)
    events_.push_back({at, "the continue", [this] { kill(child_, SIGCONT); }});
  std::stable_sort(events_.begin(), events_.end(), [](const Event& a, const Event& b) { return a.at < b.at; });
}

void Emulation::plan_fault(const std::string& text) {
  const std::size_t at = text.find('@');
  const auto fault = kFaults.find(text.substr(0, at));
  if (at == std::string::npos || fault == kFaults.end()) {
    std::string names;
    for (const auto& each : kFaults) names += " " + each.first;
    throw std::runtime_error("--fault " + text + ": NAME@SECONDS, and the names are:" + names);
  }
  events_.push_back({std::stod(text.substr(at + 1)), "the fault " + fault->first, [this, set = fault->second] {
                       const std::lock_guard<std::mutex> lock(usb_->mutex());
                       set(stick_->faults);
                     }});
}

// What has been written so far, a line each.
void Emulation::take_orders(double time) {
  char text[256];
  for (ssize_t count; orders_ >= 0 && (count = read(orders_, text, sizeof text)) > 0;) {
    order_.append(text, static_cast<std::size_t>(count));
  }
  for (std::size_t end; (end = order_.find('\n')) != std::string::npos; order_.erase(0, end + 1)) {
    obey(order_.substr(0, end), time);
  }
}

void Emulation::obey(const std::string& order, double time) {
  std::istringstream words(order);
  std::string what;
  glm::dvec2 to{0.0};
  int button = 0;
  words >> what;
  const auto next = events_.begin() + static_cast<std::ptrdiff_t>(happened_);
  if (what == "go" && words >> to.x >> to.y) {
    const std::lock_guard<std::mutex> lock(usb_->mutex());
    ordered_->go(1e-3 * to);
  } else if (what == "hold" && words >> button && button >= 1 && button <= 64) {
    const std::lock_guard<std::mutex> lock(usb_->mutex());
    stick_->held_buttons |= std::uint64_t{1} << (button - 1);
  } else if (what == "unplug") {
    events_.insert(next, {time, "the unplug", [this] { plug(false); }});
  } else if (what == "plug") {
    events_.insert(next, {time, "", [this] { plug(true); }});
  } else {
    std::cerr << "stick_emulator: an order that it does not know: " << order << '\n';
  }
}

void Emulation::start() {
  std::vector<char*> arguments;
  for (const std::string& each : options_.command) arguments.push_back(const_cast<char*>(each.c_str()));
  arguments.push_back(nullptr);
  if (posix_spawnp(&child_, arguments[0], nullptr, nullptr, arguments.data(), environ) != 0) {
    throw std::runtime_error("cannot start " + options_.command[0]);
  }
  start_ = Clock::now();
  std::signal(SIGTERM, note_end);
  std::signal(SIGINT, SIG_IGN);  // a terminal tells the program itself
}

double Emulation::event_time() {
  if (!touring_) return now();
  const std::lock_guard<std::mutex> lock(usb_->mutex());
  if (motors_on_ < 0.0 && stick_->actuators_on()) motors_on_ = now();
  return motors_on_ < 0.0 ? 0.0 : now() - motors_on_;
}

void Emulation::watch() {
  const double time = event_time();
  take_orders(time);
  for (; happened_ < events_.size() && events_[happened_].at <= time; ++happened_) {
    events_[happened_].at = now();
    if (events_[happened_].happen) events_[happened_].happen();
  }
  const std::lock_guard<std::mutex> lock(usb_->mutex());
  if (!is_in_) stick_->advance(std::chrono::nanoseconds(Clock::now().time_since_epoch()).count());  // it has no bus
  if (touring_) touring_->work(is_in_ && stick_->actuators_on());  // as who sees on the screen that it is gone
  if (happened_ > 0 && glm::length(stick_->force()) > kFreeOfForce) events_[happened_ - 1].last_force = now();
  for (const StickMessage& message : stick_->log) {
    char time_text[32];
    std::snprintf(time_text, sizeof time_text, "%.6f ", 1e-9 * static_cast<double>(message.time_ns));
    log_ << time_text << message_line(message) << '\n';
  }
  stick_->log.clear();
}

bool Emulation::has_ended() {
  if (asked_to_end != 0) {
    kill(child_, SIGTERM);
    kill(child_, SIGCONT);  // one that stands still would not hear it
  }
  asked_to_end = 0;
  return waitpid(child_, &status_, WNOHANG) == child_;
}

// The motors after the program's end: until they have been still for a while.
void Emulation::settle() {
  events_.resize(happened_);
  events_.push_back({now(), "the program's end", {}});
  happened_ = events_.size();
  const double end = now();
  while (now() < end + kLongest && now() < std::max(end, events_.back().last_force) + kQuietAfter) {
    watch();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

void Emulation::say() const {
  for (const Event& event : events_) {
    if (event.name.empty()) continue;
    const double milliseconds = 1e3 * std::max(0.0, event.last_force - event.at);
    std::fprintf(stderr, "stick_emulator: zero force %.0f ms after %s (%.3f s)\n", milliseconds, event.name.c_str(),
                 event.at);
  }
}

int Emulation::run() {
  start();
  while (!has_ended()) {
    watch();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  settle();
  say();
  return WIFEXITED(status_) ? WEXITSTATUS(status_) : 128 + WTERMSIG(status_);
}

int run(int count, char** arguments) {
  Options options;
  CLI::App cli("Runs a program with an emulated force-feedback stick beneath its libusb");
  cli.add_option("--family", options.family, "sidewinder, openffboard or vjoy");
  cli.add_option("--tour", options.tour, "a hand shifts through every gear of this gate while the motors are on");
  // One value each time: more would take the "--" for the list's end.
  const auto each = [](CLI::Option* option) { option->allow_extra_args(false); };
  each(cli.add_option("--unplug-at", options.unplug_at, "[s] may be given again"));
  each(cli.add_option("--replug-at", options.replug_at, "[s]"));
  each(cli.add_option("--fault", options.faults, "NAME@S: from then on"));
  each(cli.add_option("--stop-at", options.stop_at, "[s] SIGSTOP to the program"));
  each(cli.add_option("--continue-at", options.continue_at, "[s] SIGCONT"));
  cli.add_flag("--own-power", options.own_power,
               "its motors are fed from the wall: unplugged, its effects go on to their end");
  cli.add_option("--log", options.log, "file for all that the stick is told, a message a line after its time [s]");
  cli.add_option(
      "--orders", options.orders,
      "a pipe whose lines say what happens next: go X Y [mm], hold BUTTON, unplug, plug; a hand holds the lever");
  cli.add_option("program", options.command, "and its arguments, after --")->required();
  CLI11_PARSE(cli, count, arguments);
  return Emulation(options).run();
}

}  // namespace
}  // namespace gearshift

int main(int count, char** arguments) {
  try {
    return gearshift::run(count, arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "stick_emulator: %s\n", error.what());
    return 2;
  }
}
