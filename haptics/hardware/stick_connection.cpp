#include "haptics/hardware/stick_connection.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "haptics/rt/realtime_scope.h"

namespace gearshift::haptics {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr milliseconds kFirstWait{12}, kMaxWait{1000};  // pause between attempts, doubled every time
constexpr milliseconds kStableTime{1000};               // after streaming this long, earlier problems are forgotten
constexpr std::size_t kMaxMessages = 64;                // in the queue; if it is full, the oldest message is dropped
constexpr int kPriority = 70;  // below the haptic loop's priority, so that the loop is never delayed

}  // namespace

struct StickConnection::State {
  State(PidDriver& the_driver, PortOpener opener, std::int64_t tick)
      : driver(the_driver), open(std::move(opener)), tick_ns(tick) {}

  void run() noexcept;
  void open_and_stream();
  void connect(HidPort& port);
  void on_unplugged(const std::string& why);
  void report_once(const std::string& sentence);
  void post(const std::string& sentence);
  void wait();

  PidDriver& driver;
  PortOpener open;
  std::int64_t tick_ns;

  std::atomic<bool> connected{false}, stopping{false};
  std::mutex mutex;  // guards the next three members
  std::condition_variable stop_requested;
  std::optional<PidAbility> ability;
  std::deque<std::string> messages;

  // Used only by the connection's thread.
  std::vector<std::string> reported;               // messages reported since the stick last worked
  std::string name;                                // name of the device, once it has been opened
  bool was_connected = false;                      // the device was prepared at least once
  bool has_failed = false;                         // a stream has failed, so further failures are not reported
  std::optional<Clock::time_point> streams_since;  // start of the current stream
  milliseconds pause = kFirstWait;
  std::thread thread;
};

// No exception may leave the thread: an unexpected exception is reported, and the connection is tried again.
void StickConnection::State::run() noexcept {
  while (!stopping) {
    try {
      open_and_stream();
    } catch (const HidDisconnected& error) {
      if (!was_connected) report_once(error.what());  // otherwise "unplugged" was already reported
      has_failed = false;
    } catch (const std::exception& error) {
      report_once(error.what());
    } catch (...) {
      report_once("the stick cannot be used because of an unknown error");
    }
    connected = false;
    wait();
  }
}

void StickConnection::State::open_and_stream() {
  const std::unique_ptr<HidPort> port = open();
  const std::string device_name = port->identity().name;
  name = device_name.empty() ? "the stick" : device_name;
  streams_since.reset();
  try {
    connect(*port);
  } catch (const HidDisconnected&) {
    on_unplugged(name + " was unplugged, so its motors are off");
  } catch (const HidError& error) {
    connected = false;  // set at once, because switching the motors off below may take a while
    if (!has_failed) report_once(error.what());
    has_failed = has_failed || streams_since;
  }
  driver.finish(*port);
  if (!streams_since || Clock::now() - *streams_since < kStableTime) return;
  pause = kFirstWait;
  reported.clear();
}

void StickConnection::State::connect(HidPort& port) {
  PidAbility found = driver.prepare(port);
  {
    const std::lock_guard lock(mutex);
    ability = std::move(found);
  }
  if (was_connected) report_once(name + " is connected again; its motors are still off");
  was_connected = true;
  connected = true;
  has_failed = false;
  streams_since = Clock::now();
  // If the destructor called end() before prepare(), prepare() has cleared the driver's end flag, and stream() would
  // not return.
  if (stopping) return;
  const RealtimeScope realtime(kPriority);
  port.stream(driver.stream_config(tick_ns), driver);
}

void StickConnection::State::on_unplugged(const std::string& why) {
  if (!connected.exchange(false)) return report_once(why);
  pause = kFirstWait;
  reported.clear();  // after an unplug, earlier problems may be reported again
  post(why);
}

void StickConnection::State::report_once(const std::string& sentence) {
  if (std::find(reported.begin(), reported.end(), sentence) != reported.end()) return;
  reported.push_back(sentence);
  post(sentence);
}

void StickConnection::State::post(const std::string& sentence) {
  const std::lock_guard lock(mutex);
  if (messages.size() == kMaxMessages) messages.pop_front();
  messages.push_back(sentence);
}

void StickConnection::State::wait() {
  std::unique_lock lock(mutex);
  stop_requested.wait_for(lock, pause, [&] { return stopping.load(); });
  pause = std::min(2 * pause, kMaxWait);
}

StickConnection::StickConnection(PidDriver& driver, PortOpener open, std::int64_t tick_ns)
    : state_(std::make_unique<State>(driver, std::move(open), tick_ns)) {
  state_->thread = std::thread([state = state_.get()] { state->run(); });
}

StickConnection::~StickConnection() {
  {
    const std::lock_guard lock(state_->mutex);
    state_->stopping = true;
  }
  state_->driver.end();
  state_->stop_requested.notify_all();
  state_->thread.join();
}

bool StickConnection::connected() const noexcept {
  return state_->connected;
}

std::optional<PidAbility> StickConnection::ability() const {
  const std::lock_guard lock(state_->mutex);
  return state_->ability;
}

std::optional<std::string> StickConnection::take_message() {
  const std::optional<std::string> problem = state_->driver.take_problem();
  const std::lock_guard lock(state_->mutex);
  if (problem) state_->messages.push_back(*problem);
  if (state_->messages.empty()) return std::nullopt;
  std::string sentence = std::move(state_->messages.front());
  state_->messages.pop_front();
  return sentence;
}

}  // namespace gearshift::haptics
