// Speed against error, one row a figure: what was measured, in which unit, and where the design puts it.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tests/bench/design.h"

namespace gearshift {

// Of the repetitions that a figure is the median of, in the figure's unit.
struct Quartiles {
  double low = 0.0, high = 0.0;
};

// Another figure of the same thing: what it costs, what it takes.
struct Beside {
  std::string what;
  double value = 0.0;
  std::string unit;
  std::optional<Quartiles> spread = {};  // where it was taken repeatedly
};

// A row as one of several methods: what it costs and how wrong it is. Less is better of both.
struct Trade {
  std::string
      contest;  // what is compared: those of one name in a family share a plot, and the figures' names and units
  std::string method;
  Beside cost, error;
  bool chosen = false;  // the shipped default
};

struct BenchRow {
  std::string family;
  std::string name;
  double value = 0.0;
  std::string unit;
  std::optional<double> goal;  // in the same unit
  bool at_least = false;       // the goal is a lower bound
  std::string note;
  bool measured = true;  // false: could not be measured here, the note says why
  std::vector<Beside> beside = {};
  std::optional<Quartiles> spread = {};  // where the value was taken repeatedly
  std::optional<Trade> trade = {};
  Design design = Design::none;  // the row of the design's table that this one answers
};

bool meets_goal(const BenchRow& row) noexcept;

inline constexpr double kDesignBlock = 60.0;  // [s] that the design asks of a block of wake-ups

struct BenchOptions {
  std::string gate_folder;             // where the shipped layouts are
  std::string model_folder;            // where the cabin is
  bool quick = false;                  // fewer repetitions: a look, not a figure to quote
  double jitter_block = kDesignBlock;  // [s] of each alternating block; a shorter one is given no verdict
  std::function<void(std::string_view family, double share)> progress;  // share in [0, 1]; may be empty
};

using BenchFamily = std::vector<BenchRow> (*)(const BenchOptions&);
struct NamedFamily {
  std::string_view name;
  BenchFamily run;
  std::vector<Design> answers = {};  // rows of the design's table that its rows answer
};
const std::vector<NamedFamily>& bench_families();

// Runs it. Throws std::logic_error where a row of the design that it claims is left without an answer, or answered
// without a claim.
std::vector<BenchRow> run_family(const NamedFamily& family, const BenchOptions& options);

// Where it cannot be run: why, in place of each of those answers; a row at least.
std::vector<BenchRow> unmeasured_family(const NamedFamily& family, const std::string& why);

std::vector<BenchRow> bench_cycle(const BenchOptions& options);      // cost of the haptic cycle and of its stages
std::vector<BenchRow> bench_headless(const BenchOptions& options);   // simulated seconds per second
std::vector<BenchRow> bench_plant(const BenchOptions& options);      // exact step against the closed form
std::vector<BenchRow> bench_feel(const BenchOptions& options);       // commanded force along a slot
std::vector<BenchRow> bench_intent(const BenchOptions& options);     // where a noisy hand ends up
std::vector<BenchRow> bench_proxy(const BenchOptions& options);      // ways to find it for a thrown lever
std::vector<BenchRow> bench_contact(const BenchOptions& options);    // what a 5000 N/m wall does under a push
std::vector<BenchRow> bench_energy(const BenchOptions& options);     // that the wall makes of an impact
std::vector<BenchRow> bench_delivered(const BenchOptions& options);  // force at the tip against a steady push
std::vector<BenchRow> bench_boundary(const BenchOptions& options);   // predicted stability against simulated divergence
std::vector<BenchRow> bench_methods(const BenchOptions& options);    // holds, estimators, energy control side by side
std::vector<BenchRow> bench_hard(const BenchOptions& options);       // rates, delays, pushes, jitter, quantisation
std::vector<BenchRow> bench_driveline(const BenchOptions& options);  // launch, dumps, money shift against a reference
std::vector<BenchRow> bench_learning(const BenchOptions& options);   // simulated learners: grade, faults, guidance
std::vector<BenchRow> bench_faults(const BenchOptions& options);     // time from a fault to no force
std::vector<BenchRow> bench_picture(const BenchOptions& options);    // the cabin, pass by pass; the first frame
std::vector<BenchRow> bench_quality(const BenchOptions& options);    // anti-aliasing, shadow, mirror, projected points
std::vector<BenchRow> bench_light(const BenchOptions& options);      // what is baked at the start
std::vector<BenchRow> bench_jitter(const BenchOptions& options);     // wake-up lateness beside cyclictest's
std::vector<BenchRow> bench_beside(const BenchOptions& options);     // the same while the renderer draws flat out

// Value at quantile q in [0, 1] of an unsorted sample; sorts it. Empty: 0.
double quantile(std::vector<double>& sample, double q);

// What was timed repeatedly: its median, and its quartiles where there are two at least. Sorts the sample.
struct Timed {
  double median = 0.0;
  std::optional<Quartiles> spread;
};
Timed timed(std::vector<double>& sample);

BenchRow answering(Design design, BenchRow row);                          // marked with what it answers
BenchRow repeated(const std::optional<Quartiles>& spread, BenchRow row);  // marked with the spread of its value

}  // namespace gearshift
