// Is a tuning stable as it is wanted, and if not, why and what would be: asked of the function that guards the loop.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "app/panel/tuning_fields.h"

namespace gearshift {

struct TuningAnswer {
  bool admissible = false;  // as it is wanted; in a study everything that can be is
  AdmittedTuning admitted;  // what the loop would use; as wanted where it is refused as a whole
  std::string refused;      // one sentence; empty where it is only limited
};

// How far a field goes, the others as they are wanted.
struct StableRange {
  double least = 0.0, most = 0.0;
};
using StableRanges = std::array<StableRange, kTuningFields.size()>;

struct TuningQuestion {
  HapticConfig config;  // the tuning as wanted
  DeviceSpec device;
  const Gate* gate = nullptr;                   // never null
  ContactHold hold = ContactHold::half_sample;  // that runs: a tuning cannot change it
};

TuningAnswer answer(const TuningQuestion& question);

// Whatever the study: of what a person may touch. Where the tuning as it is wanted is not admissible, how far the loop
// would let each field go.
StableRanges stable_ranges(const TuningQuestion& question);

// The tuning nearest to the wanted one that is admitted as it is: what the loop would use of it. Nothing where there is
// none.
std::optional<HapticTuning> most_stable(const TuningQuestion& question);

// "5000 N/m is more than the 1204 that ... admits" for people: value, bound, law and the hand that decides.
std::string limited_sentence(const Limited& limited);

// The last answer, until something that it depends on is another.
class TuningJudge {
 public:
  const TuningAnswer& judge(const TuningQuestion& question);
  // Many questions in one: milliseconds, or tens of them. frozen: as they were last, whatever has changed.
  const StableRanges& ranges(const TuningQuestion& question, bool frozen = false);
  int asked() const noexcept { return asked_; }  // how often an answer was not known already

 private:
  using Basis = std::array<double, 22>;  // all that an answer depends on
  static Basis basis_of(const TuningQuestion& question);

  std::optional<TuningAnswer> answer_;
  std::optional<StableRanges> ranges_;
  Basis answer_basis_{}, ranges_basis_{};
  int asked_ = 0;
};

}  // namespace gearshift
