// What the trainer's judgement is worth, on simulated learners: does the grade tell who can drive, is a fault named,
// what does the guidance policy do to learning; and what a headless lesson costs.
#include <chrono>
#include <filesystem>
#include <string>

#include "app/learner/learner_model.h"
#include "app/training/suggest.h"
#include "app/vehicle/car_world.h"
#include "tests/bench/bench.h"
#include "tests/bench/touring.h"

namespace gearshift {
namespace {

namespace fs = std::filesystem;

LessonDriveConfig shipped_drive(const fs::path& assets, std::string_view key) {
  LessonDriveConfig config;
  config.lesson = read_lesson(assets / "lessons" / (std::string(key) + ".toml"));
  const std::string car = config.lesson.car.empty() ? "hatchback" : config.lesson.car;
  config.car = read_car(assets / "cars" / (car + ".toml"));
  const std::string gate = config.lesson.gate.empty() ? config.car.gate : config.lesson.gate;
  config.gate = read_gate_layout(assets / "gates" / (gate + ".toml"));
  return config;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// The lever's tour with the car behind it, clutch down.
double lever_and_car(const BenchOptions& options, const CarSpec& car) {
  const Gate gate = bench_gate(options.gate_folder, car.gate);
  ScriptedHand driver = touring_driver(gate, 0.001);
  CarWorld world(car, gate, 31.7);
  SimulatedRun run(touring_config(gate), driver, &world);
  DriverControls feet;
  feet.clutch = 1.0;
  feet.ignition = true;
  run.channels().controls.write(feet);
  const auto start = std::chrono::steady_clock::now();
  while (run.time() < driver.duration()) run.step();
  return run.time() / seconds_since(start);
}

double whole_lesson(const LessonDriveConfig& drive) {
  const auto start = std::chrono::steady_clock::now();
  return drive_lesson(drive).duration / seconds_since(start);
}

// Alternately, so that a busy machine slows both alike.
std::vector<BenchRow> cost_rows(const BenchOptions& options, const fs::path& assets) {
  const LessonDriveConfig drive = shipped_drive(assets, "down_through_the_gears");
  const int runs = options.quick ? 5 : 41;
  std::vector<double> lever, lesson;
  for (int i = 0; i < runs; ++i) {
    lever.push_back(lever_and_car(options, drive.car));
    lesson.push_back(whole_lesson(drive));
  }
  const auto row = [&](const char* name, std::vector<double>& speed, const char* what) {
    return BenchRow{"learning",
                    name,
                    quantile(speed, 0.5),
                    "x real time",
                    400.0,
                    true,
                    what + std::string("; median of ") + std::to_string(runs),
                    true,
                    {{"p10", quantile(speed, 0.1), ""}, {"p90", quantile(speed, 0.9), ""}}};
  };
  return {row("headless with driveline", lever, "lever, hand, gate, guard, car"),
          row("headless lesson", lesson, "and learner and teacher, 1 kHz")};
}

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
      const std::vector<FaultKind>& catches = drive.lesson.catches;
      const bool reverse = drive.lesson.key == "reverse";
      if (kind == FaultKind::grind && !reverse) continue;  // no forward gear of a sound box grinds
      if (std::find(catches.begin(), catches.end(), kind) == catches.end()) continue;
      rows.push_back(fault_row(drive, kind, each));
      break;
    }
  }
  return rows;
}

std::vector<BenchRow> practice_rows(const LessonDriveConfig& drive, bool quick) {
  const int learners = quick ? 4 : 24, trials = quick ? 8 : 24;
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
  const int each = options.quick ? 6 : 40;
  std::vector<LessonDriveConfig> drives;
  for (const std::string_view key : kTeachingOrder) drives.push_back(shipped_drive(assets, key));
  const auto tell = [&](double share) {
    if (options.progress) options.progress("learning", share);
  };
  std::vector<BenchRow> rows = cost_rows(options, assets);
  for (const LessonDriveConfig& drive : drives) {
    tell(0.05 + 0.03 * static_cast<double>(rows.size()));
    rows.push_back(separation_row(drive, each));
  }
  const auto add = [&](std::vector<BenchRow> more) { rows.insert(rows.end(), more.begin(), more.end()); };
  add(fault_rows(drives, options.quick ? 4 : 20));
  tell(0.7);
  add(practice_rows(shipped_drive(assets, "skip_shifts"), options.quick));
  return rows;
}

}  // namespace gearshift
