// The thread on which all calls to an OpenXR runtime are made, because a runtime may block in any of them for as long as
// it likes, while the window and the keys that switch motors off must still work.
#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <utility>

namespace gearshift::engine {

class HeadsetThread {
 public:
  HeadsetThread();   // throws HeadsetError if no thread can be started
  ~HeadsetThread();  // waits for nothing: the thread ends after the work that it still has
  HeadsetThread(const HeadsetThread&) = delete;
  HeadsetThread& operator=(const HeadsetThread&) = delete;

  // Does the work after all earlier work. The future holds its exception, and does not wait when it is destroyed.
  template <class Work>
  std::future<void> start(Work work) {
    auto task = std::make_shared<std::packaged_task<void()>>(std::move(work));
    std::future<void> done = task->get_future();
    post([task] { (*task)(); });
    return done;
  }

  // Waits until no thread of a destroyed HeadsetThread exists any more. Returns false if one still does, because a
  // runtime blocks it: then objects of that runtime still exist.
  static bool wait_for_ended(std::chrono::milliseconds timeout);

 private:
  struct Shared;
  void post(std::function<void()> job);
  std::shared_ptr<Shared> shared_;
};

}  // namespace gearshift::engine
