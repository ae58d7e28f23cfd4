// Triple buffer: passes the newest complete value from one writer to one reader. Neither side ever waits.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <type_traits>

namespace gearshift::haptics {

template <class T>
class LatestValue {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  explicit LatestValue(const T& first = T{}) noexcept : slot_{Slot{first}, Slot{first}, Slot{first}} {}

  // Writer only.
  void write(const T& value) noexcept {
    slot_[back_].value = value;
    // acq_rel. Release: a reader that gets this index sees the complete value. Acquire: the reader has finished with
    // the slot that the exchange returns.
    back_ = index_of(middle_.exchange(static_cast<std::uint8_t>(back_ | kFresh), std::memory_order_acq_rel));
  }

  // Reader only. Fetches the newest value. Returns true if it is newer than the value fetched before.
  bool update() noexcept {
    // Relaxed is enough for this check: only the reader clears kFresh, and the exchange below gets the newest value.
    if (!(middle_.load(std::memory_order_relaxed) & kFresh)) return false;
    front_ = index_of(middle_.exchange(front_, std::memory_order_acq_rel));
    return true;
  }

  // Reader only: the value fetched by the last update().
  const T& value() const noexcept { return slot_[front_].value; }

 private:
  static constexpr std::uint8_t kFresh = 4;
  static constexpr std::uint8_t kIndex = 3;

  // Each slot has its own cache lines, because the writer fills one while the reader reads another.
  struct alignas(64) Slot {
    T value;
  };

  static std::uint8_t index_of(std::uint8_t mark) noexcept { return static_cast<std::uint8_t>(mark & kIndex); }

  std::array<Slot, 3> slot_;
  alignas(64) std::atomic<std::uint8_t> middle_{1};
  alignas(64) std::uint8_t back_ = 0;
  alignas(64) std::uint8_t front_ = 2;
};

}  // namespace gearshift::haptics
