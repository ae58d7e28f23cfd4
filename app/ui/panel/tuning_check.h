// Checks whether a tuning is stable as requested. If it is not, gives the reason and stable values. Uses
// admit_tuning(), as the loop does.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "app/ui/panel/tuning_fields.h"

namespace gearshift::ui {

struct TuningAnswer {
  bool admissible = false;           // usable unchanged; true for any valid tuning if allow_unstable is set
  haptics::AdmittedTuning admitted;  // tuning that the loop would use; if rejected, the requested one
  std::string refused;               // reason for rejection, one sentence; empty if not rejected
};

// Stable range of one field while the others keep their requested values.
struct StableRange {
  double min = 0.0, max = 0.0;
};
using StableRanges = std::array<StableRange, std::size(kTuningFields)>;

// The arguments of admit_tuning(), so that the answers to equal questions are equal.
struct TuningQuestion {
  haptics::HapticConfig config;  // contains the requested tuning
  haptics::DeviceSpec device;
  double feel_stiffness = 0.0;  // [N/m] haptics::max_feel_stiffness() of the gate
  bool operator==(const TuningQuestion&) const = default;
};

// The question has the contact hold method of the running loop, which cannot change while the loop runs.
TuningAnswer answer(const TuningQuestion& question);

// Returns the ranges for a lever that a user may touch, so allow_unstable is ignored. If the requested tuning is not
// admissible, the ranges are those to which the loop would limit each field.
StableRanges stable_ranges(const TuningQuestion& question);

// The admissible tuning nearest to the requested one, i.e. what the loop would use; empty if there is none.
std::optional<haptics::HapticTuning> nearest_stable(const TuningQuestion& question);

// Describes a TuningLimit in a sentence: value, bound, stability rule, and the modelled hand with the lowest bound.
std::string format_limit(const haptics::TuningLimit& limited);

// Caches the last answer until the question changes.
class TuningJudge {
 public:
  const TuningAnswer& judge(const TuningQuestion& question);
  // Checks many tunings, which takes 1 ms to some tens of milliseconds. frozen: returns the previous ranges without a
  // check.
  const StableRanges& ranges(const TuningQuestion& question, bool frozen = false);

 private:
  std::optional<TuningAnswer> answer_;
  std::optional<StableRanges> ranges_;
  TuningQuestion answered_, ranged_;
};

}  // namespace gearshift::ui
