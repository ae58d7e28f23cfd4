#include "app/session/lesson_director.h"

#include <utility>

#include <fmt/core.h>

#include "app/base/assets_path.h"
#include "app/base/program_name.h"
#include "app/lessons/assessment/grade.h"
#include "app/lessons/coach/shipped_lessons.h"

namespace gearshift::session {
namespace {

lessons::CoachConfig coach_config(const SessionChoice& choice) {
  lessons::CoachConfig config;
  config.lessons = lessons::shipped_lessons();
  config.history = choice.history;
  config.no_history = choice.no_history;
  config.learner = learner_of(choice);
  config.program = base::program_name();
  return config;
}

}  // namespace

LessonDirector::LessonDirector(const SessionChoice& choice) : coach_(coach_config(choice)) {
  std::string name = choice.lesson;
  const bool suggested = name.empty();
  if (suggested && choice.hand != kAutomaticHand && choice.car != kNoCar) name = view().next;
  if (name.empty() || name == kNoLesson) return;
  offer(name);
  coach_.set_help(choice.help);
  if (choice.mode) coach_.set_mode(*choice.mode);
}

void LessonDirector::offer(const std::string& lesson) {
  coach_.offer(lessons::read_lesson(base::find_asset("lessons", lesson)));
}

void LessonDirector::dismiss() {
  coach_.dismiss_lesson();
  slope_ = 0.0;
}

bool LessonDirector::leave() {
  const bool was_driving = is_driving();
  coach_.leave();
  return was_driving;
}

bool LessonDirector::set_learner(const std::string& name) {
  const bool was_driving = is_driving();
  coach_.set_learner(name);
  return was_driving && !is_driving();
}

// Discards the cycles before the trial.
void LessonDirector::begin(LeverInForce& lever, const std::filesystem::path& recording) {
  (void)lever.runtime().read_frame();
  error_count_ = 0;
  is_unpassable_ = false;
  const runtime::RuntimeConfig& config = lever.runtime().config();
  coach_.begin(*config.car, lever.runtime().gate(), recording);
}

bool LessonDirector::add(std::span<const vehicle::DriveSample> cycles) {
  const bool was_driving = is_driving();
  coach_.add(cycles);
  check_still_passable();
  return was_driving && view().phase == lessons::LessonPhase::over;
}

// Grades the trial as if it ended now. Points are only ever deducted, so a trial that fails now can no longer be
// passed.
void LessonDirector::check_still_passable() {
  const bool is_judged = is_driving() && !view().result->guided && view().result->is_complete;
  if (!is_judged) is_unpassable_ = false;
  const std::size_t errors = view().result->errors.size();
  if (!is_judged || std::exchange(error_count_, errors) == errors) return;
  lessons::LessonResult done = *view().result;
  done.end = lessons::LessonEnd::done;
  lessons::grade_result(*coach_.lesson(), done);
  is_unpassable_ = !done.passed;
}

std::string LessonDirector::save_all(DriveRecorder& recorder) {
  std::string unsaved = coach_.flush();
  const auto delete_unreferenced = [&] { return recorder.delete_lessons(coach_.take_unreferenced_recordings()); };
  if (delete_unreferenced() && coach_.needs_room()) unsaved = coach_.flush();
  if (!recorder.is_lesson_incomplete() || !coach_.needs_room()) return unsaved;
  coach_.clear_recording();
  recorder.delete_last();
  unsaved = coach_.flush();
  delete_unreferenced();
  return unsaved;
}

}  // namespace gearshift::session
