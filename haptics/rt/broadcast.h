// Bounded, ordered queue from one writer to any number of readers, each with its own place. The writer never waits: it
// overwrites the oldest values. A reader that falls behind by more than the capacity misses the oldest values and goes
// on with the next that is still there.
//
// Written here, because the queues of Debian's libraries either have one reader or make a slow reader stop the writer.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

namespace gearshift::haptics {

template <class T>
class Broadcast {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  // Room for at least `capacity` values, and for 2, because a reader cannot use the slot that is written next. Only the
  // constructor allocates.
  explicit Broadcast(std::size_t capacity)
      : slots_(std::bit_ceil(std::max<std::size_t>(capacity, 2))), mask_(slots_.size() - 1) {}

  // Writer only.
  void push(const T& value) noexcept {
    const std::uint64_t number = end_.load(std::memory_order_relaxed);
    slots_[number & mask_].write(value, number);
    end_.store(number + 1, std::memory_order_release);
  }

  // The newest value; empty before the first. May be called by any thread.
  std::optional<T> newest() const noexcept {
    T value;
    for (std::uint64_t end; (end = end_.load(std::memory_order_acquire)) > 0;)
      if (slots_[(end - 1) & mask_].read(value, end - 1)) return value;
    return std::nullopt;
  }

  std::size_t capacity() const noexcept { return slots_.size(); }

  // Use a reader on one thread at a time. The queue must outlive it.
  class Reader {
   public:
    // Begins with the next value that is pushed.
    explicit Reader(const Broadcast& queue) noexcept
        : queue_(&queue), next_(queue.end_.load(std::memory_order_acquire)) {}

    // Fetches the next value; false if there is none yet.
    bool pop(T& value) noexcept {
      for (;;) {
        const std::uint64_t end = queue_->end_.load(std::memory_order_acquire);
        if (next_ == end) return false;
        // The writer may already be overwriting the oldest value.
        const std::uint64_t oldest = end > queue_->mask_ ? end - queue_->mask_ : 0;
        if (next_ < oldest) lost_ += oldest - std::exchange(next_, oldest);
        if (queue_->slots_[next_ & queue_->mask_].read(value, next_)) break;
      }
      ++next_;
      return true;
    }

    std::uint64_t lost() const noexcept { return lost_; }  // number of values missed so far

   private:
    const Broadcast* queue_;
    std::uint64_t next_;  // number of the next value
    std::uint64_t lost_ = 0;
  };

 private:
  // A value with its number. The number is stored before and after the value, so that a reader notices if the writer
  // has come round and overwrites the value meanwhile. The value is stored as atomic words, because the two sides may
  // touch it at the same time. On x86-64, these stores and loads are ordinary moves.
  class alignas(64) Slot {
   public:
    void write(const T& value, std::uint64_t number) noexcept {
      std::array<std::uint64_t, kWords> words{};
      std::memcpy(words.data(), &value, sizeof(T));
      begun_.store(number + 1, std::memory_order_relaxed);
      // Release: whoever reads one of these words also sees the new value of begun_.
      for (std::size_t i = 0; i < kWords; ++i) words_[i].store(words[i], std::memory_order_release);
      done_.store(number + 1, std::memory_order_release);
    }

    bool read(T& value, std::uint64_t number) const noexcept {
      if (done_.load(std::memory_order_acquire) != number + 1) return false;
      std::array<std::uint64_t, kWords> words;
      for (std::size_t i = 0; i < kWords; ++i) words[i] = words_[i].load(std::memory_order_acquire);
      if (begun_.load(std::memory_order_relaxed) != number + 1) return false;
      std::memcpy(static_cast<void*>(&value), words.data(), sizeof(T));
      return true;
    }

   private:
    static constexpr std::size_t kWords = (sizeof(T) + 7) / 8;
    std::atomic<std::uint64_t> begun_{0}, done_{0};  // number of the value plus 1
    std::array<std::atomic<std::uint64_t>, kWords> words_{};
  };

  std::vector<Slot> slots_;
  std::uint64_t mask_;
  alignas(64) std::atomic<std::uint64_t> end_{0};  // number of the next value to be pushed
};

}  // namespace gearshift::haptics
