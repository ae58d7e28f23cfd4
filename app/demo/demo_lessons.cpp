#include "app/demo/demo_lessons.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "app/base/assets_path.h"
#include "app/lessons/assessment/grade.h"
#include "app/lessons/assessment/lesson_run.h"
#include "app/lessons/coach/shipped_lessons.h"
#include "app/lessons/report/report_page.h"
#include "haptics/files/atomic_file.h"

namespace gearshift::demo {
namespace {

constexpr std::array<std::string_view, 2> kLessons{"hill_start", "up_through_the_gears"};
constexpr std::array kErrors{0.9, 0.7, 0.5, 0.3, 0.15, 0.0};  // [1] skill error in each trial, see skill_of()
// Date and time of the lesson runs. They are fixed, so that the page is the same on any day.
constexpr std::string_view kDay = "2000-01-01T10:{:02}:00Z";
constexpr const char* kLearner = "Simulated driver";

bool has_gears(const lessons::Lesson& lesson, const vehicle::CarSpec& car, const haptics::Gate& gate) {
  try {
    const lessons::LessonRun run(lesson, car, gate, {});
    return true;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

DemoLesson drive_trials(const DemoSetup& setup, const vehicle::CarSpec& car, const lessons::Lesson& lesson) {
  DemoLesson driven;
  driven.trace = lesson.key + ".trace";
  lessons::LessonDriveConfig config;
  config.lesson = lesson;
  config.car = car;
  config.gate = setup.tour.layout;
  config.mode = lessons::LessonMode::by_yourself;
  for (const double error : kErrors) {
    config.seed = setup.tour.seed + driven.trials.size();
    config.skill = lessons::skill_of(error);
    const bool is_last = driven.trials.size() + 1 == kErrors.size();
    if (is_last) config.trace = setup.tour.folder / driven.trace;
    driven.trials.push_back(is_last ? (driven.last = film_drive(config)).result : lessons::drive_lesson(config));
  }
  return driven;
}

}  // namespace

std::vector<DemoLesson> drive_demo_lessons(const DemoSetup& setup, const vehicle::CarSpec& car,
                                           const lab::TourProgress& progress) {
  std::vector<DemoLesson> lessons;
  for (const std::string_view key : kLessons) {
    const lessons::Lesson lesson = lessons::read_lesson(base::find_asset("lessons", std::string(key)));
    progress("lessons", static_cast<double>(lessons.size()) / kLessons.size());
    if (has_gears(lesson, car, setup.tour.gate)) lessons.push_back(drive_trials(setup, car, lesson));
  }
  return lessons;
}

std::vector<std::string> describe_result(const FilmedDrive& drive) {
  const lessons::LessonResult& result = drive.result;
  std::vector<std::string> sentences{drive.lesson.goal};
  sentences.push_back(result.passed
                          ? fmt::format("Passed in {:.1f} s with a grade of {:.1f}.", result.duration, result.grade)
                          : fmt::format("Not passed: {}", result.why));
  sentences.push_back(fmt::format("{} shift{}, {:.1f} kJ of heat in the clutch.", result.shifts.size(),
                                  result.shifts.size() == 1 ? "" : "s", 1e-3 * result.slip_energy));
  for (const lessons::DrivingError& error : result.errors) {
    if (lessons::points_of(error.severity) > 0.0) sentences.push_back(lessons::error_sentence(error));
  }
  return sentences;
}

void write_demo_report(const DemoSetup& setup, const std::vector<DemoLesson>& lessons) {
  lessons::LearnerHistory history;
  history.learner.name = kLearner;
  for (const DemoLesson& lesson : lessons) {
    for (std::size_t i = 0; i < lesson.trials.size(); ++i) {
      lessons::RunRow row;
      row.id = static_cast<std::int64_t>(history.runs.size()) + 1;
      row.session = 1;
      row.begun_at = fmt::format(fmt::runtime(kDay), row.id);
      if (i + 1 == lesson.trials.size()) row.recording = lesson.trace;
      row.result = lesson.trials[i];
      history.runs.push_back(std::move(row));
    }
  }
  history.learner.made_at = history.runs.front().begun_at;
  const lessons::ShownShifts shifts = lessons::show_shifts(history, setup.tour.folder);
  haptics::write_text_file(setup.tour.folder / "report.html",
                           lessons::report_page(history, shifts, lessons::shipped_lessons()));
}

}  // namespace gearshift::demo
