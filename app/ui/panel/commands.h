// Commands of the user in the panel: one type per command, in the order in which the user asked. The session executes
// them (app/session/session_commands.cpp), except for those to the view, to the headset and to the controllers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "app/cabin/headset/seat.h"
#include "app/lessons/assessment/lesson_result.h"
#include "app/ui/input/controls_setup.h"
#include "haptics/loop/haptic_config.h"

namespace gearshift::ui {

// Forces, recording and view.
struct Stop {};  // takes effect before the other commands
struct Arm {};
struct Disarm {};
struct ToggleRecording {};
struct ReplayLastRecording {};
struct ResetView {};

// Lever and car.
struct ChangeTuning {
  haptics::HapticTuning tuning;  // already checked to be admissible
};
struct Restart {                 // of the loop
  haptics::HapticConfig config;  // its values are in range
};
struct ChooseGate {
  std::string name;
};
struct ChooseCar {  // and its gate
  std::string name;
};
struct ChoosePreset {
  std::string name;
};
struct ChooseHand {
  std::string name;
};
struct SavePreset {
  std::string name;
};
struct ComparePreset {  // reads the preset into PanelInput::compared
  std::string name;
};

// Lessons. A run is a RunRow::id, a comment a CommentRow::id.
struct OfferLesson {
  std::string key;
};
struct BeginLesson {};  // starts the offered lesson, or repeats the finished one
struct LeaveLesson {};
struct DismissLesson {};
struct SetMode {
  lessons::LessonMode mode;
};
struct SetHelp {
  bool on;
};
struct ChooseLearner {
  std::string name;  // of a known or new learner; empty: no learner
};
struct RenameLearner {
  std::string name;  // of no other learner
};
struct ChooseNextLesson {
  std::string key;  // empty: as suggested
};
struct AddComment {
  std::int64_t run;
  std::string author, text;
};
struct EditComment {
  std::int64_t run, comment;
  std::string text;
};
struct DeleteComment {
  std::int64_t run, comment;
};

// Replay of a recorded drive.
struct OpenShift {  // replays this shift from the history
  std::string recording;
  double begin;  // [s] start of the shift on the loop's clock
};
struct ShowShift {
  std::size_t index;
};
struct ShowWholeDrive {};
struct SeekReplay {
  double time;  // [s]
};
struct PlayReplay {
  bool on;  // false: pause
};
struct SetPace {
  double pace;
};
struct CloseReplay {};  // returns to the live lever

// Headset.
struct RecentreSeat {};
struct StartTouching {};
struct SaveTouches {};
struct ForgetTouches {};  // cancels a running touch calibration, or else discards the saved one
struct SetSeatHeight {
  double height;  // [m] new SeatSettings::height
};
struct SetKnob {
  cabin::KnobDistance knob;  // [m] new SeatSettings::knob
};
struct ForgetKnob {};
using HeadsetCommand =
    std::variant<RecentreSeat, StartTouching, SaveTouches, ForgetTouches, SetSeatHeight, SetKnob, ForgetKnob>;

// Setting up controllers without force feedback.
struct StartControls {};
struct DeclineControls {};  // of the offered controllers
struct AnswerControls {
  ControlsSetup::Answer answer;
};
struct SaveControls {};
struct CancelControls {};
using ControlsCommand = std::variant<StartControls, DeclineControls, AnswerControls, SaveControls, CancelControls>;

// Driving by the mouse alone.
struct MovePedal {
  double haptics::Pedals::*pedal;
  double to;  // [1] 0 to 1
};
struct ShiftTo {
  int gear;
};
struct HoldStarter {  // while the button is held, and once when it is released
  bool on;
};
struct Press {  // hand_brake or ignition
  Action control;
};
using DriveCommand = std::variant<MovePedal, ShiftTo, HoldStarter, Press>;

using PanelCommand =
    std::variant<Stop, Arm, Disarm, ToggleRecording, ReplayLastRecording, ResetView, ChangeTuning, Restart, ChooseGate,
                 ChooseCar, ChoosePreset, ChooseHand, SavePreset, ComparePreset, OfferLesson, BeginLesson, LeaveLesson,
                 DismissLesson, SetMode, SetHelp, ChooseLearner, RenameLearner, ChooseNextLesson, AddComment,
                 EditComment, DeleteComment, OpenShift, ShowShift, ShowWholeDrive, SeekReplay, PlayReplay, SetPace,
                 CloseReplay, HeadsetCommand, ControlsCommand, DriveCommand>;
using PanelCommands = std::vector<PanelCommand>;

}  // namespace gearshift::ui
