// A wall of 5000 N/m under a push of 20 N with the shipped default configuration, at several rates and delays.
#include <algorithm>
#include <cmath>
#include <string>

#include "app/lab/bench/lever/contact_campaign.h"
#include "app/lab/bench/rows/bench.h"

namespace gearshift::lab {
namespace {

struct Setting {
  double rate;                // [Hz]
  int delay;                  // [samples]
  double goal_p95, goal_max;  // [mm]
  bool shows_5000 = false;    // the wall must display its full stiffness of 5000 N/m
};

std::string timing_label(const Setting& at) {
  std::string text = std::to_string(static_cast<int>(at.rate)) + " Hz";
  return at.delay == 0 ? text : text + ", delay " + std::to_string(at.delay);
}

Campaign push_of_20(const Setting& at, int runs) {
  Campaign campaign;
  campaign.contact.haptics.rate = at.rate;
  campaign.contact.lever.delay = at.delay;
  campaign.contact.duration = at.rate < 500.0 ? 2.0 : 1.2;
  campaign.runs = runs;
  return campaign;
}

void add(std::vector<BenchRow>& rows, const Setting& at, const std::string& prefix,
         const std::vector<HandOutcome>& outcomes) {
  const HandOutcome& worst = worst_ripple(outcomes);
  double max_ripple = 0.0;
  for (const HandOutcome& outcome : outcomes) max_ripple = std::max(max_ripple, outcome.ripple_max);
  double softest = 1e9;
  for (const HandOutcome& outcome : outcomes) softest = std::min(softest, outcome.softest);
  const std::vector<RelatedFigure> related{{"lowest stiffness in use", softest, "N/m"},
                                           {"displayed", 100.0 * min_displayed(outcomes), "%"},
                                           {"deepest", 1e3 * deepest(outcomes), "mm"},
                                           {"force ripple", worst.force_ripple, "N"}};
  const std::string what = prefix + timing_label(at) + ": final peak-to-peak motion";
  const std::size_t first = rows.size();
  rows.push_back({"contact", what + ", p95", 1e3 * worst.ripple_p95, "mm", at.goal_p95, false,
                  "worst hand: " + worst.hand, true, related});
  if (at.shows_5000) {
    const double displayed = min_displayed(outcomes) * softest;
    rows.push_back({"contact", prefix + timing_label(at) + ": lowest displayed stiffness", displayed, "N/m",
                    0.97 * 5000.0, true, "all hands, at 20 N"});
  }
  rows.push_back({"contact", what + ", maximum", 1e3 * max_ripple, "mm", at.goal_max, false, "all hands"});
  for (std::size_t i = first; i < rows.size(); ++i) rows[i].design = Design::wall;
}

}  // namespace

std::vector<BenchRow> bench_contact(const BenchOptions& options) {
  // The first four settings must display 5000 N/m. The fifth, 4000 Hz, has no such goal. At the others, admit_tuning()
  // limits the stiffness.
  const Setting settings[] = {{2000, 0, .02, .04, true}, {1000, 0, .04, .08, true}, {500, 0, .10, .11, true},
                              {1000, 1, .10, .11, true}, {4000, 0, .02, .04},       {1000, 2, .12, .3},
                              {1000, 3, .12, .3},        {1000, 4, .12, .3},        {500, 1, .12, .3},
                              {200, 0, .12, .3},         {100, 0, .12, .3}};
  constexpr double kCampaigns = 17.0;
  const int runs = options.quick ? 6 : 400;
  std::vector<BenchRow> rows;
  double done = 0.0;
  for (const Setting& at : settings) {
    if (options.progress) options.progress("contact", done++ / kCampaigns);
    add(rows, at, "", run_campaign(push_of_20(at, runs)));
  }
  // A stick whose firmware renders part of the wall. Setting {1000, 3} above is the same stick without device walls.
  for (const double device_stiffness : {400.0, 1000.0, 3000.0}) {
    if (options.progress) options.progress("contact", done++ / kCampaigns);
    const Setting at{1000, 3, .12, .3};
    Campaign campaign = push_of_20(at, runs);
    campaign.contact.lever.device_wall_stiffness = device_stiffness;
    add(rows, at, "device walls of " + std::to_string(static_cast<int>(device_stiffness)) + " N/m, ",
        run_campaign(campaign));
  }
  // Devices that are unstable with a wall of 5000 N/m. The stability check is off, so only the reversal limiter acts.
  for (const Setting& at : {Setting{100, 0, .3, .3}, Setting{200, 0, .3, .3}, Setting{1000, 3, .3, .3}}) {
    if (options.progress) options.progress("contact", done++ / kCampaigns);
    Campaign campaign = push_of_20(at, options.quick ? 2 : 100);
    campaign.contact.haptics.contact.allow_unstable = true;
    campaign.contact.haptics.contact.hold = haptics::ContactHold::half_sample;
    campaign.contact.duration = 4.0;
    add(rows, at, "unchecked 5000 N/m wall, reversal limiter only, ", run_campaign(campaign));
  }
  return rows;
}

}  // namespace gearshift::lab
