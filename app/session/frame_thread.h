// The thread on which a frame is computed and drawn, while the thread of the window goes on reading the person's input: a
// GPU, a window system or a disk may take as long as it likes.
#pragma once

#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>

namespace gearshift::session {

class FrameThread {
 public:
  FrameThread() : thread_([this](const std::stop_token& stop) { serve(stop); }) {}

  // Does the work on the frame's thread and returns when it is done. Meanwhile calls `glance` on the calling thread every
  // few milliseconds. The two must not use the same data. Throws what the work throws.
  template <class Glance>
  void run(std::function<void()> work, const Glance& glance) {
    std::unique_lock lock(mutex_);
    work_ = std::move(work);
    changed_.notify_all();
    while (!changed_.wait_for(lock, kGlance, [this] { return !work_; })) {
      lock.unlock();
      glance();
      lock.lock();
    }
    if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
  }

 private:
  static constexpr std::chrono::milliseconds kGlance{4};

  void serve(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (changed_.wait(lock, stop, [this] { return static_cast<bool>(work_); })) {
      lock.unlock();
      try {
        work_();
      } catch (...) {
        error_ = std::current_exception();
      }
      lock.lock();
      work_ = nullptr;
      changed_.notify_all();
    }
  }

  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::function<void()> work_;  // empty: none, or done
  std::exception_ptr error_;
  std::jthread thread_;  // last: it uses the other members
};

}  // namespace gearshift::session
