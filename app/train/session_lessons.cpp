// A session's lessons: what is offered, begun, driven and remembered, and who has the car meanwhile.
#include <algorithm>
#include <system_error>
#include <utility>

#include <fmt/core.h>

#include "app/assets_path.h"
#include "app/history/typed_text.h"
#include "app/train/recording_file.h"
#include "app/train/session.h"
#include "app/training/grade.h"
#include "haptics/files/place_of.h"

namespace gearshift {
namespace {

namespace fs = std::filesystem;

// What the history keeps beside a lesson.
std::string settings_text(const SessionChoice& choice, const HapticTuning& tuning) {
  return fmt::format(
      "car = \"{}\"\ngate = \"{}\"\npreset = \"{}\"\nhand = \"{}\"\nwall_stiffness_n_per_m = "
      "{}\nwall_damping_n_s_per_m = {}\n",
      choice.car, choice.gate, choice.preset, choice.hand, tuning.wall_stiffness, tuning.wall_damping);
}

}  // namespace

// The first that is named, else the one that is suggested; a hand that needs nobody drives what is named alone.
void Session::offer_first(const SessionChoice& choice) {
  std::string name = choice.lesson;
  const bool suggested = name.empty();
  if (suggested && choice.hand != kByItself && choice.car != kNoCar) name = coach_.view().next;
  if (name.empty() || name == kNoLesson) return;
  offer(read_lesson(find_asset("lessons", name)));
  coach_.want_help(choice.help);
  if (choice.mode) coach_.set_mode(*choice.mode);
}

void Session::obey_instructor(const LessonRequests& requests) {
  if (requests.learner) change_learner(*requests.learner);
  if (requests.next) coach_.set_next(*requests.next);
  if (requests.comment_change) change_comment(*requests.comment_change);
  if (requests.comment) coach_.comment(requests.comment->run, requests.comment->author, requests.comment->text);
  if (requests.offer) offer(read_lesson(find_asset("lessons", *requests.offer)));
  if (requests.mode) coach_.set_mode(*requests.mode);
  if (requests.help) coach_.want_help(*requests.help);
  if (requests.leave) leave_lesson();
  if (requests.put_away) {
    coach_.put_away();
    slope_ = 0.0;
    held_ = false;
  }
  if (requests.begin && coach_.lesson()) begin_lesson();
  if (coach_.view().phase != LessonPhase::driving) end_lesson_recording();
}

// A name that is refused is nobody's.
void Session::change_learner(const std::string& name) {
  if (!name.empty()) check_learner_name(name);
  const bool drives = coach_.view().phase == LessonPhase::driving;
  choice_.learner = name;
  coach_.set_learner(learner_of(choice_));
  message_.clear();
  if (choice_.hand == kByItself) message_ = "the hand drives by itself: nothing is remembered of it";
  if (!drives || coach_.view().phase == LessonPhase::driving) return;
  hold();
  tell_left("another learner");
}

void Session::leave_lesson() {
  const bool drives = coach_.view().phase == LessonPhase::driving;
  coach_.leave();
  if (drives) hold();
}

// Before other news: what the recording came to, or a limit.
void Session::tell_left(std::string_view what) {
  message_ = fmt::format("the lesson was left: {}{}{}", what, message_.empty() ? "" : "; ", message_);
}

void Session::change_comment(const LessonRequests::CommentChange& change) {
  if (change.text)
    coach_.edit_comment(change.run, change.comment, *change.text);
  else
    coach_.delete_comment(change.run, change.comment);
}

// What lay before the trial's first cycle is not the coach's.
void Session::begin_lesson() {
  const Lesson lesson = *coach_.lesson();
  if (coach_.view().phase == LessonPhase::over) offer(lesson);
  SessionChoice wanted = with_lesson(choice_, lesson);
  if (trainer_) wanted.haptics = trainer_->config().preset.haptics;
  change_to(wanted, &lesson);
  const CoachView& view = coach_.view();
  fs::path recording;
  if (view.remembers && !view.learner.empty()) recording = record_lesson(lesson);
  (void)trainer_->take_cycles();
  faults_ = 0;
  is_lost_ = false;
  coach_.begin(*trainer_->config().car, trainer_->gate(),
               settings_text(running_, trainer_->config().preset.haptics.tuning), recording);
  trainer_->set_controls(led());
}

// What the last one left is as it is.
void Session::offer(const Lesson& lesson) {
  coach_.offer(lesson);
  is_torn_ = false;
}

// A lesson can be driven without.
fs::path Session::record_lesson(const Lesson& lesson) {
  const std::string news = message_;
  try {
    start_recording(drive_name(lesson.key));
    records_lesson_ = true;
    lesson_recordings_.insert(absolute_place(last_recording_).string());
    message_ = news;  // nobody asked for it
    return absolute_place(last_recording_);
  } catch (const std::exception& refused) {
    message_ = refused.what();
    return {};
  }
}

void Session::follow_lesson(std::span<const DriveSample> cycles) {
  const bool driving = coach_.view().phase == LessonPhase::driving;
  coach_.add(cycles);
  look_whether_lost();
  if (driving && coach_.view().phase == LessonPhase::over) {
    hold();
    end_lesson_recording();
  }
  if (const std::optional<std::string> problem = coach_.take_problem()) message_ = *problem;
}

// If it were done as it is: points are only taken off.
void Session::look_whether_lost() {
  const CoachView& view = coach_.view();
  const bool judged = view.phase == LessonPhase::driving && !view.result.guided && view.result.whole;
  if (!judged) is_lost_ = false;
  if (!judged || std::exchange(faults_, view.result.faults.size()) == view.result.faults.size()) return;
  LessonResult done = view.result;
  done.end = LessonEnd::done;
  grade_result(*coach_.lesson(), done);
  is_lost_ = !done.passed;
}

// By the teacher, until the next one.
void Session::hold() {
  held_ = true;
  feet_->ask({});
}

// Rows before recordings: where a run lacks room, what no history names leaves its own to it, and then the lesson's that
// was torn.
std::string Session::settle() {
  std::string not_kept = coach_.settle();
  end_lesson_recording();
  if (remove_unnamed() && coach_.needs_room()) not_kept = coach_.settle();
  if (!is_torn_ || !coach_.needs_room()) return not_kept;
  coach_.forget_recording();
  std::error_code ignored;
  fs::remove(last_recording_, ignored);
  not_kept = coach_.settle();
  remove_unnamed();
  return not_kept;
}

// A recording that no history names is nobody's. True: there was one.
bool Session::remove_unnamed() {
  bool any = false;
  std::error_code ignored;
  for (const std::string& file : coach_.forget_recordings())
    any = (lesson_recordings_.contains(file) && fs::remove(file, ignored)) || any;
  return any;
}

// The person's, on the lesson's road, with the teacher's hand; after it with the teacher's feet, to a stand.
DriverControls Session::led() const {
  DriverControls controls = controls_;
  if (held_) {
    controls.throttle = 0.0;
    controls.clutch = 1.0;
    controls.brake = std::max(controls.brake, 0.5);
  }
  controls.slope = slope_;
  controls.guidance = coach_.guidance();
  controls.guided_gear = coach_.guided_gear();
  return controls;
}

}  // namespace gearshift
