// Simulates one case with the complete haptic cycle, headless, and checks every law.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "app/lab/campaign/campaign_case.h"
#include "app/lab/campaign/campaign_laws.h"

namespace gearshift::lab {

struct CaseOutcome {
  std::uint64_t number = 0;
  std::string refused;  // why the loop rejected the configuration, without commas; empty if the case was run
  int shifts = 0;       // tried
  int clean = 0;        // number of shifts with a clean aim
  int reached = 0;      // number of shifts that reached their gear
  std::uint64_t cycles = 0;
  double seconds = 0.0;    // [s] simulated time
  double stiffness = 0.0;  // [N/m] admitted wall stiffness
  int limited = 0;         // number of parameters that the stability check limited
  bool promised = false;   // the stability check guarantees no vibration and no faults in this case
  int stopped = 0;         // number of times the guard switched the forces off
  double ripple = 0.0;     // [m] largest peak-to-peak motion in a hold
  int softened = 0;        // number of times the reversal limiter lowered the stiffness
  double fastest = 0.0;    // [m/s] largest true speed of the lever
  LawRecord laws;
};

// Changes the limits. Tests use this to break each law on purpose and to show that the violation is detected.
using PlantedLimits = std::function<void(LawLimits& limits)>;

// `trace`: file to record to; empty: no recording. Throws FileError if the file cannot be written.
CaseOutcome run_case(const CampaignCase& drawn, std::span<const haptics::GateLayout> shipped,
                     const std::filesystem::path& trace = {}, const PlantedLimits& planted = {});

// Returns the layouts in the folder, sorted by name. Throws FileError.
std::vector<haptics::GateLayout> shipped_layouts(const std::filesystem::path& folder);

}  // namespace gearshift::lab
