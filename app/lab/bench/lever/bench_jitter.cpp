// Compares the wake-up lateness of the loop's thread with cyclictest, on an idle machine and under memory load.
#include <atomic>
#include <thread>

#include "app/lab/bench/lever/jitter_contest.h"

namespace gearshift::lab {
namespace {

// One thread per core that streams through memory, as a software renderer does.
class StreamingThreads {
 public:
  StreamingThreads() {
    for (unsigned i = 0; i < std::thread::hardware_concurrency(); ++i) threads_.emplace_back([this] { stream(); });
  }
  ~StreamingThreads() {
    stop_ = true;
    for (std::thread& thread : threads_) thread.join();
  }
  StreamingThreads(const StreamingThreads&) = delete;
  StreamingThreads& operator=(const StreamingThreads&) = delete;

 private:
  void stream() {
    std::vector<float> memory(std::size_t{8} << 20, 1.0f);
    while (!stop_) {
      for (float& x : memory) x = x * 0.999f + 0.001f;
    }
  }
  std::atomic<bool> stop_{false};
  std::vector<std::thread> threads_;
};

}  // namespace

std::vector<BenchRow> bench_jitter(const BenchOptions& options) {
  const JitterLoad none{", alone", [] { return std::shared_ptr<void>(); }};
  const JitterLoad busy{", with one busy thread per core", [] { return std::make_shared<StreamingThreads>(); }};
  std::vector<BenchRow> rows = jitter_rows(options, "jitter", none, 0.0, 0.5);
  for (BenchRow& row : jitter_rows(options, "jitter", busy, 0.5, 1.0)) rows.push_back(std::move(row));
  return rows;
}

}  // namespace gearshift::lab
