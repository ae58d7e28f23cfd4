// A recorded run of the trainer's haptic cycle with a lever, a hand and a gate. Records the true motion of the handle,
// not the encoder readings.
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

// Returns the hand's target. `time`: time since the start [s]. `lever`: position of the lever [m].
using HandFunction = std::function<haptics::HandTarget(double time, glm::dvec2 lever)>;

struct Trial {
  haptics::HapticConfig haptics;
  haptics::SimulatedLeverConfig lever;
  haptics::Gate gate;
  glm::dvec2 start{0.0};     // [m] the lever is held here until the motors are at full force
  glm::dvec2 velocity{0.0};  // [m/s] velocity at the start
  HandFunction hand;
  haptics::LeverLoad* load = nullptr;
  double duration = 1.0;  // [s]
};

struct TrialSample {
  double time = 0.0;          // [s]
  glm::dvec2 position{0.0};   // [m] true position
  glm::dvec2 velocity{0.0};   // [m/s] true velocity
  glm::dvec2 proxy{0.0};      // [m] displayed lever
  glm::dvec2 motor{0.0};      // [N] motor force on the lever during the period that ends at `time`
  glm::dvec2 hand{0.0};       // [N] force measured by the force sensor
  glm::dvec2 wall{0.0};       // [N] wall force computed at `time`
  glm::dvec2 commanded{0.0};  // [N] total force command computed at `time`
  std::uint32_t flags = 0;    // kFlag... constants at `time`
};

struct TrialRun {
  double period = 0.0;  // [s]
  int delay = 0;        // [periods] from a command to its effect
  haptics::AdmittedTuning admitted;
  double stiffness = 0.0;  // [N/m] wall stiffness at the end
  std::vector<TrialSample> samples;
};

TrialRun run_trial(const Trial& trial);

// Returns a hand that moves the lever along x at a steady speed up to the wall. From then on the hand's target is
// `after`.
HandFunction carried_to(double wall, double speed, const haptics::AxisModel& axis, haptics::HandTarget after);
// Start position for carried_to(). `phase`: time between a sample and the contact, as a fraction of the period (0 to
// 1).
glm::dvec2 before(double wall, double speed, double period, double phase = 0.5);

// A gate whose free space is x < 0, so that a positive x is the penetration of the wall.
haptics::Gate wall_at_zero();

// One contact of the lever with a wall that ends the gate's aisle in the x direction.
struct TrialContact {
  double begin = 0.0, end = 0.0;  // [s] times; if the lever stays in the wall, `end` is the end of the run
  double speed = 0.0;             // [m/s] speed at the impact
  double energy = 0.0;            // [J] energy that the motors supply to the lever, with forces that are late
  bool left = false;              // true if the lever left the wall
};
std::vector<TrialContact> contacts(const TrialRun& run, const haptics::Gate& gate);

// Predicted spectral radius for the trial's wall and hand along x; above 1 the contact is unstable. [1]
double predicted_radius(const Trial& trial, const haptics::AdmittedTuning& admitted);

double deepest(const TrialRun& run);                       // [m] largest x
double peak_to_peak(const TrialRun& run, double seconds);  // [m] range of x in the last `seconds`

// A CSV table whose columns may have different lengths, for runs at different rates.
class TrialTable {
 public:
  void add(std::string name, std::vector<double> cells);
  // Adds a column with value(sample) for each sample of the run.
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
