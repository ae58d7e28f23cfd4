#include "app/panel/tuning_answer.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "app/panel/value_text.h"
#include "haptics/gate/gate_feel.h"

namespace gearshift {
namespace {

// What a running loop would say: its hold stays.
HapticConfig as_it_runs(const TuningQuestion& question) {
  HapticConfig config = question.config;
  config.contact.hold = question.hold;
  return config;
}

TuningQuestion with_value(TuningQuestion question, const TuningField& field, double value) {
  question.config.tuning.*field.member = value;
  return question;
}

// The value between one that is admissible and one that is not, to a thousandth of what lies between.
double last_admissible(const TuningQuestion& question, const TuningField& field, double good, double bad) {
  constexpr int kHalvings = 10;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (good + bad);
    (answer(with_value(question, field, middle)).admissible ? good : bad) = middle;
  }
  return good;
}

// What the loop makes of a field's extreme. That may be had at the cost of another field only: then less.
double reach(const TuningQuestion& question, const TuningField& field, double extreme, bool stands) {
  const TuningAnswer said = answer(with_value(question, field, extreme));
  const double reached = said.refused.empty() ? said.admitted.tuning.*field.member : extreme;
  if (said.admissible || !stands) return reached;
  if (answer(with_value(question, field, reached)).admissible) return reached;
  return last_admissible(question, field, question.config.tuning.*field.member, reached);
}

}  // namespace

std::size_t tuning_field(std::string_view key) noexcept {
  const auto found =
      std::find_if(kTuningFields.begin(), kTuningFields.end(), [&](const TuningField& f) { return f.key == key; });
  return static_cast<std::size_t>(found - kTuningFields.begin());
}

TuningAnswer answer(const TuningQuestion& question) {
  TuningAnswer out;
  out.admitted.tuning = question.config.tuning;
  out.admitted.hold = question.hold;
  try {
    check_tuning(question.config.tuning);
    out.admitted = admit_tuning(as_it_runs(question), question.device, *question.gate);
    if (out.admitted.hold != question.hold) out.refused = "this needs another hold than the one that runs";
  } catch (const std::invalid_argument& refused) {
    out.refused = refused.what();
  }
  out.admissible = out.refused.empty() && out.admitted.tuning == question.config.tuning;
  return out;
}

StableRanges stable_ranges(const TuningQuestion& question) {
  TuningQuestion safe = question;
  safe.config.contact.study = false;
  const bool stands = answer(safe).admissible;
  StableRanges ranges;
  for (std::size_t i = 0; i < kTuningFields.size(); ++i) {
    const TuningField& field = kTuningFields[i];
    ranges[i] = {reach(safe, field, field.least, stands), reach(safe, field, field.most, stands)};
  }
  // A wall softer than the feel costs the feel: exactly here.
  const std::size_t wall = tuning_field("wall_stiffness_n_per_m");
  const double feel = question.config.tuning.feel_scale * stiffest_feel(*question.gate);
  if (feel > 0.99 * ranges[wall].least && answer(with_value(safe, kTuningFields[wall], feel)).admissible)
    ranges[wall].least = feel;
  return ranges;
}

std::optional<HapticTuning> most_stable(const TuningQuestion& question) {
  // What was limited may in turn allow or forbid something else: asked again until nothing is limited any more.
  constexpr int kMostRounds = 8;
  TuningQuestion next = question;
  for (int round = 0; round < kMostRounds; ++round) {
    const TuningAnswer said = answer(next);
    if (said.admissible) return next.config.tuning;
    if (!said.refused.empty()) return std::nullopt;
    next.config.tuning = said.admitted.tuning;
  }
  return std::nullopt;
}

std::string limited_sentence(const Limited& limited) {
  const std::size_t index = tuning_field(limited.what);
  if (index == kTuningFields.size()) return fmt::format("{}: {}", limited.what, limited.law);
  const TuningField& field = kTuningFields[index];
  return fmt::format("{}: {} is {} than the stable {}. Law: {}{}{}.", field.label, value_text(limited.wanted, field),
                     limited.wanted > limited.bound ? "more" : "less", value_text(limited.bound, field), limited.law,
                     limited.hand.empty() ? "" : "; decided by hand: ", limited.hand);
}

TuningJudge::Basis TuningJudge::basis_of(const TuningQuestion& q) {
  const HapticConfig& c = q.config;
  const HapticTuning& t = c.tuning;
  const AxisModel &x = q.device.axis_x, &y = q.device.axis_y;
  return {t.wall_stiffness,
          t.wall_damping,
          t.feel_scale,
          t.aisle_damping,
          t.speed_limit,
          t.limit_damping,
          c.rate,
          static_cast<double>(c.contact.energy_control),
          c.contact.reversal_limiter ? 1.0 : 0.0,
          c.contact.study ? 1.0 : 0.0,
          c.estimator.smoothing,
          static_cast<double>(c.estimator.window),
          static_cast<double>(q.hold),
          static_cast<double>(q.device.delay),
          q.device.simulated ? 1.0 : 0.0,
          x.mass,
          x.damping,
          x.stiffness,
          y.mass,
          y.damping,
          y.stiffness,
          stiffest_feel(*q.gate)};
}

const TuningAnswer& TuningJudge::judge(const TuningQuestion& question) {
  const Basis basis = basis_of(question);
  if (!answer_ || basis != answer_basis_) {
    answer_ = answer(question);
    answer_basis_ = basis;
    ++asked_;
  }
  return *answer_;
}

const StableRanges& TuningJudge::ranges(const TuningQuestion& question, bool frozen) {
  if (ranges_ && frozen) return *ranges_;
  const Basis basis = basis_of(question);
  if (!ranges_ || basis != ranges_basis_) {
    ranges_ = stable_ranges(question);
    ranges_basis_ = basis;
    ++asked_;
  }
  return *ranges_;
}

}  // namespace gearshift
