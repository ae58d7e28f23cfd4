// The chosen stiffness and damping of the observer hold beside their neighbours, at every timing.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "app/lab/bench/rows/bench.h"
#include "app/lab/contact/contact_campaign.h"
#include "haptics/contact/lever_observer.h"

namespace gearshift::lab {
namespace {

struct Timing {
  double rate;  // [Hz]
  int delay;    // [samples]
};
constexpr Timing kTimings[] = {{1000, 1}, {1000, 2}, {1000, 3}, {1000, 4}, {1000, 5}, {1000, 6}, {1000, 7},
                               {1000, 8}, {500, 1},  {500, 2},  {250, 0},  {200, 0},  {100, 0}};

// Factors on m / tau^2 and m / tau.
struct Point {
  double stiffness, damping;
  bool chosen = false;
};
constexpr Point kPoints[] = {{.58, .7, true}, {.62, .7}, {.66, .7}, {.58, .55}, {.58, .85}};

constexpr double kMaxStiffness = 5000.0;                                      // [N/m] the design's wall
constexpr double kFelt = 0.95;                                                // [1] of K in motion
constexpr double kMaxRipple = 0.12, kMaxHandRipple = 0.15;                    // [mm]
constexpr double kBand[] = {0.5, 1.0, 2.0, 3.0, 5.0, 7.0, 10.0, 14.0, 20.0};  // [Hz]

Campaign campaign_at(const Timing& at, const Point& point) {
  const double tau = (at.delay + 1.0) / at.rate, mass = haptics::kPaperAxisY.mass;
  Campaign campaign;
  haptics::HapticConfig& haptics = campaign.contact.haptics;
  haptics.rate = at.rate;
  haptics.contact.hold = haptics::ContactHold::observer;
  haptics.contact.allow_unstable = true;  // only reports the laws, so that other values than theirs can be tried
  haptics.tuning.wall_stiffness = std::min(kMaxStiffness, point.stiffness * mass / (tau * tau));
  haptics.tuning.wall_damping = point.damping * mass / tau;
  haptics.tuning.aisle_damping = std::min(haptics.tuning.aisle_damping, 0.35 * mass / tau);
  campaign.contact.lever.delay = at.delay;
  campaign.contact.duration = at.rate < 500.0 ? 2.0 : 1.2;
  return campaign;
}

// Fraction of the band, from its lowest frequency on, in which the moving hand feels at least kFelt of K.
double felt_band(const Campaign& campaign) {
  ContactCase contact = campaign.contact;
  contact.lever.hand = haptics::kGripHand;
  const double wanted = kFelt * contact.haptics.tuning.wall_stiffness;
  const auto found = dynamic_stiffness(contact, kBand);
  const auto is_felt = [&](const DynamicStiffness& one) { return one.stiffness >= wanted; };
  const auto end = std::find_if_not(found.begin(), found.end(), is_felt);
  return static_cast<double>(end - found.begin()) / static_cast<double>(found.size());
}

BenchRow search_row(const Timing& at, const Point& point, Campaign campaign, bool quick) {
  campaign.runs = quick ? 5 : 150;
  const std::vector<HandOutcome> outcomes = run_campaign(campaign);
  const double ripple = 1e3 * worst_ripple(outcomes).ripple_p95, softened = softened_fraction(outcomes, campaign.runs);
  Campaign with_random_hands = campaign;
  with_random_hands.runs = quick ? 1 : 3;
  with_random_hands.contact.duration = 3.0;
  with_random_hands.hands = random_hands(quick ? 10 : 200, 11);  // as in the family contact
  double widest = 0.0;
  for (const HandOutcome& outcome : run_campaign(with_random_hands))
    widest = std::max(widest, 1e3 * outcome.ripple_max);
  const double energy = run_impacts(campaign.contact, quick ? 3 : 20).worst_fraction, band = felt_band(campaign);

  std::string broken;
  const auto require = [&](bool holds, const char* what) {
    broken += holds ? "" : broken.empty() ? what : std::string(", ") + what;
  };
  require(ripple <= kMaxRipple, "ripple");
  require(widest <= kMaxHandRipple, "a random hand");
  require(energy <= 0.0, "energy");
  require(softened == 0.0, "softened");
  const double stiffness = campaign.contact.haptics.tuning.wall_stiffness;
  const std::string timing = fmt::format("{:g} Hz{}", at.rate, at.delay > 0 ? fmt::format(", delay {}", at.delay) : "");
  const std::string factors = fmt::format("K {:g} m/tau^2, B {:g} m/tau", point.stiffness, point.damping);
  BenchRow row{"search",
               timing + ": " + factors + (point.chosen ? " (chosen)" : ""),
               stiffness * band,
               "N/m",
               {},
               true,
               broken.empty() ? "within all bounds" : "breaks: " + broken,
               true,
               {{"K", stiffness, "N/m"},
                {"fraction of the band 0.5 to 20 Hz with Re Z >= 0.95 K", band, ""},
                {"p95", ripple, "mm"},
                {"widest of the random hands", widest, "mm"},
                {"worst impact's energy", 100.0 * energy, "%"},
                {"softened", 100.0 * softened, "% of the runs"}}};
  row.trade = {timing,
               factors,
               {"K not felt in the band", kMaxStiffness - stiffness * band, "N/m"},
               {"p95", ripple, "mm"},
               point.chosen};
  return row;
}

}  // namespace

std::vector<BenchRow> bench_search(const BenchOptions& options) {
  std::vector<BenchRow> rows;
  const double all = static_cast<double>(std::size(kTimings) * std::size(kPoints));
  for (const Timing& at : kTimings)
    for (const Point& point : kPoints) {
      const Campaign campaign = campaign_at(at, point);
      const haptics::HapticTuning& tuning = campaign.contact.haptics.tuning;
      const bool is_known = point.stiffness > kPoints[0].stiffness && tuning.wall_stiffness == kMaxStiffness;
      if (is_known) continue;  // the same wall as with the chosen values, which reach it, too
      if (options.progress) options.progress("search", static_cast<double>(rows.size()) / all);
      rows.push_back(search_row(at, point, campaign, options.quick));
    }
  return rows;
}

}  // namespace gearshift::lab
