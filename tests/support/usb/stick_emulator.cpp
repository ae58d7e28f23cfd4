// Runs a program with an emulated force-feedback stick plugged in beneath its libusb:
//
//   umockdev-wrapper stick_emulator --family sidewinder [options] -- PROGRAM ARGUMENTS
//
// Event times are seconds since the program's start or, with --tour, since the motors were first on. An event at 0
// happens before the program looks for devices. The exit status is the program's. After the program's end, stderr lists
// for how long the emulated motors still pushed after each event: the start, each fault, unplug, stop and continue, and
// the end.

#include <fcntl.h>
#include <sched.h>
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
#include "tests/support/stick/stick_profiles.h"
#include "tests/support/usb/go_to_hand.h"
#include "tests/support/usb/mock_usb.h"
#include "tests/support/usb/touring_hand.h"

namespace gearshift::test {
namespace {

using Clock = std::chrono::steady_clock;
constexpr double kFreeOfForce = 1e-9;  // [N]
constexpr double kQuietTime = 0.5;     // [s] watch_after_end() returns after this time without force
constexpr double kMaxWatchTime = 5.0;  // [s] maximum duration of watch_after_end()

struct Options {
  std::string family = "sidewinder", tour;
  std::vector<double> unplug_at, replug_at, stop_at, continue_at;
  std::vector<std::string> faults, command;
  std::filesystem::path log, orders;
  bool own_power = false, realtime = false;
};

const std::map<std::string, void (*)(EmulatedFaults&)> kFaults{
    {"jump", [](EmulatedFaults& faults) { faults.jump = true; }},
    {"wrong-length", [](EmulatedFaults& faults) { faults.wrong_length = true; }},
    {"stuck", [](EmulatedFaults& faults) { faults.stuck = true; }},
    {"silent", [](EmulatedFaults& faults) { faults.silent = true; }},
    {"refuses-effects", [](EmulatedFaults& faults) { faults.refuses_effects = true; }},
    {"pool-full", [](EmulatedFaults& faults) { faults.pool_full = true; }},
    {"stalls-outputs", [](EmulatedFaults& faults) { faults.stalls_outputs = true; }},
    {"slow", [](EmulatedFaults& faults) { faults.slow = 0.05; }},
};

// A family of sticks without the habits of its firmware, or a profile with them (stick_profiles.cpp).
EmulatedStickConfig stick_named(const std::string& name) {
  EmulatedStickConfig config;
  for (const StickFamily family : {StickFamily::sidewinder, StickFamily::openffboard, StickFamily::vjoy}) {
    config.family = family;
    if (name == to_string(family)) return config;
  }
  std::string known = "sidewinder, openffboard, vjoy";
  for (const StickProfile& profile : stick_profiles()) {
    if (name == profile.name) return config_of(profile);
    known += std::string("; ") + profile.name;
  }
  throw std::runtime_error("--family " + name + ": must be one of " + known);
}

// `name` is a file or the name of a shipped gate.
haptics::Gate gate_of(const std::string& name, const haptics::SimulatedLeverConfig& lever) {
  const std::filesystem::path shipped = std::filesystem::path(GEARSHIFT_ASSETS) / "gates" / (name + ".toml");
  const std::filesystem::path file = std::filesystem::exists(name) ? std::filesystem::path(name) : shipped;
  return haptics::compile_gate(haptics::read_gate_layout(file), haptics::workspace_half_extent(lever.yoke),
                               lever.yoke.radius);
}

// An event of the test, and the last time at which the motors pushed before the next event.
struct Event {
  double at = 0.0;  // [s] planned time; after the event, its actual time on the clock now()
  std::string name;
  std::function<void()> action;
  double last_force = -1.0;  // [s]
};

volatile std::sig_atomic_t end_requested = 0;
void request_end(int) {
  end_requested = 1;
}

class Emulation {
 public:
  explicit Emulation(const Options& options);
  int run();

 private:
  void plan();
  void plug(bool in);
  void plan_fault(const std::string& text);
  void read_orders(double time);
  void run_order(const std::string& order, double time);
  void start();
  void watch();      // every millisecond: reads orders, triggers due events, logs the stick
  bool has_ended();  // true if the program has ended
  void watch_after_end();
  void print_summary() const;
  double now() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  double event_time();  // [s] since the start or, with --tour, since the motors were first on

  const Options& options_;
  EmulatedStickConfig config_;
  haptics::IdleHand idle_hand_;
  std::unique_ptr<TouringHand> touring_hand_;
  std::unique_ptr<GoToHand> commanded_hand_;
  int orders_file_ = -1;    // file descriptor
  std::string order_text_;  // incomplete line
  std::unique_ptr<EmulatedStick> stick_;
  std::unique_ptr<StickGadget> gadget_;
  std::unique_ptr<MockUsb> usb_;
  std::ofstream log_;
  std::vector<Event> events_;  // in order of time
  std::size_t events_done_ = 0;
  Clock::time_point start_;
  double motors_on_ = -1.0;  // [s] when the motors were first on; negative: not yet
  bool is_plugged_ = false;
  pid_t child_ = -1;
  int status_ = 0;
};

// Where it is permitted, all threads of the emulation have a real-time priority, because a device never waits for a CPU. Only
// on request, because it takes the time from the picture of a software renderer.
void never_wait() {
  const sched_param above_program{.sched_priority = 90};
  (void)sched_setscheduler(0, SCHED_FIFO, &above_program);
}

Emulation::Emulation(const Options& options) : options_(options) {
  config_ = stick_named(options.family);
  // Without a tour (scripted gear changes) and without an orders file, no hand holds the lever.
  if (!options.tour.empty() || !options.orders.empty()) config_.lever.hand = haptics::kGripHand;
  config_.own_power = options.own_power;
  if (!options.tour.empty()) {
    touring_hand_ = std::make_unique<TouringHand>(gate_of(options.tour, config_.lever), config_.plant_period);
  }
  if (!options.orders.empty()) {
    orders_file_ = open(options.orders.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (orders_file_ < 0) throw std::runtime_error("cannot read " + options.orders.string());
    commanded_hand_ = std::make_unique<GoToHand>(config_.plant_period);
  }
  haptics::HandDriver* hand = &idle_hand_;
  if (commanded_hand_) hand = commanded_hand_.get();
  if (touring_hand_) hand = touring_hand_.get();
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
    stick_->control({0x80, 0, 0, 0, 2}, {});  // the first request after a replug resets the stick, as enumeration would
  }
  in ? usb_->plug(*gadget_) : usb_->unplug(*gadget_);
  is_plugged_ = in;
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

// Executes the complete lines that were written to the orders file so far.
void Emulation::read_orders(double time) {
  char text[256];
  for (ssize_t count; orders_file_ >= 0 && (count = read(orders_file_, text, sizeof text)) > 0;) {
    order_text_.append(text, static_cast<std::size_t>(count));
  }
  for (std::size_t end; (end = order_text_.find('\n')) != std::string::npos; order_text_.erase(0, end + 1)) {
    run_order(order_text_.substr(0, end), time);
  }
}

void Emulation::run_order(const std::string& order, double time) {
  std::istringstream stream(order);
  std::string verb;
  glm::dvec2 to{0.0};
  int button = 0;
  stream >> verb;
  const auto next = events_.begin() + static_cast<std::ptrdiff_t>(events_done_);
  if (verb == "go" && stream >> to.x >> to.y) {
    const std::lock_guard<std::mutex> lock(usb_->mutex());
    commanded_hand_->go(1e-3 * to);
  } else if (verb == "hold" && stream >> button && button >= 1 && button <= 64) {
    const std::lock_guard<std::mutex> lock(usb_->mutex());
    stick_->held_buttons |= std::uint64_t{1} << (button - 1);
  } else if (verb == "mark") {
    std::string name;
    std::getline(stream >> std::ws, name);
    events_.insert(next, {time, name, {}});
  } else if (verb == "unplug") {
    events_.insert(next, {time, "the unplug", [this] { plug(false); }});
  } else if (verb == "plug") {
    events_.insert(next, {time, "", [this] { plug(true); }});
  } else {
    std::cerr << "stick_emulator: unknown order: " << order << '\n';
  }
}

void Emulation::start() {
  std::vector<char*> arguments;
  for (const std::string& each : options_.command) arguments.push_back(const_cast<char*>(each.c_str()));
  arguments.push_back(nullptr);
  posix_spawnattr_t ordinary;  // the program's scheduling
  const sched_param no_priority{};
  posix_spawnattr_init(&ordinary);
  posix_spawnattr_setflags(&ordinary, POSIX_SPAWN_SETSCHEDULER);
  posix_spawnattr_setschedpolicy(&ordinary, SCHED_OTHER);
  posix_spawnattr_setschedparam(&ordinary, &no_priority);
  const int error = posix_spawnp(&child_, arguments[0], nullptr, &ordinary, arguments.data(), environ);
  posix_spawnattr_destroy(&ordinary);
  if (error != 0) throw std::runtime_error("cannot start " + options_.command[0]);
  start_ = Clock::now();
  std::signal(SIGTERM, request_end);
  std::signal(SIGINT, SIG_IGN);  // ignored, because Ctrl-C also sends SIGINT to the program itself
}

double Emulation::event_time() {
  if (!touring_hand_) return now();
  const std::lock_guard<std::mutex> lock(usb_->mutex());
  if (motors_on_ < 0.0 && stick_->actuators_on()) motors_on_ = now();
  return motors_on_ < 0.0 ? 0.0 : now() - motors_on_;
}

void Emulation::watch() {
  const double time = event_time();
  read_orders(time);
  for (; events_done_ < events_.size() && events_[events_done_].at <= time; ++events_done_) {
    events_[events_done_].at = now();
    if (events_[events_done_].action) events_[events_done_].action();
  }
  const std::lock_guard<std::mutex> lock(usb_->mutex());
  // While the stick is unplugged, the bus does not advance the stick, so it is advanced here.
  if (!is_plugged_) gadget_->advance(std::chrono::nanoseconds(Clock::now().time_since_epoch()).count());
  // The hand shifts only while the motors are on.
  if (touring_hand_) touring_hand_->work(is_plugged_ && stick_->actuators_on());
  if (events_done_ > 0 && glm::length(stick_->force()) > kFreeOfForce) events_[events_done_ - 1].last_force = now();
  for (const StickMessage& message : stick_->log) {
    char time_text[32];
    std::snprintf(time_text, sizeof time_text, "%.6f ", 1e-9 * static_cast<double>(message.time_ns));
    log_ << time_text << message_line(message) << '\n';
  }
  stick_->log.clear();
}

bool Emulation::has_ended() {
  if (end_requested != 0) {
    kill(child_, SIGTERM);
    kill(child_, SIGCONT);  // a stopped process would not handle SIGTERM
  }
  end_requested = 0;
  return waitpid(child_, &status_, WNOHANG) == child_;
}

// Observes the motors after the program's end, until they have not pushed for kQuietTime.
void Emulation::watch_after_end() {
  events_.resize(events_done_);
  events_.push_back({now(), "the program's end", {}});
  events_done_ = events_.size();
  const double end = now();
  while (now() < end + kMaxWatchTime && now() < std::max(end, events_.back().last_force) + kQuietTime) {
    watch();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

void Emulation::print_summary() const {
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
  watch_after_end();
  print_summary();
  return WIFEXITED(status_) ? WEXITSTATUS(status_) : 128 + WTERMSIG(status_);
}

int run(int count, char** arguments) {
  Options options;
  CLI::App cli("Runs a program with an emulated force-feedback stick beneath its libusb");
  cli.add_option("--family", options.family, "sidewinder, openffboard or vjoy");
  cli.add_option("--tour", options.tour, "gate whose gears a hand shifts through while the motors are on");
  // Each use of an option takes one value; otherwise "--" would not end a list of values.
  const auto each = [](CLI::Option* option) { option->allow_extra_args(false); };
  each(cli.add_option("--unplug-at", options.unplug_at, "[s] may be repeated"));
  each(cli.add_option("--replug-at", options.replug_at, "[s]"));
  each(cli.add_option("--fault", options.faults, "NAME@S: fault from that time on"));
  each(cli.add_option("--stop-at", options.stop_at, "[s] SIGSTOP to the program"));
  each(cli.add_option("--continue-at", options.continue_at, "[s] SIGCONT"));
  cli.add_flag("--own-power", options.own_power,
               "the stick has its own power supply: after an unplug its effects run to their end");
  cli.add_flag("--realtime", options.realtime, "with a real-time priority, if permitted");
  cli.add_option("--log", options.log, "log file of all messages to the stick: time [s] and message per line");
  cli.add_option(
      "--orders", options.orders,
      "pipe with one order per line: go X Y [mm], hold BUTTON, unplug, plug, mark NAME (an event of the summary); a "
      "hand holds the lever");
  cli.add_option("program", options.command, "program and its arguments, after --")->required();
  CLI11_PARSE(cli, count, arguments);
  if (options.realtime) never_wait();
  return Emulation(options).run();
}

}  // namespace
}  // namespace gearshift::test

int main(int count, char** arguments) {
  try {
    return gearshift::test::run(count, arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "stick_emulator: %s\n", error.what());
    return 2;
  }
}
