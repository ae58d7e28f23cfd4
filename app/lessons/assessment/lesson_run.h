// One run of a lesson: processes the samples, shows prompts, judges the driving, and ends the lesson.
//
// The result depends only on the samples: the same drive gives the same result, live or replayed.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "app/lessons/assessment/hint_style.h"
#include "app/lessons/assessment/lesson.h"
#include "app/lessons/assessment/lesson_result.h"
#include "app/vehicle/car_spec.h"
#include "app/vehicle/drive_sample.h"
#include "haptics/gate/gate.h"

namespace gearshift::lessons {

struct LessonRunConfig {
  LessonMode mode = LessonMode::follow_me;
  double guidance = 0.0;  // [1] gain of the guidance force; 0: unguided
  HintStyle hints = HintStyle::prescriptive;
  double pedal_help = 0.0;  // [1] help with the pedals; 0: none
};

// The prompts and feedback that the coach shows now.
struct LessonView {
  std::string prompt;  // prompt of the current step, or the goal
  std::string hint;    // may be empty
  std::size_t step = 0, steps = 0;
  int guided_gear = haptics::kNeutralGear;
  // Feedback sentences so far, newest last, for example "The clutch came up 0.12 s before the gear was in."
  std::vector<std::string> feedback;
};

class LessonRun {
 public:
  // Gate and car are copied. Throws std::invalid_argument if the lesson needs a gear that the gate
  // lacks, or an engine speed beyond the car's red line.
  LessonRun(const Lesson& lesson, const vehicle::CarSpec& car, const haptics::Gate& gate,
            const LessonRunConfig& config);
  ~LessonRun();

  void add(const vehicle::DriveSample& sample);  // call every cycle, in order
  void mark_incomplete();                        // call if samples were lost: the run gets no grade
  void mark_forceless();                         // call if the lever had no forces: the run gets no grade
  void judge_by_errors();                        // call if keys move the pedals: they cannot reach the norm
  void leave();                                  // call when the learner leaves the lesson

  const LessonView& view() const noexcept;
  bool is_over() const noexcept;
  bool is_in_shift() const noexcept;
  // The result so far. It is final once is_over() is true.
  const LessonResult& result() const noexcept;
  // The norm by which the run is judged; null if the lesson has none for this car, gate and mode.
  const Norm* norm() const noexcept;
  // Returns the shifts that ended since the last call.
  std::vector<ShiftRecord> drain_shifts();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gearshift::lessons
