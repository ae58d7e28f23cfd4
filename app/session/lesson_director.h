// The lessons of a session: offers, starts, judges and saves them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "app/lessons/coach/coach.h"
#include "app/session/drive_recorder.h"
#include "app/session/lever_in_force.h"
#include "app/session/session_choice.h"
#include "app/vehicle/drive_sample.h"

namespace gearshift::session {

class LessonDirector {
 public:
  // Offers the lesson named in the choice, or else the suggested lesson. With the automatic hand or without a car, only
  // a named lesson is offered. Throws FileError.
  explicit LessonDirector(const SessionChoice& choice);

  lessons::Coach& coach() { return coach_; }
  const lessons::Coach& coach() const { return coach_; }
  const lessons::CoachView& view() const { return coach_.view(); }
  bool is_driving() const { return view().phase == lessons::LessonPhase::driving; }
  LessonControls controls() const { return {slope_, coach_.guidance(), coach_.guided_gear(), coach_.pedal_help()}; }
  bool is_unpassable() const { return is_unpassable_ && is_driving(); }  // the trial can no longer be passed

  // `lesson`: a lesson's key or path. Throws FileError.
  void offer(const std::string& lesson);
  void dismiss();
  // Ends a running lesson early. Returns true if one was running.
  bool leave();
  // Selects the learner. Returns true if this ended a running lesson.
  bool set_learner(const std::string& name);

  // Call when a lever has been handed over. `lesson`: the lesson that it is for; null: free driving
  void set_road(const lessons::Lesson* lesson) { slope_ = lesson != nullptr ? lesson->start.slope : 0.0; }
  // Starts the trial on the lever in force. `recording`: absolute path, or empty
  void begin(LeverInForce& lever, const std::filesystem::path& recording);
  // Judges the cycles. Returns true if the trial ended in them.
  bool add(std::span<const vehicle::DriveSample> cycles);

  // Ends a running lesson early, saves all results and deletes unreferenced recordings. If results did not fit on the
  // disk, tries again after this deletion, and once more after deleting the lesson's incomplete recording. Returns what
  // could not be saved, as a sentence; empty if everything was saved.
  std::string save_all(DriveRecorder& recorder);

 private:
  void check_still_passable();

  lessons::Coach coach_;
  double slope_ = 0.0;           // [rad] slope of the lesson's road
  std::size_t error_count_ = 0;  // number of driving errors in the current trial
  bool is_unpassable_ = false;
};

}  // namespace gearshift::session
