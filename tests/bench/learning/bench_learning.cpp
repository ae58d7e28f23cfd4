// What the trainer's judgement is worth, on simulated learners: does the grade tell who can drive, is a fault named,
// what does the guidance policy do to learning.
#include <filesystem>
#include <string>

#include "app/learner/learner_model.h"
#include "app/training/suggest.h"
#include "tests/bench/bench.h"
#include "tests/bench/learning/shipped_drive.h"

namespace gearshift {
namespace {

namespace fs = std::filesystem;

BenchRow separation_row(const LessonDriveConfig& drive, int each) {
  Separation s = separate(drive, each, 1);
  return {"learning",
          drive.lesson.key + ": grade tells skilled from unskilled",
          s.auc,
          "AUC",
          {},
          true,
          std::to_string(each) + " of each",
          true,
          {{"median grade, skilled", quantile(s.skilled, 0.5), ""},
           {"unskilled", quantile(s.unskilled, 0.5), ""},
           {"passed, skilled", 100.0 * s.skilled_passed / each, "%"},
           {"unskilled", 100.0 * s.unskilled_passed / each, "%"}}};
}

BenchRow fault_row(const LessonDriveConfig& drive, FaultKind kind, int each) {
  const FaultSeparation s = separate_fault(drive, kind, each, 1);
  return {"learning",
          std::string(fault_key(kind)) + " in " + drive.lesson.key,
          s.auc,
          "AUC",
          {},
          true,
          std::to_string(s.named) + " of " + std::to_string(s.driven) + " named, " + std::to_string(s.false_named) +
              " falsely"};
}

// Each kind in the first lesson that looks at it.
std::vector<BenchRow> fault_rows(const std::vector<LessonDriveConfig>& drives, int each) {
  std::vector<BenchRow> rows;
  for (int k = 0; k < kFaultKinds; ++k) {
    const auto kind = static_cast<FaultKind>(k);
    for (const LessonDriveConfig& drive : drives) {
      const bool reverse = drive.lesson.key == "reverse";
      if (kind == FaultKind::grind && !reverse) continue;  // no forward gear of a sound box grinds
      if (!looks_at(drive.lesson, kind)) continue;
      rows.push_back(fault_row(drive, kind, each));
      break;
    }
  }
  return rows;
}

std::vector<BenchRow> practice_rows(const LessonDriveConfig& drive, bool quick) {
  const int learners = quick ? 1 : 24, trials = quick ? 2 : 24;
  std::vector<BenchRow> rows;
  for (const double failed_loss : {0.5, 0.0}) {
    LearningModel model;
    model.failed_loss = failed_loss;
    for (const auto& [practice, name] : {std::pair{Practice::alone, "never guided"}, std::pair{Practice::led, "always"},
                                         std::pair{Practice::faded, "by the policy"}}) {
      const PracticeOutcome outcome = practise(drive, practice, model, learners, trials, 1);
      const std::string what = failed_loss > 0.0 ? "" : ", failures teach as much";
      rows.push_back({"learning",
                      drive.lesson.key + ", " + name + what,
                      outcome.error.back(),
                      "skill error left of " + std::to_string(outcome.error.front()).substr(0, 4),
                      {},
                      false,
                      std::to_string(learners) + " learners, " + std::to_string(trials) + " trials, model assumed",
                      true,
                      {{"retention grade", outcome.retention_grade, ""},
                       {"guided", 100.0 * outcome.guided_share, "%"},
                       {"of the first half", 100.0 * outcome.guided_early, "%"}}});
    }
  }
  return rows;
}

}  // namespace

std::vector<BenchRow> bench_learning(const BenchOptions& options) {
  const fs::path assets = fs::path(options.gate_folder).parent_path();
  const int each = options.quick ? 1 : 40;
  std::vector<LessonDriveConfig> drives;
  for (const std::string_view key : kTeachingOrder) drives.push_back(shipped_drive(assets, key));
  const auto tell = [&](double share) {
    if (options.progress) options.progress("learning", share);
  };
  std::vector<BenchRow> rows;
  for (const LessonDriveConfig& drive : drives) {
    tell(0.05 + 0.03 * static_cast<double>(rows.size()));
    rows.push_back(separation_row(drive, each));
  }
  const auto add = [&](std::vector<BenchRow> more) { rows.insert(rows.end(), more.begin(), more.end()); };
  add(fault_rows(drives, options.quick ? 1 : 20));
  tell(0.7);
  add(practice_rows(shipped_drive(assets, "skip_shifts"), options.quick));
  return rows;
}

}  // namespace gearshift
