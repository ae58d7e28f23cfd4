#include "app/lab/bench/lever/contact_campaign.h"

#include <algorithm>
#include <cstddef>
#include <random>

#include "app/lab/bench/rows/bench.h"

namespace gearshift::lab {
namespace {

double unit(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

ContactCase drawn(const Campaign& campaign, const haptics::HandImpedance& hand, std::uint64_t seed,
                  std::mt19937_64& random) {
  ContactCase contact = campaign.contact;
  contact.lever.hand = hand;
  contact.lever.seed = seed;
  contact.lever.model_error = campaign.model_error;
  contact.lever.period_jitter = campaign.period_jitter;
  contact.speed = campaign.slowest + (campaign.fastest - campaign.slowest) * unit(random);
  contact.phase = unit(random);
  return contact;
}

HandOutcome run_hand(const Campaign& campaign, const haptics::NamedHand& named) {
  std::mt19937_64 random(7);
  HandOutcome out{std::string(named.name), 0, 0, 1e9, 0, 0, 0, 1e9, 0, 0};
  std::vector<double> ripple, force_ripple;
  for (int i = 0; i < campaign.runs; ++i) {
    const ContactResult one = run_contact(drawn(campaign, named.hand, static_cast<std::uint64_t>(i) + 1, random));
    ripple.push_back(one.ripple);
    force_ripple.push_back(one.force_ripple);
    out.displayed = std::min(out.displayed, one.displayed / one.stiffness);
    out.peak = std::max(out.peak, one.peak);
    out.force_step = std::max(out.force_step, one.force_step);
    out.softest = std::min(out.softest, one.stiffness);
    out.lowered = std::max(out.lowered, one.lowered);
    out.stopped += one.stopped;
  }
  out.ripple_p95 = quantile(ripple, 0.95);
  out.ripple_max = quantile(ripple, 1.0);
  out.force_ripple = quantile(force_ripple, 0.95);
  return out;
}

}  // namespace

std::vector<HandOutcome> run_campaign(const Campaign& campaign) {
  std::vector<HandOutcome> outcomes;
  for (const haptics::NamedHand& named : haptics::kNamedHands) outcomes.push_back(run_hand(campaign, named));
  return outcomes;
}

const HandOutcome& worst_ripple(const std::vector<HandOutcome>& outcomes) {
  return *std::max_element(outcomes.begin(), outcomes.end(),
                           [](const auto& a, const auto& b) { return a.ripple_p95 < b.ripple_p95; });
}

double deepest(const std::vector<HandOutcome>& outcomes) {
  double max_peak = 0.0;
  for (const HandOutcome& outcome : outcomes) max_peak = std::max(max_peak, outcome.peak);
  return max_peak;
}

double min_displayed(const std::vector<HandOutcome>& outcomes) {
  double min_ratio = 1e9;
  for (const HandOutcome& outcome : outcomes) min_ratio = std::min(min_ratio, outcome.displayed);
  return min_ratio;
}

ImpactEnergy run_impacts(ContactCase contact, int phases) {
  contact.push = 0.0;
  contact.duration = 0.3;
  contact.lever.hand = haptics::kBareHand;
  contact.haptics.tuning.aisle_damping = 0.0;
  contact.haptics.tuning.limit_damping = 0.0;
  ImpactEnergy out;
  for (const double speed : {0.1, 0.3, 0.5, 1.0}) {
    for (int i = 0; i < phases; ++i) {
      contact.speed = speed;
      contact.phase = (i + 0.5) / phases;
      const ContactResult one = run_contact(contact);
      out.worst_fraction = std::max(out.worst_fraction, one.energy / one.impact);
      out.worst = std::max(out.worst, one.energy);
      out.mean_fraction += one.energy / one.impact / (4.0 * phases);
      out.restitution = std::max(out.restitution, one.restitution);
      out.surplus = std::max(out.surplus, one.energy - one.damped);
    }
  }
  return out;
}

}  // namespace gearshift::lab
