// The rows of `gearshift bench`: measured value, unit and goal. A family is a group of rows that is measured together.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/base/chart.h"
#include "app/lab/bench/rows/design.h"

namespace gearshift::lab {

// Lower and upper quartile of repeated measurements, in the unit of their median.
struct Quartiles {
  double low = 0.0, high = 0.0;
};

// An additional figure of a measurement, such as its cost.
struct RelatedFigure {
  std::string what;
  double value = 0.0;
  std::string unit;
  std::optional<Quartiles> spread = {};  // set if the measurement was repeated
};

// Cost and error of one of several compared methods. Lower is better for both.
struct Trade {
  std::string contest;  // methods with equal contest share a plot; the names and units of their figures must be equal
  std::string method;
  RelatedFigure cost, error;
  bool chosen = false;  // the shipped default
};

struct BenchRow {
  std::string family;
  std::string name;
  double value = 0.0;
  std::string unit;
  std::optional<double> goal;  // in the unit of `value`
  bool at_least = false;       // true: the goal is a lower bound
  std::string note;
  bool measured = true;  // false: not measurable on this machine; `note` gives the reason
  std::vector<RelatedFigure> related = {};
  std::optional<Quartiles> spread = {};  // set if the measurement was repeated
  std::optional<Trade> trade = {};
  std::vector<base::Curve> curves = {};  // drawn beside each other
  Design design = Design::none;          // requirement that this row answers
};

bool meets_goal(const BenchRow& row) noexcept;

inline constexpr double kDesignBlock = 60.0;  // [s] length of a jitter block required by the design

struct BenchOptions {
  std::string gate_folder;             // folder of the shipped layouts
  std::string model_folder;            // folder of the cabin model
  bool quick = false;                  // fewer repetitions; the results are too rough to quote
  double jitter_block = kDesignBlock;  // [s] length of each block; below kDesignBlock the jitter rows get no verdict
  std::function<void(std::string_view family, double fraction)> progress;  // may be empty; fraction: 0 to 1
};

using BenchFamily = std::vector<BenchRow> (*)(const BenchOptions&);
struct NamedFamily {
  std::string_view name;
  BenchFamily run;
  std::vector<Design> answers = {};  // requirements that the family's rows answer
};
const std::vector<NamedFamily>& bench_families();

// Measures a family of rows. Throws std::logic_error if the rows do not answer exactly the requirements in
// `family.answers`.
std::vector<BenchRow> run_family(const NamedFamily& family, const BenchOptions& options);

// Returns rows for a family that cannot be measured: one row per requirement, or one row if the family answers no
// requirement. why: becomes the rows' note.
std::vector<BenchRow> unmeasured_family(const NamedFamily& family, const std::string& why);

std::vector<BenchRow> bench_cycle(const BenchOptions& options);      // cost of the haptic cycle and of its stages
std::vector<BenchRow> bench_headless(const BenchOptions& options);   // simulated seconds per elapsed second
std::vector<BenchRow> bench_plant(const BenchOptions& options);      // exact plant step against the closed form
std::vector<BenchRow> bench_feel(const BenchOptions& options);       // commanded force along a slot
std::vector<BenchRow> bench_intent(const BenchOptions& options);     // how often a noisy hand reaches its gear
std::vector<BenchRow> bench_proxy(const BenchOptions& options);      // methods of finding the proxy of a fast lever
std::vector<BenchRow> bench_contact(const BenchOptions& options);    // a wall of 5000 N/m under a push
std::vector<BenchRow> bench_energy(const BenchOptions& options);     // energy that a wall generates in an impact
std::vector<BenchRow> bench_delivered(const BenchOptions& options);  // force at the tip against a steady push
std::vector<BenchRow> bench_boundary(const BenchOptions& options);   // predicted stability against simulated divergence
std::vector<BenchRow> bench_methods(const BenchOptions& options);    // contact holds, estimators and energy control
std::vector<BenchRow> bench_search(const BenchOptions& options);     // the observer's stiffness and damping
std::vector<BenchRow> bench_hard(const BenchOptions& options);       // many rates, delays, pushes, jitter, quantisation
std::vector<BenchRow> bench_driveline(const BenchOptions& options);  // integration methods against a reference
std::vector<BenchRow> bench_learning(const BenchOptions& options);   // assessment and guidance of simulated drivers
std::vector<BenchRow> bench_score(const BenchOptions& options);    // does the grade tell practised drivers from others
std::vector<BenchRow> bench_faults(const BenchOptions& options);   // time from a fault to zero force
std::vector<BenchRow> bench_picture(const BenchOptions& options);  // render time per pass; time to the first frame
std::vector<BenchRow> bench_quality(const BenchOptions& options);  // anti-aliasing, shadow, mirror, projected points
std::vector<BenchRow> bench_light(const BenchOptions& options);    // time and error of baking lights
std::vector<BenchRow> bench_jitter(const BenchOptions& options);   // wake-up lateness compared with cyclictest
std::vector<BenchRow> bench_beside(const BenchOptions& options);   // wake-up lateness with the renderer at full load

// Drives the populations of practised drivers and returns the content of assets/lessons/norms/simulated.toml. Takes minutes.
std::string derive_norms(const BenchOptions& options);

// Returns quantile q (0 to 1) of the sample, or 0 if the sample is empty. Sorts the sample.
double quantile(std::vector<double>& sample, double q);

// Median of repeated measurements; with at least two measurements, also their quartiles. timed() sorts the sample.
struct Timed {
  double median = 0.0;
  std::optional<Quartiles> spread;
};
Timed timed(std::vector<double>& sample);

BenchRow answers_design(Design design, BenchRow row);                        // sets the requirement that `row` answers
BenchRow with_spread(const std::optional<Quartiles>& spread, BenchRow row);  // sets the quartiles of the row's value

}  // namespace gearshift::lab
