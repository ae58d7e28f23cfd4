#include "app/lessons/assessment/guidance.h"

#include <algorithm>
#include <utility>

namespace gearshift::lessons {
namespace {

// Random number generator SplitMix64 (Steele, Lea, Flood. Fast Splittable Pseudorandom Number Generators. 2014).
std::uint64_t draw(std::uint64_t& state) noexcept {
  std::uint64_t z = (state += 0x9e3779b97f4a7c15u);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

}  // namespace

GuidancePolicy::GuidancePolicy(std::uint64_t seed, const GuidanceConfig& config)
    : config_(config), random_(seed), lever_(config.start), pedals_(config.start) {}

TrialPlan GuidancePolicy::next() {
  if (trial_ % guided_.size() == 0) shuffle();
  const bool helped = guided_[trial_++ % guided_.size()];
  const auto given = [&](double gain) { return helped && gain >= config_.min_gain ? gain : 0.0; };
  HintStyle hints = HintStyle::prescriptive;
  if (skill_ >= config_.bandwidth_from) hints = HintStyle::bandwidth;
  if (skill_ >= config_.summary_from) hints = HintStyle::summary;
  return {given(lever_), given(pedals_), hints};
}

TrialPlan GuidancePolicy::retention() const noexcept {
  return {0.0, 0.0, HintStyle::summary};
}

void GuidancePolicy::learn(double error, double of_lever, double of_pedals) noexcept {
  if (!(error >= 0.0 && of_lever >= 0.0 && of_pedals >= 0.0)) return;  // ignores NaN
  const auto part = [&](double of) { return std::min(of / config_.full_error, 1.0); };
  const double forgetting = config_.forgetting + skill_ * (config_.forgetting_skilled - config_.forgetting);
  lever_ = std::clamp(forgetting * lever_ + config_.per_error * part(of_lever), 0.0, 1.0);
  pedals_ = std::clamp(forgetting * pedals_ + config_.per_error * part(of_pedals), 0.0, 1.0);
  skill_ = config_.skill_memory * skill_ + (1.0 - config_.skill_memory) * (1.0 - part(error));
}

// Fisher-Yates shuffle.
void GuidancePolicy::shuffle() noexcept {
  for (std::size_t i = guided_.size() - 1; i > 0; --i) std::swap(guided_[i], guided_[draw(random_) % (i + 1)]);
}

}  // namespace gearshift::lessons
