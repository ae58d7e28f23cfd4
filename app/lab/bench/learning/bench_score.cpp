// Does the grade tell practised drivers from others? Measured with populations of simulated drivers that neither made the
// norms nor set their limits.
#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "app/lab/bench/learning/shipped_drive.h"
#include "app/lab/bench/rows/bench.h"
#include "app/lessons/assessment/suggest.h"
#include "app/lessons/simulated_driver/learning_experiment.h"
#include "app/lessons/simulated_driver/population.h"

namespace gearshift::lab {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kCheckSeed = 303;
constexpr const char* kNote = "simulated drivers";

struct Drives {
  std::vector<double> grades;
  std::vector<double> scores;  // [1] LessonResult::score, negative, so that more is better
  int passed = 0;
  lessons::IntervalEstimate pass_rate() const {
    return lessons::fraction_estimate(passed, static_cast<int>(grades.size()));
  }
};

Drives drive(const lessons::LessonDriveConfig& config, const lessons::Population& population) {
  constexpr double kUnfinished = -1e9;  // worse than any finished run
  Drives drives;
  for (const lessons::LessonResult& result : lessons::drive_population(config, population)) {
    const bool is_done = result.end == lessons::LessonEnd::done;
    drives.grades.push_back(is_done ? result.grade : -1.0);
    drives.scores.push_back(is_done ? -result.score.value_or(0.0) : kUnfinished);
    drives.passed += result.passed ? 1 : 0;
  }
  return drives;
}

BenchRow estimate_row(const std::string& name, const lessons::IntervalEstimate& estimate, double scale,
                      const char* unit, std::optional<double> goal, bool at_least) {
  return {"score", name, scale * estimate.value,
          unit,    goal, at_least,
          kNote,   true, {{"95 % interval from", scale * estimate.low, unit}, {"to", scale * estimate.high, unit}}};
}

BenchRow auc_row(const std::string& name, const Drives& good, const Drives& bad, std::optional<double> goal = {}) {
  BenchRow row = estimate_row(name, lessons::auc_estimate(good.grades, bad.grades), 1.0, "AUC", goal, true);
  row.related.push_back({"of the distance from the norm only", lessons::roc_auc(good.scores, bad.scores), "AUC"});
  return row;
}

BenchRow pass_row(const std::string& name, const Drives& drives, std::optional<double> goal, bool at_least) {
  return estimate_row(name, drives.pass_rate(), 100.0, "%", goal, at_least);
}

struct Counts {
  int each, other;  // drivers per class; drivers per other population
};

void add_rows(std::vector<BenchRow>& rows, const lessons::LessonDriveConfig& config, lessons::LessonMode mode,
              const Counts& counts) {
  const std::string name = config.lesson.key + (mode == lessons::LessonMode::follow_me ? " with prompts: " : ": ");
  const auto population = [&](double error, int drivers, std::uint64_t more) {
    return lessons::Population{error, drivers, kCheckSeed + more, mode};
  };
  const Drives practised = drive(config, population(0.0, counts.each, 0)),
               middle = drive(config, population(0.3, counts.each, 1)),
               novice = drive(config, population(0.6, counts.each, 2));
  rows.push_back(auc_row(name + "error 0.6", practised, novice, 0.95));
  rows.push_back(auc_row(name + "error 0.3", practised, middle, 0.80));
  rows.push_back(pass_row(name + "passed, practised", practised, 95.0, true));
  rows.push_back(pass_row(name + "passed, error 0.6", novice, 20.0, false));
  rows.back().related.push_back({"passed, error 0.3", 100.0 * middle.pass_rate().value, "%"});
  if (mode == lessons::LessonMode::follow_me) return;
  lessons::Population wide = population(0.0, counts.other, 3);
  for (double lessons::StyleSpread::*spread :
       {&lessons::StyleSpread::pace, &lessons::StyleSpread::reaction, &lessons::StyleSpread::haste,
        &lessons::StyleSpread::gas, &lessons::StyleSpread::hearing, &lessons::StyleSpread::bite_error})
    wide.style.*spread *= 1.5;
  rows.push_back(pass_row(name + "passed, practised, styles half as wide again", drive(config, wide), {}, true));
  for (const auto& [limbs, what] : {std::pair{lessons::Limbs::hand, "error 0.6 of the hand only"},
                                    std::pair{lessons::Limbs::feet, "error 0.6 of the feet only"}}) {
    lessons::Population some = population(0.6, counts.other, 4);
    some.limbs = limbs;
    const Drives drives = drive(config, some);
    rows.push_back(auc_row(name + what, practised, drives));
    rows.back().related.push_back({"passed", 100.0 * drives.pass_rate().value, "%"});
  }
}

}  // namespace

std::vector<BenchRow> bench_score(const BenchOptions& options) {
  const fs::path assets = fs::path(options.gate_folder).parent_path();
  const Counts counts = options.quick ? Counts{2, 1} : Counts{40, 20};
  std::vector<BenchRow> rows;
  double done = 0.0;
  for (const std::string_view key : lessons::kTeachingOrder) {
    const lessons::LessonDriveConfig config = shipped_drive(assets, key);
    for (const lessons::LessonMode mode : {lessons::LessonMode::by_yourself, lessons::LessonMode::follow_me}) {
      if (options.progress) options.progress("score", done++ / (2.0 * lessons::kTeachingOrder.size()));
      add_rows(rows, config, mode, counts);
    }
  }
  rows.front().design = Design::score;
  return rows;
}

std::string derive_norms(const BenchOptions& options) {
  const fs::path assets = fs::path(options.gate_folder).parent_path();
  std::vector<lessons::Norm> norms;
  for (const std::string_view key : lessons::kTeachingOrder) {
    for (const lessons::LessonMode mode : {lessons::LessonMode::by_yourself, lessons::LessonMode::follow_me}) {
      if (options.progress)
        options.progress("norms", static_cast<double>(norms.size()) / (2.0 * lessons::kTeachingOrder.size()));
      norms.push_back(lessons::derive_norm(shipped_drive(assets, key), mode));
    }
  }
  return lessons::norms_text(norms);
}

}  // namespace gearshift::lab
