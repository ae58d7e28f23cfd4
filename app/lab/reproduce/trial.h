// One recorded run of the shipped cycle with a lever, a hand and a gate. Records the true motion of the handle, not the
// encoder's.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>

#include "app/lab/reproduce/section.h"
#include "haptics/loop/simulated_run.h"

namespace gearshift::lab {

// The hand's target as a function of the time since the start [s] and the lever's position [m].
using HandFunction = std::function<haptics::HandTarget(double time, glm::dvec2 lever)>;

struct Trial {
  haptics::HapticConfig haptics;
  haptics::SimulatedLeverConfig lever;
  haptics::Gate gate;
  glm::dvec2 start{0.0};     // [m] the lever is held here until the motors are at full force
  glm::dvec2 velocity{0.0};  // [m/s] at the start
  HandFunction hand;
  haptics::LeverLoad* load = nullptr;
  double duration = 1.0;  // [s]
};

struct TrialSample {
  double time = 0.0;          // [s]
  glm::dvec2 position{0.0};   // [m] true
  glm::dvec2 velocity{0.0};   // [m/s] true
  glm::dvec2 proxy{0.0};      // [m] drawn lever
  glm::dvec2 motor{0.0};      // [N] on the lever, over the period that ends at `time`
  glm::dvec2 hand{0.0};       // [N] as read by the force sensor
  glm::dvec2 wall{0.0};       // [N] wall force computed at `time`
  glm::dvec2 commanded{0.0};  // [N] total command computed at `time`
  std::uint32_t flags = 0;    // kFlag...: each flag is first set in the cycle of its event
};

struct TrialRun {
  double period = 0.0;  // [s]
  haptics::AdmittedTuning admitted;
  double stiffness = 0.0;  // [N/m] wall stiffness in use at the end
  std::vector<TrialSample> samples;
};

TrialRun run_trial(const Trial& trial);

// Moves the lever along x at a steady speed until it is at the wall; from then on the hand's target is `after`.
HandFunction carried_to(double wall, double speed, const haptics::AxisModel& axis, haptics::HandTarget after);
// Start position for carried_to(). phase: fraction of a period (0 to 1) after a sample at which the lever meets the
// wall.
glm::dvec2 before(double wall, double speed, double period, double phase = 0.5);

// A gate whose free space is x < 0, so that x is the penetration of its wall.
haptics::Gate wall_at_zero();

// One contact with a wall: x beyond an end of the gate's aisle.
struct TrialContact {
  double begin = 0.0, end = 0.0;  // [s] `end` is the end of the run if the lever stays in the wall
  double speed = 0.0;             // [m/s] at the impact
  double energy = 0.0;            // [J] supplied to the lever by the motors
  bool left = false;              // the lever left the wall again
};
std::vector<TrialContact> contacts(const TrialRun& run, const haptics::Gate& gate);

// Spectral radius that the library predicts for the wall and hand of the trial, along x; above 1 it is unstable. [1]
double predicted_radius(const Trial& trial, const haptics::AdmittedTuning& admitted);

double deepest(const TrialRun& run);                       // [m] largest x
double peak_to_peak(const TrialRun& run, double seconds);  // [m] motion along x in the last `seconds`

// A CSV table whose columns may have different lengths, for runs at different rates.
class TrialTable {
 public:
  void add(std::string name, std::vector<double> cells);
  // Adds a column that contains `value` of each sample of a run.
  template <class Value>
  void add(std::string name, const TrialRun& run, Value value) {
    std::vector<double> cells;
    cells.reserve(run.samples.size());
    for (const TrialSample& sample : run.samples) cells.push_back(value(sample));
    add(std::move(name), std::move(cells));
  }
  void write(const Study& study, std::string_view name) const;  // NAME.csv

 private:
  std::vector<std::string> names_;
  std::vector<std::vector<double>> columns_;
};

}  // namespace gearshift::lab
