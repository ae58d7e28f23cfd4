#include "app/lab/contact/contact_study.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/base/chart.h"
#include "app/base/colours.h"
#include "app/base/svg.h"
#include "app/lab/bench/rows/bench.h"

namespace gearshift::lab {
namespace {

using Json = nlohmann::ordered_json;
using glm::dvec2;

constexpr int kMinPhases = 20;  // impacts per speed

std::string describe_loop(const ContactQuestion& question) {
  const ContactCase& contact = question.campaign.contact;
  return fmt::format("{:g} Hz, delay {} cycle{}", contact.haptics.rate, contact.lever.delay,
                     contact.lever.delay == 1 ? "" : "s");
}

// The speeds of the free impacts: both ends of the chosen range, and the usual ones between them.
ImpactPlan impact_plan(const Campaign& campaign) {
  ImpactPlan plan;
  const auto is_outside = [&](double speed) { return speed <= campaign.slowest || speed >= campaign.fastest; };
  std::erase_if(plan.speeds, is_outside);
  plan.speeds.insert(plan.speeds.begin(), campaign.slowest);
  if (campaign.fastest > campaign.slowest) plan.speeds.push_back(campaign.fastest);
  plan.place = campaign.place;
  plan.seed = campaign.seed;
  return plan;
}

std::string describe_wall(const ContactAnswer& answer) {
  const haptics::HapticTuning& tuning = answer.admitted.tuning;
  return fmt::format("{:.0f} N/m and {:.3g} N s/m, {}", tuning.wall_stiffness, tuning.wall_damping,
                     haptics::to_string(answer.admitted.hold));
}

std::string range_text(double low, double high) {
  return low == high ? fmt::format("{:g}", low) : fmt::format("{:.3g} to {:.3g}", low, high);
}

double max_of(const std::vector<HandOutcome>& hands, double HandOutcome::*figure) {
  double found = 0.0;
  for (const HandOutcome& hand : hands) found = std::max(found, hand.*figure);
  return found;
}

// The ripple of the worst hand, or of all hands together if each has only one run. [m]
double ripple_p95(const std::vector<HandOutcome>& hands, int runs) {
  if (runs > 1) return max_of(hands, &HandOutcome::ripple_p95);
  std::vector<double> ripple;
  for (const HandOutcome& hand : hands) ripple.push_back(hand.ripple_max);
  return quantile(ripple, 0.95);
}

std::string hand_table(const ContactAnswer& answer, int runs) {
  constexpr std::size_t kMaxRows = 12;
  static constexpr const char* kRow = "{:<46}{:>10}{:>10}{:>11}{:>10}{:>9}{:>11}\n";
  const auto row = [&](const HandOutcome& hand, int all_runs) {
    return fmt::format(kRow, hand.hand, fmt::format("{:.3f}", 1e3 * hand.ripple_p95),
                       fmt::format("{:.3f}", 1e3 * hand.ripple_max), fmt::format("{:.1f}", 1e3 * hand.peak),
                       fmt::format("{:.1f}", 100.0 * hand.displayed), fmt::format("{:.2f}", hand.tremble),
                       fmt::format("{} of {}", hand.softened, all_runs));
  };
  std::string text = fmt::format(kRow, "hand", "p95 [mm]", "max [mm]", "depth [mm]", "held [%]", "m/s^2", "softened");
  std::vector<HandOutcome> hands = answer.hands;
  if (hands.size() > kMaxRows)
    std::stable_sort(hands.begin(), hands.end(),
                     [](const auto& a, const auto& b) { return a.ripple_max > b.ripple_max; });
  HandOutcome all{"all hands"};
  for (std::size_t i = 0; i < hands.size(); ++i) {
    if (i < kMaxRows) text += row(hands[i], runs);
    all.softened += hands[i].softened;
  }
  if (hands.size() == 1) return text;
  all.ripple_p95 = answer.ripple_p95;
  all.ripple_max = max_of(hands, &HandOutcome::ripple_max);
  all.peak = deepest(hands);
  all.displayed = min_displayed(hands);
  all.tremble = max_of(hands, &HandOutcome::tremble);
  if (hands.size() > kMaxRows) text += fmt::format("and {} hands that move less\n", hands.size() - kMaxRows);
  return text + row(all, runs * static_cast<int>(hands.size()));
}

double max_saturation(const ContactAnswer& answer) {
  double found = 0.0;
  for (const DynamicStiffness& one : answer.dynamic) found = std::max(found, one.saturated);
  return found;
}

}  // namespace

ContactAnswer measure_contact(const ContactQuestion& question, const std::function<void(double)>& progress) {
  const Campaign& campaign = question.campaign;
  ContactAnswer answer;
  answer.admitted = admitted_wall(campaign.contact);
  const double runs = static_cast<double>(campaign.runs) * static_cast<double>(campaign.hands.size());
  for (std::size_t i = 0; i < campaign.hands.size(); ++i) {
    progress(0.9 * static_cast<double>(i) / static_cast<double>(campaign.hands.size()));
    answer.hands.push_back(run_hand(campaign, i));
    answer.stopped += answer.hands.back().stopped / runs;
    answer.saturated += answer.hands.back().saturated / runs;
  }
  answer.softened = softened_fraction(answer.hands, campaign.runs);
  answer.ripple_p95 = ripple_p95(answer.hands, campaign.runs);
  progress(0.9);
  answer.impacts = impact_plan(campaign);
  answer.impact = run_impacts(campaign.contact, std::max(kMinPhases, campaign.runs), answer.impacts);
  ContactCase gripped = campaign.contact;
  gripped.lever.hand = haptics::kGripHand;
  answer.dynamic = dynamic_stiffness(gripped, kMotionBand);
  return answer;
}

std::string contact_text(const ContactQuestion& question, const ContactAnswer& answer) {
  const Campaign& campaign = question.campaign;
  std::string text = fmt::format("device   {}\n", question.device);
  text += fmt::format("loop     {}\n", describe_loop(question));
  text += fmt::format("wall     {}\n", describe_wall(answer));
  for (const haptics::TuningLimit& limited : answer.admitted.limits)
    text += fmt::format("         {}\n", haptics::describe(limited));
  text += fmt::format("\nImpact at {} m/s, then a push of {} N; jitter {:g} %, plant error {:g} %; {} for each hand:\n",
                      range_text(campaign.slowest, campaign.fastest), range_text(campaign.min_push, campaign.max_push),
                      100.0 * campaign.period_jitter, 100.0 * campaign.model_error,
                      campaign.runs == 1 ? "one run" : fmt::format("{} runs", campaign.runs));
  text += hand_table(answer, campaign.runs);
  text += fmt::format(
      "p95, max: peak-to-peak motion of the pressed lever in 200 ms, {:g} s after the impact; depth: deepest point of "
      "the\n"
      "impact; held: least mean force over mean depth and K; m/s^2: rms acceleration, p95, at all frequencies. "
      "Fingers\n"
      "are taken to feel {:g} m/s^2 at 125 Hz and less elsewhere, so it is an upper bound of what they feel.\n",
      campaign.contact.duration, kFingerThreshold);
  if (answer.saturated > 0.0)
    text += fmt::format("The motors ({:g} N) were at their limit in {:.1f} % of the runs: choose a lighter --push.\n",
                        campaign.contact.lever.actuator.peak_force, 100.0 * answer.saturated);
  const ImpactEnergy& impact = answer.impact;
  text += fmt::format(
      "\nImpacts of a free lever at {} m/s, without jitter and plant error: the wall {} {:.0f} % of the worst impact's "
      "energy,\n"
      "restitution at most {:.2f}, rate-hardness at {:g} m/s at least {:.1f} kN/m\n\n",
      range_text(campaign.slowest, campaign.fastest), impact.worst_fraction < 0.0 ? "takes" : "ADDS",
      std::abs(100.0 * impact.worst_fraction), impact.restitution, impact.hardness_speed, 1e-3 * impact.hardness);
  text += fmt::format("{:<14}{:>12}{:>12}{:>16}\n", "swing [Hz]", "Re Z [N/m]", "of K [%]", "Im Z/w [N s/m]");
  for (const DynamicStiffness& one : answer.dynamic)
    text += fmt::format("{:<14g}{:>12.0f}{:>12.1f}{:>16.1f}\n", one.frequency, one.stiffness,
                        100.0 * one.stiffness / answer.admitted.tuning.wall_stiffness, one.damping);
  if (max_saturation(answer) > 0.0)
    text += fmt::format("The motors were at their limit in up to {:.0f} % of a swing, so its Re Z is too small.\n",
                        100.0 * max_saturation(answer));
  if (answer.stopped > 0.0)
    text += fmt::format("\nThe guard switched the forces off in {:.1f} % of the runs.\n", 100.0 * answer.stopped);
  return text;
}

std::string contact_json(const ContactQuestion& question, const ContactAnswer& answer) {
  const Campaign& campaign = question.campaign;
  Json json{{"device", question.device},
            {"rate_hz", campaign.contact.haptics.rate},
            {"delay_cycles", campaign.contact.lever.delay},
            {"dry_friction_n", campaign.contact.lever.coulomb_friction},
            {"device_walls_n_per_m", campaign.contact.lever.device_wall_stiffness},
            {"period_jitter", campaign.period_jitter},
            {"plant_error", campaign.model_error},
            {"push_n", {campaign.min_push, campaign.max_push}},
            {"speed_m_per_s", {campaign.slowest, campaign.fastest}},
            {"duration_s", campaign.contact.duration},
            {"runs", campaign.runs},
            {"seed", campaign.seed},
            {"hold", haptics::file_key(answer.admitted.hold)},
            {"k_n_per_m", answer.admitted.tuning.wall_stiffness},
            {"b_n_s_per_m", answer.admitted.tuning.wall_damping},
            {"ripple_p95_mm", 1e3 * answer.ripple_p95},
            {"ripple_max_mm", 1e3 * max_of(answer.hands, &HandOutcome::ripple_max)},
            {"peak_mm", 1e3 * max_of(answer.hands, &HandOutcome::peak)},
            {"shown_fraction", min_displayed(answer.hands)},
            {"tremble_m_per_s2", max_of(answer.hands, &HandOutcome::tremble)},
            {"tremble_over_finger_threshold", max_of(answer.hands, &HandOutcome::tremble) / kFingerThreshold},
            {"impact_hand", "bare"},
            {"impact_speeds_m_per_s", answer.impacts.speeds},
            {"energy_worst_fraction", answer.impact.worst_fraction},
            {"restitution_worst", answer.impact.restitution},
            {"rate_hardness_n_per_m", answer.impact.hardness},
            {"rate_hardness_speed_m_per_s", answer.impact.hardness_speed},
            {"re_z_saturated_fraction", max_saturation(answer)},
            {"saturated_fraction", answer.saturated},
            {"softened_fraction", answer.softened},
            {"stopped_fraction", answer.stopped}};
  for (const DynamicStiffness& one : answer.dynamic) {
    json["re_z_n_per_m"][fmt::format("{:g}", one.frequency)] = one.stiffness;
    json["damping_n_s_per_m"][fmt::format("{:g}", one.frequency)] = one.damping;
  }
  for (const HandOutcome& hand : answer.hands)
    json["hands"].push_back({{"hand", hand.hand},
                             {"ripple_p95_mm", 1e3 * hand.ripple_p95},
                             {"ripple_max_mm", 1e3 * hand.ripple_max},
                             {"shown_fraction", hand.displayed},
                             {"tremble_m_per_s2", hand.tremble},
                             {"softened", hand.softened},
                             {"saturated", hand.saturated},
                             {"stopped", hand.stopped}});
  return json.dump(2) + "\n";
}

std::string contact_svg(const ContactQuestion& question, const ContactAnswer& answer) {
  base::Svg svg({0.0, 0.0, 198.0, 92.0}, 6.0);
  svg.text({4.0, 7.5}, {4.6, base::kInk, "start", true}, "Stiffness of the wall in motion");
  svg.text({4.0, 12.0}, {2.7, base::kSoftInk},
           fmt::format("{}: {}, no jitter or plant error; wall of {}", question.device, describe_loop(question),
                       describe_wall(answer)));
  const std::array<base::Curve, 2> curves = curves_in_motion(answer.dynamic, answer.admitted.tuning.wall_stiffness);
  draw_curve(svg, {14.0, 24.0, 80.0, 52.0}, curves[0], 2.6);
  draw_curve(svg, {112.0, 24.0, 80.0, 52.0}, curves[1], 2.6);
  return std::move(svg).finish();
}

}  // namespace gearshift::lab
