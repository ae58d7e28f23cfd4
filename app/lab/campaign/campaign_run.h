// Runs one case through the whole cycle, headless, and checks every law.
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
  std::string refused;  // why the loop rejected the configuration, without commas; if set, the case was not run
  int shifts = 0;       // tried
  int clean = 0;        // tried with a clean aim
  int reached = 0;      // tried shifts that reached their gear
  std::uint64_t cycles = 0;
  double seconds = 0.0;    // [s] simulated
  double stiffness = 0.0;  // [N/m] admitted
  int limited = 0;         // number of parameters that were limited
  bool promised = false;   // for this plant error, jitter and hand the checks promise quiet and no faults
  int stopped = 0;         // number of times the guard switched the forces off
  double ripple = 0.0;     // [m] largest peak-to-peak motion in a hold
  int softened = 0;        // number of times the reversal limiter lowered the stiffness
  double fastest = 0.0;    // [m/s] largest true speed of the lever
  LawRecord laws;
};

// Changes the limits; for tests that plant a violation to show that each law can detect one.
using PlantedLimits = std::function<void(LawLimits& limits)>;

// trace: file to record to; empty: no recording. Throws FileError if it cannot be written.
CaseOutcome run_case(const CampaignCase& drawn, std::span<const haptics::GateLayout> shipped,
                     const std::filesystem::path& trace = {}, const PlantedLimits& planted = {});

// Sorted by name. Throws FileError.
std::vector<haptics::GateLayout> shipped_layouts(const std::filesystem::path& folder);

}  // namespace gearshift::lab
