#include "app/lab/bench/lever/jitter_contest.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <thread>

#include "app/lab/bench/lever/touring.h"
#include "haptics/rt/realtime_thread.h"

namespace gearshift::lab {
namespace {

constexpr int kPriority = 80;
constexpr int kBlocks = 5;  // blocks per program; the programs alternate
constexpr std::array<double, 2> kQuantiles{0.99, 0.999};

struct Lateness {
  std::array<double, 2> us{};  // [us] lateness at kQuantiles
  double cycle_us = 0.0;       // [us] duration of a cycle at the last of kQuantiles; only measured for our loop
  double overruns = 0.0;       // only counted for our loop
};

// Called several times per second. May throw to interrupt the bench.
using Pulse = std::function<void()>;
constexpr std::chrono::milliseconds kPulse{250};

void wait_for(double seconds, const Pulse& pulse) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  for (; Clock::now() < end; pulse()) std::this_thread::sleep_until(std::min(end, Clock::now() + kPulse));
}

// Runs the shipped loop with the simulated lever on the real-time thread for `seconds`.
Lateness run_loop(const haptics::Gate& gate, double seconds, std::int64_t spin_ns, int core, const Pulse& pulse) {
  haptics::SimulatedRunConfig config = touring_config(gate);
  haptics::ScriptedHand driver = touring_driver(gate, 0.001);
  haptics::SimulatedRun run(config, driver);
  haptics::RealtimeConfig realtime;
  realtime.policy = haptics::RealtimePolicy::required;
  realtime.priority = kPriority;
  realtime.spin_ns = spin_ns;
  realtime.core = core;
  haptics::RealtimeThread thread;
  thread.start(realtime, [&](const haptics::CycleCall& call) { run.loop().cycle(call.deadline_ns, call.skipped); });
  wait_for(seconds, pulse);
  thread.stop();
  Lateness result;
  for (std::size_t i = 0; i < 2; ++i) {
    result.us[i] = 1e-3 * static_cast<double>(thread.statistics().wake_lateness.quantile(kQuantiles[i]));
  }
  result.cycle_us = 1e-3 * static_cast<double>(thread.statistics().duration.quantile(kQuantiles[1]));
  result.overruns = static_cast<double>(thread.statistics().overruns);
  return result;
}

// A running cyclictest process. The kernel terminates cyclictest if this process dies.
class Cyclictest {
 public:
  Cyclictest(double seconds, int core) {
    const std::string priority = std::to_string(kPriority), on = std::to_string(core);
    const std::string duration = std::to_string(static_cast<int>(seconds));
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) return;
    child_ = fork();
    if (child_ == 0) {
      prctl(PR_SET_PDEATHSIG, SIGTERM);
      dup2(ends[1], STDOUT_FILENO);
      dup2(open("/dev/null", O_WRONLY | O_CLOEXEC), STDERR_FILENO);
      execlp("cyclictest", "cyclictest", "--policy=fifo", "-p", priority.c_str(), "-t", "1", "-a", on.c_str(), "-i",
             "1000", "-m", "-q", "-D", duration.c_str(), "-h", "100000", static_cast<char*>(nullptr));
      _exit(127);
    }
    close(ends[1]);
    output_ = fdopen(ends[0], "r");
  }
  ~Cyclictest() {
    if (output_) std::fclose(output_);
    if (child_ <= 0) return;
    kill(child_, SIGTERM);
    waitpid(child_, nullptr, 0);
  }
  Cyclictest(const Cyclictest&) = delete;
  Cyclictest& operator=(const Cyclictest&) = delete;

  std::FILE* output() const noexcept { return output_; }

 private:
  pid_t child_ = -1;
  std::FILE* output_ = nullptr;
};

std::vector<std::uint64_t> read_histogram(std::FILE* pipe, const Pulse& pulse) {
  std::vector<std::uint64_t> histogram;
  char line[512];
  unsigned long long us = 0, count = 0;
  for (pollfd first{fileno(pipe), POLLIN, 0}; poll(&first, 1, static_cast<int>(kPulse.count())) != 1;) pulse();
  while (std::fgets(line, sizeof line, pipe)) {
    if (line[0] == '#' || std::sscanf(line, "%llu %llu", &us, &count) != 2) continue;
    if (histogram.size() <= us) histogram.resize(us + 1);
    histogram[us] += count;
  }
  return histogram;
}

// Runs cyclictest and computes the quantiles from the histogram that it prints at its end (lateness in whole
// microseconds).
Lateness run_cyclictest(double seconds, int core, const Pulse& pulse) {
  const Cyclictest cyclictest(seconds, core);
  std::vector<std::uint64_t> histogram;
  if (cyclictest.output()) histogram = read_histogram(cyclictest.output(), pulse);
  std::uint64_t total = 0;
  for (const std::uint64_t n : histogram) total += n;
  Lateness result;
  for (std::size_t i = 0; i < 2; ++i) {
    double counted = 0.0;
    for (std::size_t us = 0; us < histogram.size(); ++us) {
      counted += static_cast<double>(histogram[us]);
      if (counted < kQuantiles[i] * static_cast<double>(total)) continue;
      result.us[i] = static_cast<double>(us) + 1.0;  // upper edge of the microsecond
      break;
    }
  }
  return result;
}

// Rounds up to the end of the microsecond, as run_cyclictest() does.
double upper_edge(double us) {
  return std::floor(us) + 1.0;
}

struct Contest {
  std::array<std::vector<double>, 2> theirs, sleeping, spinning, sleeping_ratio, spinning_ratio;
  std::vector<double> cycle_us;  // [us] durations of cycles, measured with spinning (the shipped setting)
  double overruns = 0.0;         // sum over all blocks
};

Contest compete(const haptics::Gate& gate, const BenchOptions& options, const std::function<void(double)>& progress) {
  const int core = static_cast<int>(std::thread::hardware_concurrency()) - 1;
  const int blocks = options.quick ? 1 : kBlocks;
  Contest contest;
  for (int b = 0; b < blocks; ++b) {
    const Pulse pulse = [&] { progress(static_cast<double>(b) / blocks); };
    const Lateness theirs = run_cyclictest(options.jitter_block, core, pulse);
    const Lateness sleeping = run_loop(gate, options.jitter_block, 0, core, pulse);
    const Lateness spinning = run_loop(gate, options.jitter_block, haptics::RealtimeConfig{}.spin_ns, core, pulse);
    contest.cycle_us.push_back(spinning.cycle_us);
    contest.overruns += spinning.overruns + sleeping.overruns;
    for (std::size_t i = 0; i < 2; ++i) {
      contest.theirs[i].push_back(theirs.us[i]);
      contest.sleeping[i].push_back(sleeping.us[i]);
      contest.spinning[i].push_back(spinning.us[i]);
      contest.sleeping_ratio[i].push_back(upper_edge(sleeping.us[i]) / theirs.us[i]);
      contest.spinning_ratio[i].push_back(upper_edge(spinning.us[i]) / theirs.us[i]);
    }
  }
  progress(1.0);  // throws if the last block was interrupted, so that its results do not count as complete
  return contest;
}

BenchRow block_row(const std::string& family, const std::string& what, std::vector<double>& of_blocks,
                   const std::string& unit, const std::string& note) {
  const Timed blocks = timed(of_blocks);
  return with_spread(blocks.spread, {family, what, blocks.median, unit, {}, false, note});
}

// True if the number and length of the blocks are as the design requires. Otherwise the rows are not compared with
// their goals.
bool is_judged(const BenchOptions& options) {
  return !options.quick && options.jitter_block >= kDesignBlock;
}

// Adds a row with our lateness, and a row with the ratio of our lateness to cyclictest's, which has the goal.
void add_loop_rows(std::vector<BenchRow>& rows, const std::string& family, const std::string& what,
                   std::vector<double>& us, std::vector<double>& ratio, const std::string& note, bool judged) {
  rows.push_back(block_row(family, "ours, " + what, us, "us", note));
  rows.push_back(answers_design(Design::jitter, block_row(family, "ours / cyclictest, " + what, ratio, "ratio", note)));
  if (judged) rows.back().goal = 1.2;
}

std::vector<BenchRow> rows_of(Contest& contest, const BenchOptions& options, const std::string& family,
                              const std::string& where) {
  const bool judged = is_judged(options);
  const std::size_t blocks = contest.theirs[0].size();
  const std::string each = std::to_string(static_cast<int>(options.jitter_block)) + " s";
  const std::string note = (blocks == 1 ? "one block of " + each
                                        : "median of " + std::to_string(blocks) + " alternating blocks of " + each) +
                           (judged ? "" : "; too few or too short blocks for a verdict");
  std::vector<BenchRow> rows;
  for (std::size_t i = 0; i < kQuantiles.size(); ++i) {
    std::string at = i == 0 ? "p99" : "p99.9";
    at += where;
    rows.push_back(block_row(family, "cyclictest, " + at, contest.theirs[i], "us", note));
    add_loop_rows(rows, family, "sleep only, " + at, contest.sleeping[i], contest.sleeping_ratio[i], note, judged);
    add_loop_rows(rows, family, "spin 50 us, " + at, contest.spinning[i], contest.spinning_ratio[i], note, judged);
  }
  rows.push_back(block_row(family, "ours, work per cycle, p99.9" + where, contest.cycle_us, "us", note));
  rows.back().related.push_back({"overruns in all blocks", contest.overruns, ""});
  return rows;
}

BenchRow not_measurable(const std::string& family, const std::string& why) {
  BenchRow row{family, "wake-up lateness", 0.0, "us", {}, false, "not measurable, because " + why};
  row.measured = false;
  row.goal = 1.2;
  return answers_design(Design::jitter, std::move(row));
}

}  // namespace

std::vector<BenchRow> jitter_rows(const BenchOptions& options, const std::string& family, const JitterLoad& load,
                                  double progress_begin, double progress_end) {
  if (std::system("command -v cyclictest >/dev/null 2>&1") != 0)
    return {not_measurable(family, "cyclictest (package rt-tests) is not installed")};
  const auto progress = [&](double fraction) {
    if (options.progress) options.progress(family, progress_begin + fraction * (progress_end - progress_begin));
  };
  try {
    const haptics::Gate gate = bench_gate(options.gate_folder, "paper");
    const std::shared_ptr<void> running = load.start();
    Contest contest = compete(gate, options, progress);
    if (quantile(contest.theirs[0], 0.5) == 0.0)
      return {not_measurable(family, "cyclictest may not use real-time priority")};
    return rows_of(contest, options, family, load.where);
  } catch (const std::runtime_error& error) {
    return {not_measurable(family, error.what())};
  }
}

}  // namespace gearshift::lab
