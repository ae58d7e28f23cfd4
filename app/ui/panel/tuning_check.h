// Checks whether a tuning is stable as requested and, if not, why and what would be. Uses admit_tuning() like the loop.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "app/ui/panel/tuning_fields.h"

namespace gearshift::ui {

struct TuningAnswer {
  bool admissible = false;           // unchanged; with allow_unstable, any valid tuning is
  haptics::AdmittedTuning admitted;  // what the loop would use; unchanged where the tuning is rejected
  std::string refused;               // reason for rejection, one sentence; empty if only limited
};

// Stable range of one field while the others keep their requested values.
struct StableRange {
  double min = 0.0, max = 0.0;
};
using StableRanges = std::array<StableRange, kTuningFields.size()>;

struct TuningQuestion {
  haptics::HapticConfig config;  // with the requested tuning
  haptics::DeviceSpec device;
  const haptics::Gate* gate = nullptr;                            // never null
  haptics::ContactHold hold = haptics::ContactHold::half_sample;  // of the running loop: a tuning cannot change it
};

TuningAnswer answer(const TuningQuestion& question);

// Always for a lever that a person may touch, i.e. without allow_unstable. If the requested tuning is not admissible,
// the ranges are those to which the loop would limit each field.
StableRanges stable_ranges(const TuningQuestion& question);

// The admissible tuning nearest to the requested one, i.e. what the loop would use; empty if there is none.
std::optional<haptics::HapticTuning> nearest_stable(const TuningQuestion& question);

// A TuningLimit as a sentence: value, bound, rule and the hand that decides.
std::string format_limit(const haptics::TuningLimit& limited);

// Caches the last answer until one of its inputs changes.
class TuningJudge {
 public:
  const TuningAnswer& judge(const TuningQuestion& question);
  // Needs many evaluations: milliseconds to tens of milliseconds. frozen: returns the last ranges without checking.
  const StableRanges& ranges(const TuningQuestion& question, bool frozen = false);
  int evaluations() const noexcept { return evaluations_; }  // number of evaluations not served from the cache

 private:
  using Basis = std::array<double, 22>;  // everything an answer depends on
  static Basis basis_of(const TuningQuestion& question);

  std::optional<TuningAnswer> answer_;
  std::optional<StableRanges> ranges_;
  Basis answer_basis_{}, ranges_basis_{};
  int evaluations_ = 0;
};

}  // namespace gearshift::ui
