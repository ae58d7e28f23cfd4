#include "engine/xr/headset_thread.h"

#include <condition_variable>
#include <deque>
#include <mutex>
#include <system_error>
#include <thread>

#include "engine/xr/headset_error.h"

namespace gearshift::engine {
namespace {

// Threads whose HeadsetThread is destroyed. Never destroyed itself, because such a thread may outlive main().
struct Left {
  std::mutex mutex;
  std::condition_variable changed;
  int count = 0;
};
Left& left() {
  static auto* const one = new Left;
  return *one;
}

void add_to_left(int change) {
  const std::lock_guard lock(left().mutex);
  left().count += change;
  left().changed.notify_all();
}

}  // namespace

struct HeadsetThread::Shared {
  std::mutex mutex;
  std::condition_variable changed;
  std::deque<std::function<void()>> jobs;
  bool ends = false;

  std::function<void()> next_job() {  // empty: the thread ends
    std::unique_lock lock(mutex);
    changed.wait(lock, [this] { return ends || !jobs.empty(); });
    if (jobs.empty()) return {};
    std::function<void()> job = std::move(jobs.front());
    jobs.pop_front();
    return job;
  }
};

HeadsetThread::HeadsetThread() : shared_(std::make_shared<Shared>()) {
  try {
    std::thread([shared = shared_] {
      while (const std::function<void()> job = shared->next_job()) job();
      add_to_left(-1);
    }).detach();
  } catch (const std::system_error&) {
    throw HeadsetError("cannot start a thread for the headset");
  }
}

HeadsetThread::~HeadsetThread() {
  add_to_left(1);
  const std::lock_guard lock(shared_->mutex);
  shared_->ends = true;
  shared_->changed.notify_all();
}

void HeadsetThread::post(std::function<void()> job) {
  const std::lock_guard lock(shared_->mutex);
  shared_->jobs.push_back(std::move(job));
  shared_->changed.notify_all();
}

bool HeadsetThread::wait_for_ended(std::chrono::milliseconds timeout) {
  std::unique_lock lock(left().mutex);
  return left().changed.wait_for(lock, timeout, [] { return left().count == 0; });
}

}  // namespace gearshift::engine
