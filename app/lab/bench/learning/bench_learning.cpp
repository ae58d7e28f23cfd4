// Measured with simulated drivers: are driving errors detected, and how does the guidance policy affect learning?
#include <filesystem>
#include <string>

#include "app/lab/bench/learning/shipped_drive.h"
#include "app/lab/bench/rows/bench.h"
#include "app/lessons/assessment/suggest.h"
#include "app/lessons/simulated_driver/learning_experiment.h"

namespace gearshift::lab {
namespace {

namespace fs = std::filesystem;

BenchRow fault_row(const lessons::LessonDriveConfig& drive, lessons::ErrorKind kind, int each) {
  const lessons::ErrorSeparation s = lessons::separate_error(drive, kind, each, 1);
  return {"learning",
          std::string(lessons::to_string(kind)) + " in " + drive.lesson.key,
          s.auc,
          "AUC",
          {},
          true,
          std::to_string(s.detected) + " of " + std::to_string(s.driven) +
              " detected, false alarms: " + std::to_string(s.false_alarms)};
}

// Tests the detection of each kind of error, in the first lesson that assesses it.
std::vector<BenchRow> fault_rows(const std::vector<lessons::LessonDriveConfig>& drives, int each) {
  std::vector<BenchRow> rows;
  for (int k = 0; k < lessons::kErrorKindCount; ++k) {
    const auto kind = static_cast<lessons::ErrorKind>(k);
    for (const lessons::LessonDriveConfig& drive : drives) {
      const bool reverse = drive.lesson.key == "reverse";
      if (kind == lessons::ErrorKind::grind && !reverse) continue;  // forward gears have synchronisers, so never grind
      if (!lessons::assesses(drive.lesson, kind)) continue;
      rows.push_back(fault_row(drive, kind, each));
      break;
    }
  }
  return rows;
}

std::vector<BenchRow> practice_rows(const lessons::LessonDriveConfig& drive, bool quick) {
  const int learners = quick ? 2 : 24, trials = quick ? 2 : 24;
  std::vector<BenchRow> rows;
  for (const double failed_loss : {0.5, 0.0}) {
    lessons::LearningModel model;
    model.failed_loss = failed_loss;
    std::vector<double> unguided;  // the test error of each learner
    for (const auto& [practice, name] :
         {std::pair{lessons::Practice::unguided, "never helped"}, std::pair{lessons::Practice::always, "always helped"},
          std::pair{lessons::Practice::both_limbs, "helped after errors of any limb"},
          std::pair{lessons::Practice::by_limb, "helped by the policy"}}) {
      const lessons::PracticeOutcome outcome = lessons::practise(drive, practice, model, learners, trials, 1);
      if (practice == lessons::Practice::unguided) unguided = outcome.test_error;
      const lessons::IntervalEstimate more = lessons::paired_difference(outcome.test_error, unguided);
      const std::string what = failed_loss > 0.0 ? "" : ", learning as much from failures";
      rows.push_back({"learning",
                      drive.lesson.key + ", " + name + what,
                      outcome.error.back(),
                      "remaining skill error, initially " + std::to_string(outcome.error.front()).substr(0, 4),
                      {},
                      false,
                      std::to_string(learners) + " simulated learners, " + std::to_string(trials) +
                          " trials each, assumed learning model",
                      true,
                      {{"error in the final tests, beyond that of never helped", more.value, ""},
                       {"95 % interval from", more.low, ""},
                       {"to", more.high, ""},
                       {"helped", 100.0 * outcome.guided_fraction, "%"},
                       {"helped trials in the first half", 100.0 * outcome.guided_early, "%"}}});
    }
  }
  return rows;
}

}  // namespace

std::vector<BenchRow> bench_learning(const BenchOptions& options) {
  const fs::path assets = fs::path(options.gate_folder).parent_path();
  std::vector<lessons::LessonDriveConfig> drives;
  for (const std::string_view key : lessons::kTeachingOrder) drives.push_back(shipped_drive(assets, key));
  const auto report = [&](double fraction) {
    if (options.progress) options.progress("learning", fraction);
  };
  std::vector<BenchRow> rows;
  const auto add = [&](std::vector<BenchRow> more) { rows.insert(rows.end(), more.begin(), more.end()); };
  add(fault_rows(drives, options.quick ? 1 : 20));
  report(0.7);
  add(practice_rows(shipped_drive(assets, "skip_shifts"), options.quick));
  return rows;
}

}  // namespace gearshift::lab
