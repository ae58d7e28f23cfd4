// Drives one case through the whole cycle, headless, and looks at every law.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "tests/bench/campaign/campaign_case.h"
#include "tests/bench/campaign/campaign_laws.h"

namespace gearshift {

struct CaseOutcome {
  std::uint64_t number = 0;
  std::string refused;  // why the loop does not run it at all, without commas; nothing is driven then
  int shifts = 0;       // tried
  int clean = 0;        // of them aimed at and nothing but that
  int reached = 0;      // of all
  std::uint64_t cycles = 0;
  double seconds = 0.0;    // [s] simulated
  double stiffness = 0.0;  // [N/m] admitted
  int limited = 0;         // parameters that were not admitted as wanted
  bool promised = false;   // quiet, and never stopped: error, jitter and hand are what the checks were made for
  int stopped = 0;         // times that the guard fell
  double ripple = 0.0;     // [m] back and forth, in the worst hold
  int softened = 0;        // times that the reversal limiter took some of the wall
  double fastest = 0.0;    // [m/s] of the true lever
  LawBook laws;
};

// `planted` changes what is looked for, and is for tests: a law that nothing can break proves nothing.
using PlantedLimits = std::function<void(LawLimits& limits)>;

// trace: where to record it; empty: nowhere. Throws FileError where that cannot be written.
CaseOutcome run_case(const CampaignCase& drawn, std::span<const GateLayout> shipped,
                     const std::filesystem::path& trace = {}, const PlantedLimits& planted = {});

// Sorted by name. Throws FileError.
std::vector<GateLayout> shipped_layouts(const std::filesystem::path& folder);

}  // namespace gearshift
