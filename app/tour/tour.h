// The tour: a simulated hand shifts through every gear of a gate, recorded.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "haptics/device/simulated_lever.h"
#include "haptics/gate/gate.h"
#include "haptics/gate/gate_layout.h"
#include "haptics/loop/haptic_config.h"
#include "haptics/loop/haptic_snapshot.h"
#include "haptics/loop/shift_script.h"

namespace gearshift {

struct TourSetup {
  GateLayout layout;
  Gate gate;
  SimulatedLeverConfig lever;  // its hand must be able to lead it
  HapticConfig haptics;
  std::uint64_t seed = 1;  // of the hand's aims
  ShiftStyle style;
  std::filesystem::path folder;  // exists; receives tour.trace and tour.csv
};

// When a gear came.
struct GearTime {
  int gear = kNeutralGear;
  double time = 0.0;  // [s]
};

// How often the guard took the forces, and why and when it first did. A simulated lever has them back by itself.
struct LostForces {
  int times = 0;
  GuardFault fault = GuardFault::none;
  double time = 0.0;  // [s]
};

struct TourResult {
  std::vector<int> wanted;        // gears in the order of the tour
  std::vector<GearTime> engaged;  // as they came
  std::vector<Limited> limited;   // parameters that the device did not admit as wanted
  double admitted = 0.0;          // [N/m] wall stiffness at the start
  double softest = 0.0;           // [N/m] the least in use: lowered where the lever chattered
  double duration = 0.0;          // [s] simulated
  double deepest = 0.0;           // [m] lever beyond the drawn lever
  double strongest = 0.0;         // [N] largest push of the hand
  std::uint64_t cycles = 0;       // driven
  std::uint64_t contacts = 0;     // cycles in contact with a wall
  std::uint64_t hash = 0;         // of the recording
  LostForces lost;                // of a simulated hand's tour

  bool complete() const;         // engaged is wanted, in order and nothing else
  bool came_in_order() const;    // the same, with others between: as a person drives
  double contact_share() const;  // [1] of the cycles
};

// Told, often, which part of the work is in hand and which share of it is done (0 to 1).
using TourProgress = std::function<void(std::string_view what, double share)>;

// Shown a cycle every 1/60 s of the drive, and what happened since the one before.
inline constexpr double kWatchPeriod = 1.0 / 60.0;  // [s]
using TourWatch = std::function<void(const HapticSnapshot& now, std::span<const HapticEvent> events)>;

// What a cycle adds to it.
void measure(const HapticSnapshot& now, TourResult& result);

// Drives and records. Throws FileError when a file cannot be written.
TourResult drive_tour(const TourSetup& setup, const TourProgress& progress, const TourWatch& watch = {});

// tour.csv from tour.trace, in that folder. Returns the recording's hash. Throws FileError.
std::uint64_t write_tour_table(const std::filesystem::path& folder, const TourProgress& progress);

// Fig. 9 (a) and (b) of the paper for this run: trajectory.{svg,png}, force.{svg,png}, from tour.csv.
void draw_tour(const TourSetup& setup, const TourResult& result, const TourProgress& progress);

}  // namespace gearshift
