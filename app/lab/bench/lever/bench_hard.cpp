// Hard cases: many rates and delays, pushes beyond the motors' force, coarse encoders, jitter, and walls below, at and
// above the stability limit.
#include <algorithm>
#include <cmath>
#include <string>

#include "app/lab/bench/lever/wall_growth.h"
#include "app/lab/bench/rows/bench.h"
#include "app/lab/contact/contact_campaign.h"
#include "haptics/analysis/sampled_loop.h"

namespace gearshift::lab {
namespace {

std::string timing_label(double rate, int delay) {
  return std::to_string(static_cast<int>(rate)) + " Hz, delay " + std::to_string(delay);
}

// Measures the shipped default configuration at one rate and delay with all named hands: impacts at 0.1 to 1 m/s,
// followed by pushes of 5, 20 and 60 N.
void add_default(std::vector<BenchRow>& rows, double rate, int delay, bool quick) {
  double ripple = 0.0, ripple60 = 0.0, stiffness = 1e9;
  std::string hand = "bare";
  for (const double push : {5.0, 20.0, 60.0}) {
    for (const double speed : {0.1, 0.3, 0.5, 1.0}) {
      if (quick && (push < 20.0 || (speed != 0.3 && speed != 1.0))) continue;
      Campaign campaign;
      campaign.contact.haptics.rate = rate;
      campaign.contact.lever.delay = delay;
      campaign.min_push = campaign.max_push = push;
      campaign.contact.duration = 2.5;
      campaign.slowest = campaign.fastest = speed;
      campaign.runs = quick ? 1 : 5;
      const std::vector<HandOutcome> outcomes = run_campaign(campaign);
      const HandOutcome& worst = worst_ripple(outcomes);
      for (const HandOutcome& outcome : outcomes) stiffness = std::min(stiffness, outcome.softest);
      if (push == 60.0) ripple60 = std::max(ripple60, worst.ripple_p95);
      if (push < 60.0 && worst.ripple_p95 > ripple) ripple = worst.ripple_p95, hand = worst.hand;
    }
  }
  rows.push_back({"hard",
                  "default, " + timing_label(rate, delay) + ": final peak-to-peak motion",
                  1e3 * ripple,
                  "mm",
                  0.3,
                  false,
                  (quick ? "impacts at 0.3 and 1 m/s, push of 20 N, every hand; worst hand: "
                         : "impacts at 0.1 to 1 m/s, pushes of 5 and 20 N, every hand; worst hand: ") +
                      hand,
                  true,
                  {{"K in use", stiffness, "N/m"},
                   {"motion under a push of 60 N, which exceeds the motors' force", 1e3 * ripple60, "mm"}}});
}

void add_uncertain(std::vector<BenchRow>& rows, const std::string& what, double counts, double jitter, double error,
                   bool quick) {
  Campaign campaign;
  campaign.contact.lever.encoder_counts = counts;
  campaign.period_jitter = jitter;
  campaign.model_error = error;
  campaign.runs = quick ? 5 : 100;
  const std::vector<HandOutcome> outcomes = run_campaign(campaign);
  const HandOutcome& worst = worst_ripple(outcomes);
  rows.push_back({"hard",
                  "default, 1 kHz, " + what + ": final peak-to-peak motion, p95",
                  1e3 * worst.ripple_p95,
                  "mm",
                  {},
                  false,
                  "pushes of 4 to 30 N; worst hand: " + worst.hand,
                  true,
                  {{"K in use", worst.softest, "N/m"}, {"stopped by the guard", 1.0 * worst.stopped, "runs"}}});
}

// Tests walls near the stability limit. admit_tuning() must reduce a wall above the limit. If such a wall is rendered
// anyway, a disturbance must grow at the predicted rate; below the limit it must decay at the predicted rate.
void add_limit(std::vector<BenchRow>& rows, haptics::ContactHold hold, const std::string& name, double rate, int delay,
               const haptics::NamedHand& named = haptics::kNamedHands[0]) {
  const double period = 1.0 / rate;
  haptics::ContactLaw law{hold, 0.0, 5.0 * std::min(1.0, rate / 1000.0), 1, 0.0, 0.004, delay};
  const double limit = haptics::stiffness_limit(haptics::kPaperAxisX, named.hand, law, period);
  haptics::HapticConfig config;
  config.rate = rate;
  config.contact.hold = hold;
  config.tuning.wall_stiffness = std::min(20000.0, 1.02 * limit);
  config.tuning.wall_damping = law.damping;
  config.tuning.aisle_damping = 0.0;
  haptics::DeviceSpec spec;
  spec.delay = delay;
  spec.axis_y = spec.axis_x;
  const double admitted = haptics::admit_tuning(config, spec, 0.0).tuning.wall_stiffness;
  double worst = admitted < limit ? 0.0 : 1.0;  // 1 if the check admitted a wall above the limit, which fails the row
  std::vector<RelatedFigure> related{{"exact limit", limit, "N/m"},
                                     {"accepted when 1.02 times the limit is requested", admitted, "N/m"}};
  for (const double fraction : {0.5, 0.98, 1.02}) {
    law.stiffness = fraction * limit;
    const double predicted = haptics::spectral_radius(haptics::kPaperAxisX, named.hand, law, period);
    const double simulated = simulated_growth(haptics::kPaperAxisX, named.hand, law, period, 0.2 * limit);
    const std::string at = std::to_string(static_cast<int>(std::lround(100.0 * fraction))) + " %";
    related.push_back({"growth at " + at, simulated, "per cycle"});
    related.push_back({"predicted growth at " + at, predicted, ""});
    if (fraction > 0.9) worst = std::max(worst, std::abs(simulated - predicted));
    if ((simulated < 1.0) != (fraction < 1.0)) worst = 1.0;
  }
  rows.push_back({"hard", name + ", " + timing_label(rate, delay) + ": error in growth rate near the limit", worst,
                  "per cycle", 0.002, false, "converges below the limit and diverges above it, as predicted", true,
                  related});
}

}  // namespace

std::vector<BenchRow> bench_hard(const BenchOptions& options) {
  std::vector<BenchRow> rows;
  for (const double rate : {100.0, 250.0, 500.0, 1000.0, 2000.0, 4000.0}) {
    for (int delay = 0; delay <= 4; ++delay) {
      if (options.progress) options.progress("hard", static_cast<double>(rows.size()) / 45.0);
      add_default(rows, rate, delay, options.quick);
    }
  }
  add_uncertain(rows, "no quantisation", 0.0, 0.1, 0.05, options.quick);
  add_uncertain(rows, "encoder counts of 298 um", 2250.0 / 80.0 / 4.0, 0.1, 0.05, options.quick);
  add_uncertain(rows, "jitter 30 %", 2250.0 / 80.0, 0.3, 0.05, options.quick);
  add_uncertain(rows, "jitter 50 %", 2250.0 / 80.0, 0.5, 0.05, options.quick);
  add_uncertain(rows, "plant model error 20 %", 2250.0 / 80.0, 0.1, 0.2, options.quick);
  for (const auto& [rate, delay] : {std::pair{1000.0, 0}, {1000.0, 1}, {200.0, 0}, {100.0, 0}}) {
    add_limit(rows, haptics::ContactHold::zero_order, "textbook wall", rate, delay);
    add_limit(rows, haptics::ContactHold::half_sample, "half-sample hold", rate, delay);
  }
  add_limit(rows, haptics::ContactHold::observer, "observer, light hand", 1000.0, 3, haptics::kNamedHands[1]);
  add_limit(rows, haptics::ContactHold::observer, "observer, arm", 1000.0, 2, haptics::kNamedHands[3]);
  return rows;
}

}  // namespace gearshift::lab
