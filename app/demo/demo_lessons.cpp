#include "app/demo/demo_lessons.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "app/assets_path.h"
#include "app/coach/shipped_lessons.h"
#include "app/report/report_page.h"
#include "app/training/grade.h"
#include "app/training/lesson_run.h"
#include "haptics/files/part_file.h"

namespace gearshift {
namespace {

constexpr std::array<std::string_view, 2> kLessons{"hill_start", "up_through_the_gears"};
constexpr std::array kErrors{0.9, 0.7, 0.5, 0.3, 0.15, 0.0};  // [1] of the learner (skill_of), trial after trial
// The drives are on a virtual clock: the same page on any day.
constexpr std::string_view kDay = "2000-01-01T10:{:02}:00Z";
constexpr const char* kLearner = "Simulated learner";

bool has_gears(const Lesson& lesson, const CarSpec& car, const Gate& gate) {
  try {
    const LessonRun run(lesson, car, gate, {});
    return true;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

DemoLesson drive_trials(const DemoSetup& setup, const CarSpec& car, const Lesson& lesson) {
  DemoLesson driven;
  driven.trace = lesson.key + ".trace";
  LessonDriveConfig config;
  config.lesson = lesson;
  config.car = car;
  config.gate = setup.tour.layout;
  config.mode = LessonMode::by_yourself;
  for (const double error : kErrors) {
    config.seed = setup.tour.seed + driven.trials.size();
    config.skill = skill_of(error);
    const bool is_last = driven.trials.size() + 1 == kErrors.size();
    if (is_last) config.trace = setup.tour.folder / driven.trace;
    driven.trials.push_back(is_last ? (driven.last = film_drive(config)).result : drive_lesson(config));
  }
  return driven;
}

}  // namespace

std::vector<DemoLesson> drive_demo_lessons(const DemoSetup& setup, const CarSpec& car, const TourProgress& progress) {
  std::vector<DemoLesson> lessons;
  for (const std::string_view key : kLessons) {
    const Lesson lesson = read_lesson(find_asset("lessons", std::string(key)));
    progress("lessons", static_cast<double>(lessons.size()) / kLessons.size());
    if (has_gears(lesson, car, setup.tour.gate)) lessons.push_back(drive_trials(setup, car, lesson));
  }
  return lessons;
}

std::vector<std::string> result_words(const FilmedDrive& drive) {
  const LessonResult& result = drive.result;
  std::vector<std::string> words{drive.lesson.goal};
  words.push_back(result.passed ? fmt::format("Passed with grade {:.1f} in {:.1f} s.", result.grade, result.duration)
                                : fmt::format("Not passed: {}", result.why));
  words.push_back(fmt::format("{} shift{}, {:.1f} kJ of heat in the clutch.", result.shifts.size(),
                              result.shifts.size() == 1 ? "" : "s", 1e-3 * result.slip_energy));
  for (const DriveFault& fault : result.faults) {
    if (points_of(fault.severity) > 0.0) words.push_back(fault_sentence(fault));
  }
  return words;
}

void write_demo_report(const DemoSetup& setup, const std::vector<DemoLesson>& lessons) {
  LearnerHistory history;
  history.learner.name = kLearner;
  for (const DemoLesson& lesson : lessons) {
    for (std::size_t i = 0; i < lesson.trials.size(); ++i) {
      RunRow row;
      row.id = static_cast<std::int64_t>(history.runs.size()) + 1;
      row.session = 1;
      row.begun_at = fmt::format(fmt::runtime(kDay), row.id);
      if (i + 1 == lesson.trials.size()) row.recording = lesson.trace;
      row.result = lesson.trials[i];
      history.runs.push_back({std::move(row), {}});
    }
  }
  history.learner.made_at = history.runs.front().row.begun_at;
  const ShownShifts shifts = show_shifts(history, setup.tour.folder);
  write_text_file(setup.tour.folder / "report.html", report_page(history, shifts, shipped_lessons()));
}

}  // namespace gearshift
