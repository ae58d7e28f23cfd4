// The tour: a simulated hand shifts through every gear of a gate, and the drive is recorded.
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
#include "haptics/loop/haptic_event.h"
#include "haptics/loop/shift_script.h"

namespace gearshift::lab {

struct TourSetup {
  haptics::GateLayout layout;
  haptics::Gate gate;
  haptics::SimulatedLeverConfig lever;  // the hand must be stiff enough to move the lever
  haptics::HapticConfig haptics;
  std::uint64_t seed = 1;  // seed of the hand's random aims
  haptics::ShiftStyle style;
  std::filesystem::path folder;  // must exist; the tour writes tour.trace and tour.csv to it
};

// The time at which a gear engaged.
struct GearTime {
  int gear = haptics::kNeutralGear;
  double time = 0.0;  // [s]
};

// The number of times that the guard switched the forces off, and the reason and time of the first. A simulated lever
// re-arms itself, so this can happen several times in a tour.
struct LostForces {
  int times = 0;
  haptics::GuardFault fault = haptics::GuardFault::none;
  double time = 0.0;  // [s]
};

struct TourResult {
  std::vector<int> wanted;                   // gears to engage, in order
  std::vector<GearTime> engaged;             // gears that engaged, in order of time
  std::vector<haptics::TuningLimit> limits;  // parameters that were limited for the device
  double admitted = 0.0;                     // [N/m] wall stiffness at the start
  double softest = 0.0;                      // [N/m] lowest wall stiffness; the loop lowers it when the lever chatters
  double duration = 0.0;                     // [s] simulated time
  double deepest = 0.0;                      // [m] largest distance between the lever and the displayed lever (proxy)
  double strongest = 0.0;                    // [N] largest force of the hand
  std::uint64_t cycles = 0;                  // number of simulated cycles
  std::uint64_t contacts = 0;                // number of cycles in contact with a wall
  std::uint64_t hash = 0;                    // hash of the recording
  LostForces lost;                           // set only for a simulated hand

  bool complete() const;            // exactly the wanted gears were engaged, in order
  bool visited_in_order() const;    // the wanted gears were engaged in order; other gears in between are allowed
  double contact_fraction() const;  // [1] fraction of cycles in contact with a wall
};

// Called often. `what`: the current part of the work. `fraction`: the completed fraction of that part, 0 to 1.
using TourProgress = std::function<void(std::string_view what, double fraction)>;

// Called every 1/60 s of simulated time with the newest cycle and the events since the last call.
inline constexpr double kWatchPeriod = 1.0 / 60.0;  // [s]
using TourWatch = std::function<void(const haptics::HapticSnapshot& now, std::span<const haptics::HapticEvent> events)>;

// Adds a cycle to the statistics in the result.
void measure(const haptics::HapticSnapshot& now, TourResult& result);

// Drives and records the tour. Throws FileError if a file cannot be written.
TourResult drive_tour(const TourSetup& setup, const TourProgress& progress, const TourWatch& watch = {});

// Writes tour.csv from tour.trace in the folder. Returns the recording's hash. Throws FileError.
std::uint64_t write_tour_table(const std::filesystem::path& folder, const TourProgress& progress);

// Draws this tour from tour.csv like Fig. 9 (a) and (b) of Lin and Young's paper (haptics/EQUATIONS.md):
// trajectory.{svg,png} and force.{svg,png}.
void draw_tour(const TourSetup& setup, const TourResult& result, const TourProgress& progress);

}  // namespace gearshift::lab
