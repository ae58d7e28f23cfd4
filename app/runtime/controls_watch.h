// Ends the forces of whatever lever is in force, from any thread and without a frame: at STOP, and when the person's
// controls are no longer read, whatever hangs: the window system, a disk, a GPU.
#pragma once

#include <atomic>
#include <cstdint>

namespace gearshift::runtime {

class ControlsWatch {
 public:
  // [ns] Longest time without a read of the controls while a real stick has forces.
  static constexpr std::int64_t kLongestLapse = 200'000'000;

  void stop() noexcept { stops_.fetch_add(1, std::memory_order_relaxed); }
  // `now_ns`: on the loop's clock. Until the first call no time is too long.
  void note_read(std::int64_t now_ns) noexcept { read_ns_.store(now_ns, std::memory_order_relaxed); }
  // True once after such a time has ended a stick's forces.
  bool take_lapse() noexcept { return lapsed_.exchange(false, std::memory_order_relaxed); }

 private:
  friend class WatchedForces;
  std::atomic<std::uint64_t> stops_{0};
  std::atomic<std::int64_t> read_ns_{0};
  std::atomic<bool> lapsed_{false};
};

// The haptic thread's side of the watch, for one lever.
class WatchedForces {
 public:
  // Call before the first cycle. `watch`: null: none; must outlive this object.
  void follow(ControlsWatch* watch, bool is_real) noexcept {
    watch_ = watch;
    is_real_ = is_real;
    if (watch_ != nullptr) stops_ = watch_->stops_.load(std::memory_order_relaxed);
  }

  // True if the forces must end in this cycle.
  bool must_end(std::int64_t now_ns, bool has_forces) noexcept {
    if (watch_ == nullptr) return false;
    const std::uint64_t stops = watch_->stops_.load(std::memory_order_relaxed);
    const std::int64_t read_ns = watch_->read_ns_.load(std::memory_order_relaxed);
    const bool lapses = is_real_ && has_forces && read_ns != 0 && now_ns - read_ns > ControlsWatch::kLongestLapse;
    if (lapses) watch_->lapsed_.store(true, std::memory_order_relaxed);
    const bool is_stop = stops != stops_;
    stops_ = stops;
    return lapses || is_stop;
  }

 private:
  ControlsWatch* watch_ = nullptr;
  bool is_real_ = false;
  std::uint64_t stops_ = 0;
};

}  // namespace gearshift::runtime
