// A wall of 5000 N/m under pushes of 4 to 30 N with the shipped default configuration, at several rates and delays: at
// rest, in motion, and in random hands.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "app/lab/bench/rows/bench.h"
#include "app/lab/contact/contact_campaign.h"

namespace gearshift::lab {
namespace {

struct Setting {
  double rate;                // [Hz]
  int delay;                  // [samples]
  double goal_p95, goal_max;  // [mm]
  bool shows_5000 = false;    // the wall must display its full stiffness of 5000 N/m
  double wanted = 5000.0;     // [N/m]
};

std::string timing_label(const Setting& at) {
  std::string text = std::to_string(static_cast<int>(at.rate)) + " Hz";
  return at.delay == 0 ? text : text + ", delay " + std::to_string(at.delay);
}

// Eight samples late, one hand of 1.6 kg moves by 0.24 mm, because its grip of 5.7 N s/m hardly damps the handle. The same
// with a wall of 552 instead of 616 N/m.
constexpr double kMaxRandomRipple = 0.15e-3;  // [m]

Campaign pushes(const Setting& at, int runs) {
  Campaign campaign;
  campaign.contact.haptics.rate = at.rate;
  campaign.contact.haptics.tuning.wall_stiffness = at.wanted;
  campaign.contact.lever.delay = at.delay;
  campaign.contact.duration = at.rate < 500.0 ? 2.0 : 1.2;
  campaign.runs = runs;
  return campaign;
}

// Adds Re Z over the stiffness in use, and the damping, of a wall that a gripping hand moves: as figures and as curves.
void add_motion(BenchRow& row, ContactCase contact) {
  constexpr double kShown[] = {0.5, 1.0, 2.0, 5.0, 10.0, 20.0};  // [Hz] as figures
  contact.lever.hand = haptics::kGripHand;
  const double stiffness = admitted_wall(contact).tuning.wall_stiffness;
  const std::vector<DynamicStiffness> found = dynamic_stiffness(contact, kMotionBand);
  for (const DynamicStiffness& one : found) {
    if (std::find(std::begin(kShown), std::end(kShown), one.frequency) == std::end(kShown)) continue;
    const std::string at = fmt::format(" at {:g} Hz", one.frequency);
    row.related.push_back({"Re Z" + at + ", of K", 100.0 * one.stiffness / stiffness, "%"});
    row.related.push_back({"damping" + at, one.damping, "N s/m"});
  }
  for (base::Curve& curve : curves_in_motion(found, stiffness)) row.curves.push_back(std::move(curve));
}

// Impacts of a free lever at 0.1 to 1 m/s.
std::vector<RelatedFigure> in_impact(const ContactCase& contact, bool quick) {
  const ImpactEnergy impact = run_impacts(contact, quick ? 10 : 400);  // phases, as in the family energy
  return {{"worst impact's energy", 100.0 * impact.worst_fraction, "%"},
          {"maximum restitution", impact.restitution, ""},
          {"least rate-hardness at 0.3 m/s", 1e-3 * impact.hardness, "kN/m"}};
}

void add(std::vector<BenchRow>& rows, const Setting& at, const std::string& prefix, const Campaign& campaign,
         bool quick) {
  const std::vector<HandOutcome> outcomes = run_campaign(campaign);
  const HandOutcome& worst = worst_ripple(outcomes);
  double max_ripple = 0.0;
  for (const HandOutcome& outcome : outcomes) max_ripple = std::max(max_ripple, outcome.ripple_max);
  std::vector<RelatedFigure> related{{"lowest stiffness in use", softest(outcomes), "N/m"},
                                     {"displayed", 100.0 * min_displayed(outcomes), "%"},
                                     {"softened", 100.0 * softened_fraction(outcomes, campaign.runs), "% of the runs"},
                                     {"deepest", 1e3 * deepest(outcomes), "mm"},
                                     {"force ripple", worst.force_ripple, "N"},
                                     {"rms acceleration", worst.tremble, "m/s^2"},
                                     {"over what fingers feel", worst.tremble / kFingerThreshold, "x"}};
  const std::string what = prefix + timing_label(at) + ": final peak-to-peak motion";
  const std::size_t first = rows.size();
  rows.push_back({"contact", what + ", p95", 1e3 * worst.ripple_p95, "mm", at.goal_p95, false,
                  "worst hand: " + worst.hand, true, related});
  if (!campaign.contact.haptics.contact.allow_unstable) {
    add_motion(rows.back(), campaign.contact);
    for (RelatedFigure& figure : in_impact(campaign.contact, quick)) rows.back().related.push_back(std::move(figure));
  }
  if (at.shows_5000) {
    const double displayed = min_displayed(outcomes) * softest(outcomes);
    rows.push_back({"contact", prefix + timing_label(at) + ": lowest displayed stiffness", displayed, "N/m",
                    0.95 * 5000.0, true, "all hands, at 4 to 30 N"});
  }
  rows.push_back({"contact", what + ", maximum", 1e3 * max_ripple, "mm", at.goal_max, false, "all hands"});
  if (at.wanted > 5000.0)
    rows.push_back({"contact", prefix + timing_label(at) + ": softened",
                    100.0 * softened_fraction(outcomes, campaign.runs), "% of the runs", 0.0, false, "all hands"});
  for (std::size_t i = first; i < rows.size(); ++i) rows[i].design = Design::wall;
}

// Hands of 0.02 to 2.5 kg, each in several contacts of 3 s.
BenchRow random_hand_row(const Setting& at, int hands) {
  constexpr int kRuns = 3;
  Campaign campaign = pushes(at, kRuns);
  campaign.contact.duration = 3.0;
  campaign.hands = random_hands(hands, 11);
  const std::vector<HandOutcome> outcomes = run_campaign(campaign);
  const auto trembles = [](const HandOutcome& outcome) { return outcome.ripple_max > kMaxRandomRipple; };
  const HandOutcome& worst = worst_ripple(outcomes);
  return answers_design(
      Design::wall, {"contact",
                     timing_label(at) + ": hands of 0.02 to 2.5 kg with a peak-to-peak motion above 0.15 mm after 3 s",
                     static_cast<double>(std::count_if(outcomes.begin(), outcomes.end(), trembles)),
                     "of " + std::to_string(hands),
                     0.0,
                     false,
                     "worst hand: " + worst.hand,
                     true,
                     {{"its motion", 1e3 * worst.ripple_max, "mm"},
                      {"softened", 100.0 * softened_fraction(outcomes, kRuns), "% of the runs"}}});
}

}  // namespace

std::vector<BenchRow> bench_contact(const BenchOptions& options) {
  // The first four settings must display 5000 N/m. At others, admit_tuning() limits the stiffness.
  const Setting settings[] = {{2000, 0, .04, .08, true}, {1000, 0, .06, .09, true}, {500, 0, .10, .12, true},
                              {1000, 1, .10, .12, true}, {4000, 0, .04, .08},       {1000, 2, .12, .3},
                              {1000, 3, .12, .3},        {1000, 4, .12, .3},        {1000, 8, .12, .3},
                              {500, 1, .12, .3},         {500, 2, .12, .3},         {250, 0, .12, .3},
                              {200, 0, .12, .3},         {100, 0, .12, .3}};
  constexpr double kCampaigns = 42.0;
  const int runs = options.quick ? 6 : 400;
  std::vector<BenchRow> rows;
  double done = 0.0;
  for (const Setting& at : settings) {
    if (options.progress) options.progress("contact", done++ / kCampaigns);
    add(rows, at, "", pushes(at, runs), options.quick);
    if (options.progress) options.progress("contact", done++ / kCampaigns);
    rows.push_back(random_hand_row(at, options.quick ? 20 : 200));
  }
  // Walls as stiff as the observer hold allows. The swing of the arm bounds them.
  for (const Setting& at : {Setting{1000, 1, .12, .3, false, 20e3}, Setting{2000, 2, .12, .3, false, 20e3},
                            Setting{2000, 3, .12, .3, false, 20e3}, Setting{4000, 8, .12, .3, false, 20e3}}) {
    if (options.progress) options.progress("contact", done++ / kCampaigns);
    add(rows, at, "20 kN/m wanted, ", pushes(at, runs), options.quick);
  }
  // A stick of 3 and 5 ms whose firmware renders part of the wall; {1000, 3} above is the former without springs.
  for (const auto& [delay, device_stiffness] :
       {std::pair{3, 400.0}, {3, 1000.0}, {3, 3000.0}, {5, 0.0}, {5, 400.0}, {5, 1000.0}, {5, 3000.0}}) {
    if (options.progress) options.progress("contact", done++ / kCampaigns);
    const Setting at{1000, delay, .12, .3};
    Campaign campaign = pushes(at, runs);
    campaign.contact.lever.device_wall_stiffness = device_stiffness;
    const std::string prefix = "device walls of " + std::to_string(static_cast<int>(device_stiffness)) + " N/m, ";
    add(rows, at, device_stiffness == 0.0 ? "" : prefix, campaign, options.quick);
  }
  // Devices that are unstable with a wall of 5000 N/m. The stability check is off, so only the reversal limiter acts. It
  // ignores a swing that dies away by itself, so these goals are wider. At 100 Hz an arm of 0.8 kg still swings by 0.41 mm
  // on the softened wall of 3750 N/m, at some 11 Hz: no rule on reversals tells that from a hand's tremor.
  for (const Setting& at : {Setting{100, 0, .4, .4}, Setting{200, 0, .4, .4}, Setting{1000, 3, .4, .4}}) {
    if (options.progress) options.progress("contact", done++ / kCampaigns);
    Campaign campaign = pushes(at, options.quick ? 2 : 100);
    campaign.contact.haptics.contact.allow_unstable = true;
    campaign.contact.haptics.contact.hold = haptics::ContactHold::half_sample;
    campaign.contact.duration = 4.0;
    add(rows, at, "unchecked 5000 N/m wall, reversal limiter only, ", campaign, options.quick);
  }
  return rows;
}

}  // namespace gearshift::lab
