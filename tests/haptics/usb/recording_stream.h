// A stream that records its input, sends the given outputs, and ends on request.
#pragma once

#include <sys/eventfd.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <deque>
#include <mutex>
#include <span>
#include <vector>

#include "haptics/hid/hid_port.h"

namespace gearshift::test {

class RecordingStream final : public haptics::HidStream {
 public:
  struct Input {
    std::int64_t time_ns = 0;
    std::vector<std::uint8_t> bytes;
  };

  RecordingStream() : wake_fd_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {}
  ~RecordingStream() override { close(wake_fd_); }
  RecordingStream(const RecordingStream&) = delete;
  RecordingStream& operator=(const RecordingStream&) = delete;

  haptics::StreamConfig config() const {
    haptics::StreamConfig config;
    config.wake_fd = wake_fd_;
    config.lever_report = 1;
    return config;
  }

  // Any thread.
  void queue_output(const haptics::HidBytes& report) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      queued_.push_back(report);
    }
    eventfd_write(wake_fd_, 1);
  }
  void end() { end_ = true; }
  std::vector<Input> inputs() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return inputs_;
  }
  std::vector<std::int64_t> poll_times() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return poll_times_;
  }
  std::vector<std::int64_t> output_times() const {  // times at which non-empty outputs were returned
    const std::lock_guard<std::mutex> lock(mutex_);
    return output_times_;
  }
  std::size_t input_count() const { return input_count_; }
  int sent() const { return sent_; }

  void on_input(std::span<const std::uint8_t> report, std::int64_t time_ns) noexcept override {
    const std::lock_guard<std::mutex> lock(mutex_);
    inputs_.push_back({time_ns, {report.begin(), report.end()}});
    ++input_count_;
  }
  haptics::HidBytes next_output(std::int64_t now_ns) noexcept override {
    const std::lock_guard<std::mutex> lock(mutex_);
    poll_times_.push_back(now_ns);
    if (queued_.empty()) return {};
    const haptics::HidBytes next = queued_.front();
    queued_.pop_front();
    output_times_.push_back(now_ns);
    return next;
  }
  void on_sent(std::int64_t) noexcept override { ++sent_; }
  bool should_end() const noexcept override { return end_; }

 private:
  int wake_fd_;
  mutable std::mutex mutex_;
  std::deque<haptics::HidBytes> queued_;
  std::vector<Input> inputs_;
  std::vector<std::int64_t> poll_times_, output_times_;
  std::atomic<std::size_t> input_count_{0};
  std::atomic<int> sent_{0};
  std::atomic<bool> end_{false};
};

}  // namespace gearshift::test
