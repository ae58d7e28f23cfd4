// Bounded, ordered queue from one writer to one reader. push() returns false when the queue is full.
#pragma once

#include <atomic>
#include <bit>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace gearshift::haptics {

template <class T>
class SpscQueue {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  // A queue with room for at least `capacity` values. Only the constructor allocates.
  explicit SpscQueue(std::size_t capacity) : slots_(std::bit_ceil(capacity)), mask_(slots_.size() - 1) {}

  // Writer only. False if full; the value was then not stored.
  bool push(const T& value) noexcept {
    const std::size_t tail = tail_.load(std::memory_order_relaxed);
    if (tail - cached_head_ > mask_) {  // seems full: read the reader's counter
      cached_head_ = head_.load(std::memory_order_acquire);
      if (tail - cached_head_ > mask_) return false;
    }
    slots_[tail & mask_] = value;  // the slot is free: the acquire load of head_ synchronises with the reader's release
    tail_.store(tail + 1, std::memory_order_release);
    return true;
  }

  // Reader only. False if empty.
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
  // Three groups of cache lines: constant data that both sides read, the writer's data, and the reader's data. Each
  // side caches the other side's counter on its own line and reads the original only if the cached value says full or
  // empty. So a push and a pop at different positions share no cache line. The counters increase and wrap; only their
  // difference matters.
  std::vector<T> slots_;
  std::size_t mask_;
  alignas(64) std::atomic<std::size_t> tail_{0};
  std::size_t cached_head_ = 0;  // the writer's
  alignas(64) std::atomic<std::size_t> head_{0};
  std::size_t cached_tail_ = 0;  // the reader's
};

}  // namespace gearshift::haptics
