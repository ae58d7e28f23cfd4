#include "app/lab/contact/contact_campaign.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "app/lab/bench/rows/bench.h"
#include "haptics/files/number_text.h"

namespace gearshift::lab {
namespace {

constexpr std::uint64_t kSeedsPerHand = 1'000'000;
constexpr std::uint64_t kGripSeed = 0x2545f4914f6cdd1d;  // makes the grips' draws independent of the hands'

double unit(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

double between(double low, double high, std::mt19937_64& random) {
  return low + (high - low) * unit(random);
}

ContactCase drawn(const Campaign& campaign, const haptics::HandImpedance& hand, std::uint64_t seed,
                  std::mt19937_64& random) {
  ContactCase contact = campaign.contact;
  contact.lever.hand = hand;
  contact.lever.seed = seed;
  contact.lever.model_error = campaign.model_error;
  contact.lever.period_jitter = campaign.period_jitter;
  contact.speed = between(campaign.slowest, campaign.fastest, random);
  contact.phase = unit(random);
  contact.push = between(campaign.min_push, campaign.max_push, random);
  contact.place = campaign.place.value_or(unit(random));
  return contact;
}

}  // namespace

std::vector<ContactHand> named_hands() {
  std::vector<ContactHand> hands;
  for (const haptics::NamedHand& named : haptics::kNamedHands) hands.push_back({std::string(named.name), named.hand});
  for (const haptics::NamedHand& named : haptics::kElasticHands) hands.push_back({std::string(named.name), named.hand});
  return hands;
}

haptics::HandImpedance with_grip(haptics::HandImpedance hand, const std::array<double, 3>& drawn) {
  constexpr double kHandle = 0.1;  // [kg]
  hand.finger_mass = 0.005 * std::pow(10.0, drawn[0]);
  hand.grip_stiffness = 1000.0 * std::pow(8.0, drawn[1]);
  hand.grip_damping = 2.0 * (0.1 + 0.7 * drawn[2]) * std::sqrt(hand.grip_stiffness * kHandle);
  return hand;
}

haptics::HandImpedance any_hand(const std::array<double, 3>& drawn) {
  const auto even_in_decades = [](double low, double high, double part) { return low * std::pow(high / low, part); };
  haptics::HandImpedance hand;
  hand.mass = even_in_decades(0.02, 2.5, drawn[0]);
  hand.stiffness = even_in_decades(100.0, 1500.0, drawn[1]);
  hand.damping = 2.0 * (0.1 + (0.8 - 0.1) * drawn[2]) * std::sqrt(hand.stiffness * hand.mass);
  return hand;
}

std::vector<ContactHand> random_hands(int count, std::uint64_t seed) {
  std::mt19937_64 random(seed), grip(seed ^ kGripSeed);
  std::vector<ContactHand> hands;
  for (int i = 0; i < count; ++i) {
    haptics::HandImpedance hand = any_hand({unit(random), unit(random), unit(random)});
    std::string name = haptics::number_text(hand.mass, 3) + " kg, " + haptics::number_text(hand.damping, 1) +
                       " N s/m, " + haptics::number_text(hand.stiffness, 0) + " N/m";
    if (i % 3 == 2) {
      hand = with_grip(hand, {unit(grip), unit(grip), unit(grip)});
      name +=
          ", grip " + haptics::number_text(hand.grip_damping, 1) + ", " + haptics::number_text(hand.grip_stiffness, 0);
    }
    hands.push_back({std::move(name), hand});
  }
  return hands;
}

HandOutcome run_hand(const Campaign& campaign, std::size_t hand) {
  const std::uint64_t seed = campaign.seed + kSeedsPerHand * hand;
  std::mt19937_64 random(seed);
  HandOutcome out;
  out.hand = campaign.hands[hand].name;
  std::vector<double> ripple, force_ripple, tremble;
  for (int i = 0; i < campaign.runs; ++i) {
    const ContactResult one =
        run_contact(drawn(campaign, campaign.hands[hand].hand, seed + static_cast<std::uint64_t>(i), random));
    ripple.push_back(one.ripple);
    force_ripple.push_back(one.force_ripple);
    tremble.push_back(one.tremble);
    out.displayed = std::min(out.displayed, one.displayed / one.stiffness);
    out.peak = std::max(out.peak, one.peak);
    out.force_step = std::max(out.force_step, one.force_step);
    out.softest = std::min(out.softest, one.stiffness);
    out.lowered = std::max(out.lowered, one.lowered);
    out.softened += one.lowered > 0;
    out.saturated += one.saturated;
    out.stopped += one.stopped;
  }
  out.ripple_p95 = quantile(ripple, 0.95);
  out.ripple_max = quantile(ripple, 1.0);
  out.force_ripple = quantile(force_ripple, 0.95);
  out.tremble = quantile(tremble, 0.95);
  return out;
}

std::vector<HandOutcome> run_campaign(const Campaign& campaign) {
  std::vector<HandOutcome> outcomes;
  for (std::size_t hand = 0; hand < campaign.hands.size(); ++hand) outcomes.push_back(run_hand(campaign, hand));
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

double softest(const std::vector<HandOutcome>& outcomes) {
  double least = 1e9;
  for (const HandOutcome& outcome : outcomes) least = std::min(least, outcome.softest);
  return least;
}

double softened_fraction(const std::vector<HandOutcome>& outcomes, int runs) {
  int softened = 0;
  for (const HandOutcome& outcome : outcomes) softened += outcome.softened;
  return static_cast<double>(softened) / (static_cast<double>(runs) * static_cast<double>(outcomes.size()));
}

ImpactEnergy run_impacts(ContactCase contact, int phases, const ImpactPlan& plan) {
  std::mt19937_64 random(plan.seed);
  const double first_place = plan.seed == 0 ? 0.0 : unit(random);
  contact.push = 0.0;
  contact.duration = 0.3;
  contact.lever.hand = haptics::kBareHand;
  contact.lever.model_error = contact.lever.period_jitter = 0.0;
  contact.haptics.tuning.aisle_damping = 0.0;
  contact.haptics.tuning.limit_damping = 0.0;
  const auto from_usual = [](double a, double b) { return std::abs(a - kUsualSpeed) < std::abs(b - kUsualSpeed); };
  const double impacts = static_cast<double>(phases) * static_cast<double>(plan.speeds.size());
  ImpactEnergy out;
  out.hardness_speed = *std::min_element(plan.speeds.begin(), plan.speeds.end(), from_usual);
  for (const double speed : plan.speeds) {
    for (int i = 0; i < phases; ++i) {
      contact.speed = speed;
      contact.phase = (i + 0.5) / phases;
      // A drawn place spreads evenly, whatever the phase.
      contact.place = plan.place.value_or(std::fmod(first_place + 0.618034 * i, 1.0));
      const ContactResult one = run_contact(contact);
      out.worst_fraction = std::max(out.worst_fraction, one.energy / one.impact);
      out.worst = std::max(out.worst, one.energy);
      out.mean_fraction += one.energy / one.impact / impacts;
      out.restitution = std::max(out.restitution, one.restitution);
      if (speed == out.hardness_speed) out.hardness = std::min(out.hardness, one.hardness);
      out.surplus = std::max(out.surplus, one.energy - one.damped);
    }
  }
  return out;
}

std::array<base::Curve, 2> curves_in_motion(const std::vector<DynamicStiffness>& found, double stiffness) {
  std::array<base::Curve, 2> curves;
  curves[0] = {"frequency of the motion [Hz]", "Re Z / K", {}};
  curves[1] = {"frequency of the motion [Hz]", "damping Im Z / w [N s/m]", {}};
  for (const DynamicStiffness& one : found) {
    curves[0].points.emplace_back(one.frequency, one.stiffness / stiffness);
    curves[1].points.emplace_back(one.frequency, one.damping);
  }
  return curves;
}

}  // namespace gearshift::lab
