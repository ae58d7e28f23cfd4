#include "app/ui/panel/tuning_check.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "app/ui/panel/format_value.h"

namespace gearshift::ui {
namespace {

TuningQuestion with_value(TuningQuestion question, const TuningField& field, double value) {
  value_of(question.config.tuning, field) = value;
  return question;
}

// Bisects between an admissible and an inadmissible value. Returns an admissible value whose distance from the limit is
// at most a thousandth of the interval.
double last_admissible(const TuningQuestion& question, const TuningField& field, double good, double bad) {
  constexpr int kHalvings = 10;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (good + bad);
    (answer(with_value(question, field, middle)).admissible ? good : bad) = middle;
  }
  return good;
}

// Returns the value that the loop would use if `field` were set to `extreme`, its minimum or maximum. If the question's
// tuning is admissible (`is_admissible`) but would not be with that value, returns the last admissible one towards it.
double limited_extreme(const TuningQuestion& question, const TuningField& field, double extreme, bool is_admissible) {
  const TuningAnswer answered = answer(with_value(question, field, extreme));
  const double reached = answered.refused.empty() ? value_of(answered.admitted.tuning, field) : extreme;
  if (answered.admissible || !is_admissible) return reached;
  if (answer(with_value(question, field, reached)).admissible) return reached;
  return last_admissible(question, field, value_of(question.config.tuning, field), reached);
}

}  // namespace

TuningAnswer answer(const TuningQuestion& question) {
  TuningAnswer out;
  out.admitted.tuning = question.config.tuning;
  out.admitted.hold = question.config.contact.hold;
  try {
    haptics::check_tuning(question.config.tuning);
    out.admitted = haptics::admit_tuning(question.config, question.device, question.feel_stiffness);
    if (out.admitted.hold != question.config.contact.hold)
      out.refused = "These values need a different Hold setting. Change Hold in Setup and restart the loop.";
  } catch (const std::invalid_argument& refused) {
    out.refused = refused.what();
  }
  out.admissible = out.refused.empty() && out.admitted.tuning == question.config.tuning;
  return out;
}

StableRanges stable_ranges(const TuningQuestion& question) {
  TuningQuestion safe = question;
  safe.config.contact.allow_unstable = false;
  const bool is_admissible = answer(safe).admissible;
  StableRanges ranges;
  for (std::size_t i = 0; i < std::size(kTuningFields); ++i) {
    const TuningField& field = kTuningFields[i];
    ranges[i] = {limited_extreme(safe, field, field.range.min, is_admissible),
                 limited_extreme(safe, field, field.range.max, is_admissible)};
  }
  // The gate's feel (centring, detents) is limited if the wall is softer than the feel. So the wall's stable range
  // begins at the stiffness of the feel.
  constexpr std::size_t kWall = index_of(&haptics::HapticTuning::wall_stiffness);
  const double feel = question.config.tuning.feel_scale * question.feel_stiffness;
  if (feel > 0.99 * ranges[kWall].min && answer(with_value(safe, kTuningFields[kWall], feel)).admissible)
    ranges[kWall].min = feel;
  return ranges;
}

std::optional<haptics::HapticTuning> nearest_stable(const TuningQuestion& question) {
  // Limiting one field may change the limits of other fields, so repeat until nothing is limited.
  constexpr int kMaxRounds = 8;
  TuningQuestion next = question;
  for (int round = 0; round < kMaxRounds; ++round) {
    const TuningAnswer answered = answer(next);
    if (answered.admissible) return next.config.tuning;
    if (!answered.refused.empty()) return std::nullopt;
    next.config.tuning = answered.admitted.tuning;
  }
  return std::nullopt;
}

std::string format_limit(const haptics::TuningLimit& limit) {
  if (limit.parameter == haptics::kHold) return fmt::format("{}: {}", haptics::to_string(limit.parameter), limit.law);
  const TuningField& field = haptics::parameter_of(limit.parameter);
  return fmt::format("{} {} is {} the stable limit of {}. Rule: {}{}{}.", field.label,
                     format_value(limit.wanted, field), limit.wanted > limit.bound ? "above" : "below",
                     format_value(limit.bound, field), limit.law,
                     limit.hand.empty() ? "" : ". Deciding hand: ", limit.hand);
}

const TuningAnswer& TuningJudge::judge(const TuningQuestion& question) {
  if (!answer_ || question != answered_) {
    answer_ = answer(question);
    answered_ = question;
  }
  return *answer_;
}

const StableRanges& TuningJudge::ranges(const TuningQuestion& question, bool frozen) {
  if (ranges_ && frozen) return *ranges_;
  if (!ranges_ || question != ranged_) {
    ranges_ = stable_ranges(question);
    ranged_ = question;
  }
  return *ranges_;
}

}  // namespace gearshift::ui
