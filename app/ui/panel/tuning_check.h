// Checks whether a tuning is stable as requested. If not, gives the reason and stable values. Uses admit_tuning() like
// the loop.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "app/ui/panel/tuning_fields.h"

namespace gearshift::ui {

struct TuningAnswer {
  bool admissible = false;           // can be used unchanged; true for any valid tuning with allow_unstable
  haptics::AdmittedTuning admitted;  // what the loop would use; the requested tuning if it is rejected
  std::string refused;               // reason for rejection, one sentence; empty if not rejected
};

// Stable range of one field while the others keep their requested values.
struct StableRange {
  double min = 0.0, max = 0.0;
};
using StableRanges = std::array<StableRange, kTuningFields.size()>;

struct TuningQuestion {
  haptics::HapticConfig config;  // contains the requested tuning
  haptics::DeviceSpec device;
  const haptics::Gate* gate = nullptr;                            // never null
  haptics::ContactHold hold = haptics::ContactHold::half_sample;  // hold of the running loop, which keeps it
};

TuningAnswer answer(const TuningQuestion& question);

// Ignores allow_unstable, so the ranges are those for a lever that a user may touch. If the requested tuning is not
// admissible, the ranges are those to which the loop would limit each field.
StableRanges stable_ranges(const TuningQuestion& question);

// The admissible tuning nearest to the requested one, i.e. what the loop would use; empty if there is none.
std::optional<haptics::HapticTuning> nearest_stable(const TuningQuestion& question);

// Describes a TuningLimit in a sentence: value, bound, rule, and the hand for which the bound is lowest.
std::string format_limit(const haptics::TuningLimit& limited);

// Caches the last answer until one of its inputs changes.
class TuningJudge {
 public:
  const TuningAnswer& judge(const TuningQuestion& question);
  // Checks many tunings, which takes 1 to some tens of milliseconds. frozen: returns the last ranges without checking.
  const StableRanges& ranges(const TuningQuestion& question, bool frozen = false);
  int evaluations() const noexcept { return evaluations_; }  // number of evaluations not served from the cache

 private:
  using Basis = std::array<double, 22>;  // all numbers on which an answer depends
  static Basis basis_of(const TuningQuestion& question);

  std::optional<TuningAnswer> answer_;
  std::optional<StableRanges> ranges_;
  Basis answer_basis_{}, ranges_basis_{};
  int evaluations_ = 0;
};

}  // namespace gearshift::ui
