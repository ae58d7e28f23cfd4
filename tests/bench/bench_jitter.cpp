// Wake-up lateness of the loop's thread beside cyclictest's: alternating blocks, same policy, priority, core,
// period.
#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <thread>

#include "haptics/rt/realtime_thread.h"
#include "tests/bench/bench.h"
#include "tests/bench/touring.h"

namespace gearshift {
namespace {

constexpr int kPriority = 80;
constexpr int kBlocks = 5;  // of each contestant, alternating
constexpr std::array<double, 2> kQuantiles{0.99, 0.999};

struct Lateness {
  std::array<double, 2> us{};  // at kQuantiles
};

// The shipped loop with the simulated lever on the real-time thread, for `seconds`.
Lateness run_ours(const Gate& gate, double seconds, std::int64_t spin_ns, int core) {
  SimulatedRunConfig config = touring_config(gate);
  ScriptedHand driver = touring_driver(gate, 0.001);
  SimulatedRun run(config, driver);
  RealtimeConfig realtime;
  realtime.policy = RealtimePolicy::required;
  realtime.priority = kPriority;
  realtime.spin_ns = spin_ns;
  realtime.core = core;
  RealtimeThread thread;
  thread.start(realtime, [&](const CycleCall& call) { run.loop().cycle(call.deadline_ns, call.skipped); });
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  thread.stop();
  Lateness result;
  for (std::size_t i = 0; i < 2; ++i) {
    result.us[i] = 1e-3 * static_cast<double>(thread.statistics().wake_lateness.quantile(kQuantiles[i]));
  }
  return result;
}

std::vector<std::uint64_t> read_histogram(std::FILE* pipe) {
  std::vector<std::uint64_t> histogram;
  char line[512];
  unsigned long long us = 0, count = 0;
  while (std::fgets(line, sizeof line, pipe)) {
    if (line[0] == '#' || std::sscanf(line, "%llu %llu", &us, &count) != 2) continue;
    if (histogram.size() <= us) histogram.resize(us + 1);
    histogram[us] += count;
  }
  return histogram;
}

// cyclictest prints how often each whole microsecond of lateness was seen.
Lateness run_cyclictest(double seconds, int core) {
  char command[256];
  std::snprintf(command, sizeof command,
                "cyclictest --policy=fifo -p %d -t 1 -a %d -i 1000 -m -q -D %d -h 100000 2>/dev/null", kPriority, core,
                static_cast<int>(seconds));
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(popen(command, "r"), pclose);
  const std::vector<std::uint64_t> histogram = pipe ? read_histogram(pipe.get()) : std::vector<std::uint64_t>{};
  std::uint64_t total = 0;
  for (const std::uint64_t n : histogram) total += n;
  Lateness result;
  for (std::size_t i = 0; i < 2; ++i) {
    double seen = 0.0;
    for (std::size_t us = 0; us < histogram.size(); ++us) {
      seen += static_cast<double>(histogram[us]);
      if (seen < kQuantiles[i] * static_cast<double>(total)) continue;
      result.us[i] = static_cast<double>(us) + 1.0;  // upper edge
      break;
    }
  }
  return result;
}

// One busy thread per core that streams through memory, as a software renderer does.
class Load {
 public:
  explicit Load(bool on) {
    for (unsigned i = 0; on && i < std::thread::hardware_concurrency(); ++i)
      threads_.emplace_back([this] { stream(); });
  }
  ~Load() {
    stop_ = true;
    for (std::thread& thread : threads_) thread.join();
  }
  Load(const Load&) = delete;
  Load& operator=(const Load&) = delete;

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

struct Contest {
  std::array<std::vector<double>, 2> theirs, sleeping, spinning, sleeping_ratio, spinning_ratio;
};

Contest compete(const Gate& gate, const BenchOptions& options, bool loaded) {
  const Load load(loaded);
  const int core = static_cast<int>(std::thread::hardware_concurrency()) - 1;
  const int blocks = options.quick ? 1 : kBlocks;
  Contest contest;
  for (int b = 0; b < blocks; ++b) {
    if (options.progress) options.progress("jitter", (static_cast<double>(b) / blocks + (loaded ? 1.0 : 0.0)) / 2.0);
    const Lateness theirs = run_cyclictest(options.jitter_block, core);
    const Lateness sleeping = run_ours(gate, options.jitter_block, 0, core);
    const Lateness spinning = run_ours(gate, options.jitter_block, RealtimeConfig{}.spin_ns, core);
    for (std::size_t i = 0; i < 2; ++i) {
      contest.theirs[i].push_back(theirs.us[i]);
      contest.sleeping[i].push_back(sleeping.us[i]);
      contest.spinning[i].push_back(spinning.us[i]);
      contest.sleeping_ratio[i].push_back(sleeping.us[i] / theirs.us[i]);
      contest.spinning_ratio[i].push_back(spinning.us[i] / theirs.us[i]);
    }
  }
  return contest;
}

// Ours beside theirs: the figure itself, and the median of the blocks' ratios, which is what is compared.
void add_ours(std::vector<BenchRow>& rows, const std::string& what, std::vector<double>& us, std::vector<double>& ratio,
              const std::string& note) {
  rows.push_back({"jitter", "ours, " + what, quantile(us, 0.5), "us", {}, false, note});
  rows.push_back({"jitter", "ours / cyclictest, " + what, quantile(ratio, 0.5), "ratio", 1.2, false, note});
}

void add_rows(std::vector<BenchRow>& rows, Contest& contest, double seconds, bool loaded) {
  const std::string where = loaded ? ", beside one busy thread per core" : ", alone";
  const std::string note = "median of " + std::to_string(contest.theirs[0].size()) + " alternating blocks of " +
                           std::to_string(static_cast<int>(seconds)) + " s";
  for (std::size_t i = 0; i < kQuantiles.size(); ++i) {
    std::string at = i == 0 ? "p99" : "p99.9";
    at += where;
    rows.push_back({"jitter", "cyclictest, " + at, quantile(contest.theirs[i], 0.5), "us", {}, false, note});
    add_ours(rows, "sleep only, " + at, contest.sleeping[i], contest.sleeping_ratio[i], note);
    add_ours(rows, "spin 50 us, " + at, contest.spinning[i], contest.spinning_ratio[i], note);
  }
}

BenchRow not_measurable(const std::string& why) {
  BenchRow row{"jitter", "wake-up lateness", 0.0, "us", {}, false, "not measurable: " + why};
  row.measured = false;
  return row;
}

}  // namespace

std::vector<BenchRow> bench_jitter(const BenchOptions& options) {
  if (std::system("command -v cyclictest >/dev/null 2>&1") != 0)
    return {not_measurable("cyclictest (package rt-tests) is not installed")};
  const Gate gate = bench_gate(options.gate_folder, "paper");
  std::vector<BenchRow> rows;
  try {
    for (const bool loaded : {false, true}) {
      Contest contest = compete(gate, options, loaded);
      if (quantile(contest.theirs[0], 0.5) == 0.0) return {not_measurable("cyclictest has no real-time rights")};
      add_rows(rows, contest, options.jitter_block, loaded);
    }
  } catch (const std::runtime_error& error) {
    return {not_measurable(error.what())};
  }
  return rows;
}

}  // namespace gearshift
