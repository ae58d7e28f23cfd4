#include "haptics/hardware/lever_keeper.h"

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

namespace gearshift {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr milliseconds kFirstWait{12}, kLongestWait{1000};  // an absent device costs 12 ms to ask for
constexpr milliseconds kWorks{1000};                        // it streams so long, and what was wrong with it is over
constexpr std::size_t kMostNews = 64;                       // that wait; the oldest go first
constexpr int kPriority = 70;                               // below the haptic loop's, which it must never delay

}  // namespace

struct LeverKeeper::State {
  State(PidDriver& the_driver, PortOpener opener, std::int64_t tick)
      : driver(the_driver), open(std::move(opener)), tick_ns(tick) {}

  void run() noexcept;
  void keep_open();
  void serve(HidPort& port);
  void lost(const std::string& why);
  void complain(const std::string& sentence);
  void tell(const std::string& sentence);
  void wait();

  PidDriver& driver;
  PortOpener open;
  std::int64_t tick_ns;

  std::atomic<bool> connected{false}, leaving{false};
  std::mutex mutex;  // of what follows
  std::condition_variable left;
  std::optional<PidAbility> ability;
  std::deque<std::string> news;

  // The thread's own.
  std::vector<std::string> told;                   // since it last worked
  std::string name;                                // of the device, once it has been open
  bool was_there = false;                          // prepared, once
  bool has_failed = false;                         // while it streamed: that it cannot be prepared now is no news
  std::optional<Clock::time_point> streams_since;  // this time
  milliseconds pause = kFirstWait;
  std::thread thread;
};

// Nothing may leave the thread: what is not foreseen is told and tried again, too.
void LeverKeeper::State::run() noexcept {
  while (!leaving) {
    try {
      keep_open();
    } catch (const HidGone& error) {
      if (!was_there) complain(error.what());  // else it is known that it was unplugged
      has_failed = false;
    } catch (const std::exception& error) {
      complain(error.what());
    } catch (...) {
      complain("the stick cannot be used, for no reason that is known");
    }
    connected = false;
    wait();
  }
}

void LeverKeeper::State::keep_open() {
  const std::unique_ptr<HidPort> port = open();
  const std::string own = port->identity().name;
  name = own.empty() ? "the stick" : own;
  streams_since.reset();
  try {
    serve(*port);
  } catch (const HidGone&) {
    lost(name + " was unplugged: its motors are off");
  } catch (const HidError& error) {
    connected = false;  // before its motors are switched off, which may take a while
    if (!has_failed) complain(error.what());
    has_failed = has_failed || streams_since;
  }
  driver.finish(*port);
  if (!streams_since || Clock::now() - *streams_since < kWorks) return;
  pause = kFirstWait;
  told.clear();
}

void LeverKeeper::State::serve(HidPort& port) {
  PidAbility found = driver.prepare(port);
  {
    const std::lock_guard lock(mutex);
    ability = std::move(found);
  }
  if (was_there) complain(name + " is back: its motors are off");
  was_there = true;
  connected = true;
  has_failed = false;
  streams_since = Clock::now();
  // end() of the one who leaves may have come before prepare() made the driver ready to stream again.
  if (leaving) return;
  const RealtimeScope realtime(kPriority);
  port.stream(driver.stream_config(tick_ns), driver);
}

void LeverKeeper::State::lost(const std::string& why) {
  if (!connected.exchange(false)) return complain(why);
  pause = kFirstWait;
  told.clear();  // a person has pulled it out: what follows is another story
  tell(why);
}

void LeverKeeper::State::complain(const std::string& sentence) {
  if (std::find(told.begin(), told.end(), sentence) != told.end()) return;
  told.push_back(sentence);
  tell(sentence);
}

void LeverKeeper::State::tell(const std::string& sentence) {
  const std::lock_guard lock(mutex);
  if (news.size() == kMostNews) news.pop_front();
  news.push_back(sentence);
}

void LeverKeeper::State::wait() {
  std::unique_lock lock(mutex);
  left.wait_for(lock, pause, [&] { return leaving.load(); });
  pause = std::min(2 * pause, kLongestWait);
}

LeverKeeper::LeverKeeper(PidDriver& driver, PortOpener open, std::int64_t tick_ns)
    : state_(std::make_unique<State>(driver, std::move(open), tick_ns)) {
  state_->thread = std::thread([state = state_.get()] { state->run(); });
}

LeverKeeper::~LeverKeeper() {
  {
    const std::lock_guard lock(state_->mutex);
    state_->leaving = true;
  }
  state_->driver.end();
  state_->left.notify_all();
  state_->thread.join();
}

bool LeverKeeper::connected() const noexcept {
  return state_->connected;
}

std::optional<PidAbility> LeverKeeper::ability() const {
  const std::lock_guard lock(state_->mutex);
  return state_->ability;
}

std::optional<std::string> LeverKeeper::take_news() {
  const std::optional<std::string> problem = state_->driver.take_problem();
  const std::lock_guard lock(state_->mutex);
  if (problem) state_->news.push_back(*problem);
  if (state_->news.empty()) return std::nullopt;
  std::string sentence = std::move(state_->news.front());
  state_->news.pop_front();
  return sentence;
}

}  // namespace gearshift
