// One recorded run of the shipped cycle: a lever, a hand, a gate, and the motion that came of it. What is recorded is
// the true handle, not what the encoder says of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>

#include "app/reproduce/section.h"
#include "haptics/loop/simulated_run.h"

namespace gearshift {

// Where the hand wants to be, by the time since the beginning [s] and the lever's place [m].
using HandFunction = std::function<HandTarget(double time, glm::dvec2 lever)>;

struct Trial {
  HapticConfig haptics;
  SimulatedLeverConfig lever;
  Gate gate;
  glm::dvec2 start{0.0};     // [m] held there until the motors are at full force
  glm::dvec2 velocity{0.0};  // [m/s] at the beginning
  HandFunction hand;
  LeverWorld* world = nullptr;
  double duration = 1.0;  // [s]
};

struct TrialSample {
  double time = 0.0;          // [s]
  glm::dvec2 position{0.0};   // [m] true
  glm::dvec2 velocity{0.0};   // [m/s] true
  glm::dvec2 proxy{0.0};      // [m] drawn lever
  glm::dvec2 motor{0.0};      // [N] on the lever, over the period that ends here
  glm::dvec2 hand{0.0};       // [N] as the force sensor reads it
  glm::dvec2 wall{0.0};       // [N] wanted of the wall from here on
  glm::dvec2 commanded{0.0};  // [N] from here on
  std::uint32_t flags = 0;    // kFlag...: each begins in the cycle of its event
};

struct TrialRun {
  double period = 0.0;  // [s]
  AdmittedTuning admitted;
  double stiffness = 0.0;  // [N/m] in use at the end
  std::vector<TrialSample> samples;
};

TrialRun run_trial(const Trial& trial);

// Carries the lever along x at a steady speed until it is at the wall; from then on the hand is what `after` says.
HandFunction carried_to(double wall, double speed, const AxisModel& axis, HandTarget after);
// Where such a trial starts. phase: of a period, where between two samples the lever meets the wall, 0 to 1.
glm::dvec2 before(double wall, double speed, double period, double phase = 0.5);

// Free space left of x = 0: a wall whose penetration is x.
Gate wall_at_zero();

// One stay in a wall: x beyond an end of the gate's aisle.
struct TrialContact {
  double begin = 0.0, end = 0.0;  // [s]; end of the run where it stays
  double speed = 0.0;             // [m/s] on meeting it
  double energy = 0.0;            // [J] that the motors gave the lever
  bool left = false;
};
std::vector<TrialContact> contacts(const TrialRun& run, const Gate& gate);

// What the library says of the wall in that run, pressed by that hand along x: above 1 it is unstable. [1] per cycle
double predicted_radius(const Trial& trial, const AdmittedTuning& admitted);

double deepest(const TrialRun& run);                       // [m] largest x
double peak_to_peak(const TrialRun& run, double seconds);  // [m] of x, over the last of them

// Columns side by side, of different lengths: runs at different rates.
class TrialTable {
 public:
  void add(std::string name, std::vector<double> cells);
  // A column of a run: `value` of each sample.
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

}  // namespace gearshift
