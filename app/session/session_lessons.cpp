// Offers, starts, runs and saves the session's lessons, and decides whether the learner or the instructor controls the
// car.
#include <algorithm>
#include <system_error>
#include <utility>

#include <fmt/core.h>

#include "app/base/assets_path.h"
#include "app/lessons/assessment/grade.h"
#include "app/lessons/history/user_text.h"
#include "app/session/recording_file.h"
#include "app/session/session.h"
#include "haptics/files/resolve_path.h"

namespace gearshift::session {
namespace {

namespace fs = std::filesystem;

// The settings in use, as text that the history saves with a lesson run.
std::string settings_text(const SessionChoice& choice, const haptics::HapticTuning& tuning) {
  return fmt::format(
      "car = \"{}\"\ngate = \"{}\"\npreset = \"{}\"\nhand = \"{}\"\nwall_stiffness_n_per_m = "
      "{}\nwall_damping_n_s_per_m = {}\n",
      choice.car, choice.gate, choice.preset, choice.hand, tuning.wall_stiffness, tuning.wall_damping);
}

}  // namespace

// Offers the lesson named in the choice, or else the suggested lesson. With the automatic hand or without a car, only a
// named lesson is offered.
void Session::offer_initial(const SessionChoice& choice) {
  std::string name = choice.lesson;
  const bool suggested = name.empty();
  if (suggested && choice.hand != kAutomaticHand && choice.car != kNoCar) name = coach_.view().next;
  if (name.empty() || name == kNoLesson) return;
  offer(lessons::read_lesson(base::find_asset("lessons", name)));
  coach_.set_help(choice.help);
  if (choice.mode) coach_.set_mode(*choice.mode);
}

void Session::apply_lesson_requests(const ui::LessonRequests& requests) {
  if (requests.learner) change_learner(*requests.learner);
  if (requests.next) coach_.set_next(*requests.next);
  if (requests.comment_change) change_comment(*requests.comment_change);
  if (requests.comment) coach_.add_comment(requests.comment->run, requests.comment->author, requests.comment->text);
  if (requests.offer) offer(lessons::read_lesson(base::find_asset("lessons", *requests.offer)));
  if (requests.mode) coach_.set_mode(*requests.mode);
  if (requests.help) coach_.set_help(*requests.help);
  if (requests.leave) leave_lesson();
  if (requests.dismiss_lesson) {
    coach_.dismiss_lesson();
    slope_ = 0.0;
    is_car_held_ = false;
  }
  if (requests.begin && coach_.lesson()) begin_lesson();
  if (coach_.view().phase != lessons::LessonPhase::driving) end_lesson_recording();
}

// Selects the learner. If the name is invalid, throws before anything changes.
void Session::change_learner(const std::string& name) {
  if (!name.empty()) lessons::check_learner_name(name);
  const bool drives = coach_.view().phase == lessons::LessonPhase::driving;
  choice_.learner = name;
  coach_.set_learner(learner_of(choice_));
  message_.clear();
  if (choice_.hand == kAutomaticHand) message_ = "the simulated driver is driving, so nothing is saved";
  if (!drives || coach_.view().phase == lessons::LessonPhase::driving) return;
  hold_car();
  report_early_end("the learner changed");
}

void Session::leave_lesson() {
  const bool drives = coach_.view().phase == lessons::LessonPhase::driving;
  coach_.leave();
  if (drives) hold_car();
}

// Puts the report about the lesson's end in front of the current message, which may be about a recording or a limit.
void Session::report_early_end(std::string_view reason) {
  message_ = fmt::format("the lesson ended early because {}{}{}", reason, message_.empty() ? "" : "; ", message_);
}

void Session::change_comment(const ui::LessonRequests::CommentChange& change) {
  if (change.text)
    coach_.edit_comment(change.run, change.comment, *change.text);
  else
    coach_.delete_comment(change.run, change.comment);
}

// Switches to the lesson's setup, discards the cycles before the trial, then starts the coach.
void Session::begin_lesson() {
  const lessons::Lesson lesson = *coach_.lesson();
  if (coach_.view().phase == lessons::LessonPhase::over) offer(lesson);
  SessionChoice wanted = with_lesson(choice_, lesson);
  if (runtime_) wanted.haptics = runtime_->config().preset.haptics;
  switch_to(wanted, &lesson);
  const lessons::CoachView& view = coach_.view();
  fs::path recording;
  if (view.is_saving && !view.learner.empty()) recording = record_lesson(lesson);
  (void)runtime_->drain_cycles();
  error_count_ = 0;
  is_unpassable_ = false;
  coach_.begin(*runtime_->config().car, runtime_->gate(),
               settings_text(running_, runtime_->config().preset.haptics.tuning), recording);
  runtime_->set_controls(effective_controls());
}

// Offers the lesson. From now on, save_and_stop() no longer deletes the previous lesson's recording because it is
// incomplete.
void Session::offer(const lessons::Lesson& lesson) {
  coach_.offer(lesson);
  is_recording_incomplete_ = false;
}

// Starts to record the lesson. If this fails, the lesson is driven without a recording.
fs::path Session::record_lesson(const lessons::Lesson& lesson) {
  const std::string news = message_;
  try {
    start_recording(recording_name(lesson.key));
    is_lesson_recording_ = true;
    lesson_recordings_.insert(haptics::make_absolute(last_recording_).string());
    message_ = news;  // a recording that starts automatically needs no message
    return haptics::make_absolute(last_recording_);
  } catch (const std::exception& refused) {
    message_ = refused.what();
    return {};
  }
}

void Session::update_lesson(std::span<const vehicle::DriveSample> cycles) {
  const bool driving = coach_.view().phase == lessons::LessonPhase::driving;
  coach_.add(cycles);
  check_still_passable();
  if (driving && coach_.view().phase == lessons::LessonPhase::over) {
    hold_car();
    end_lesson_recording();
  }
  if (const std::optional<std::string> problem = coach_.take_problem()) message_ = *problem;
}

// Grades the trial as if it ended now. Points are only ever deducted, so a trial that fails now can no longer be
// passed.
void Session::check_still_passable() {
  const lessons::CoachView& view = coach_.view();
  const bool is_judged =
      view.phase == lessons::LessonPhase::driving && !view.result->guided && view.result->is_complete;
  if (!is_judged) is_unpassable_ = false;
  if (!is_judged || std::exchange(error_count_, view.result->errors.size()) == view.result->errors.size()) return;
  lessons::LessonResult done = *view.result;
  done.end = lessons::LessonEnd::done;
  lessons::grade_result(*coach_.lesson(), done);
  is_unpassable_ = !done.passed;
}

// Lets the instructor hold clutch and brake, see is_car_held_.
void Session::hold_car() {
  is_car_held_ = true;
  pedals_.keys = {};
  runtime_->set_pedal_keys(pedals_);
}

// Saves results, then deletes unreferenced recordings. If results did not fit on the disk, tries again after this
// deletion, and once more after deleting the lesson's incomplete recording.
std::string Session::save_and_stop() {
  std::string unsaved = coach_.flush();
  end_lesson_recording();
  if (delete_unreferenced_recordings() && coach_.needs_room()) unsaved = coach_.flush();
  if (!is_recording_incomplete_ || !coach_.needs_room()) return unsaved;
  coach_.clear_recording();
  std::error_code ignored;
  fs::remove(last_recording_, ignored);
  unsaved = coach_.flush();
  delete_unreferenced_recordings();
  return unsaved;
}

// Deletes this session's lesson recordings that no history row references. Returns true if any file was deleted.
bool Session::delete_unreferenced_recordings() {
  bool any = false;
  std::error_code ignored;
  for (const std::string& file : coach_.take_unreferenced_recordings())
    any = (lesson_recordings_.contains(file) && fs::remove(file, ignored)) || any;
  return any;
}

// Returns the user's controls with the lesson's slope and guidance. After a lesson the instructor brakes the car to a
// stop.
haptics::DriverControls Session::effective_controls() const {
  haptics::DriverControls controls = controls_;
  if (is_car_held_) {
    controls.pedals.throttle = 0.0;
    controls.pedals.clutch = 1.0;
    controls.pedals.brake = std::max(controls.pedals.brake, 0.5);
  }
  controls.slope = slope_;
  controls.guidance = coach_.guidance();
  controls.guided_gear = coach_.guided_gear();
  return controls;
}

}  // namespace gearshift::session
