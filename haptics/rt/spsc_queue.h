// Bounded queue from one writer to one reader, in order, none lost unless full: then push says so.
#pragma once

#include <atomic>
#include <bit>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace gearshift {

template <class T>
class SpscQueue {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  // Room for at least `capacity` values; allocates here and never again.
  explicit SpscQueue(std::size_t capacity) : slots_(std::bit_ceil(capacity)), mask_(slots_.size() - 1) {}

  // Writer only. False when full: the value was not taken.
  bool push(const T& value) noexcept {
    const std::size_t tail = tail_.load(std::memory_order_relaxed);
    if (tail - cached_head_ > mask_) {  // looks full: ask the reader's side how far it is
      cached_head_ = head_.load(std::memory_order_acquire);
      if (tail - cached_head_ > mask_) return false;
    }
    slots_[tail & mask_] = value;  // the reader left this slot: its release of head_ was acquired above
    tail_.store(tail + 1, std::memory_order_release);
    return true;
  }

  // Reader only. False when empty.
  bool pop(T& value) noexcept {
    const std::size_t head = head_.load(std::memory_order_relaxed);
    if (head == cached_tail_) {
      cached_tail_ = tail_.load(std::memory_order_acquire);
      if (head == cached_tail_) return false;
    }
    value = slots_[head & mask_];
    head_.store(head + 1, std::memory_order_release);
    return true;
  }

  std::size_t capacity() const noexcept { return slots_.size(); }

 private:
  // Three groups of cache lines: read by both and never written, the writer's, the reader's. Each side keeps
  // a copy of the other's counter on its own line and looks at the original only when the copy says full or
  // empty, so a push and a pop far apart touch no common line.
  // The counters run on and wrap; only their difference counts.
  std::vector<T> slots_;
  std::size_t mask_;
  alignas(64) std::atomic<std::size_t> tail_{0};
  std::size_t cached_head_ = 0;  // the writer's
  alignas(64) std::atomic<std::size_t> head_{0};
  std::size_t cached_tail_ = 0;  // the reader's
};

}  // namespace gearshift
