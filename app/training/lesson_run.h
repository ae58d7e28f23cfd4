// A lesson while it is driven: follows the samples, prompts, judges, ends.
//
// Depends on nothing but the samples: the same drive gives the same result, live or replayed.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "app/training/drive_sample.h"
#include "app/training/hint_style.h"
#include "app/training/lesson.h"
#include "app/training/lesson_result.h"
#include "app/vehicle/car_spec.h"
#include "haptics/gate/gate.h"

namespace gearshift {

struct LessonRunConfig {
  LessonMode mode = LessonMode::follow_me;
  double guidance = 0.0;  // [1] gain of the guidance force, 0: an unguided trial
  HintStyle hints = HintStyle::prescriptive;
};

// What the coach shows now.
struct LessonView {
  std::string prompt;  // this step's, or the goal
  std::string hint;    // empty, or what helps
  std::size_t step = 0, steps = 0;
  int guided_gear = kNeutralGear;
  std::vector<std::string> said;  // feedback so far, newest last: "The clutch came up 0.12 s before the gear was in."
};

class LessonRun {
 public:
  // Gate and car are copied. Throws std::invalid_argument where the lesson asks for a gear that the gate lacks.
  LessonRun(const Lesson& lesson, const CarSpec& car, const Gate& gate, const LessonRunConfig& config);
  ~LessonRun();

  void add(const DriveSample& sample);  // every cycle, in order
  void mark_torn();                     // samples were lost: no grade
  void mark_forceless();                // the lever had no forces: no grade
  void leave();                         // the learner gives up

  const LessonView& view() const noexcept;
  bool is_over() const noexcept;
  bool is_in_shift() const noexcept;
  // So far, or whole once it is over.
  const LessonResult& result() const noexcept;
  // Shifts that have ended since the last call, for the history.
  std::vector<ShiftRecord> take_shifts();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gearshift
