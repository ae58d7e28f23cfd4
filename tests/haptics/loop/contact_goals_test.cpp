// Tests every contact goal of the design table (app/lab/bench/rows/design.h) with a sample of the cases of `gearshift
// bench`. Timing is not tested.
#include <algorithm>

#include <doctest/doctest.h>

#include "app/lab/bench/rows/bench.h"
#include "app/lab/contact/contact_campaign.h"
#include "tests/support/whole_campaign.h"

using namespace gearshift::haptics;
using namespace gearshift::lab;
using namespace gearshift::test;

namespace {

void check_rows(std::vector<BenchRow> (*family)(const BenchOptions&)) {
  BenchOptions options;
  options.gate_folder = GEARSHIFT_ASSETS "/gates";
  options.quick = true;
  int goals = 0;
  for (const BenchRow& row : family(options)) {
    INFO(row.name << ": " << row.value << ' ' << row.unit << ", " << row.note);
    CHECK(row.measured);
    CHECK(meets_goal(row));
    goals += row.goal.has_value();
  }
  CHECK(goals > 0);
}

}  // namespace

TEST_CASE("a 5000 N/m wall under 4 to 30 N: at rest, and as stiff as configured, at every rate and delay") {
  check_rows(bench_contact);
}

TEST_CASE("a wall generates no energy in an impact; with energy bounding never more than the damping dissipated") {
  check_rows(bench_energy);
}

TEST_CASE(
    "negative control of that goal: without bounding the same spring generates more than the damping dissipated, at "
    "500 Hz") {
  ContactCase contact;
  contact.haptics.rate = 500.0;
  contact.haptics.contact = {ContactHold::zero_order, EnergyControl::none, false, true};
  contact.haptics.tuning.wall_damping = 0.0;
  contact.haptics.guard.slew = 100.0;
  CHECK(run_impacts(contact, 40).surplus > 1e-3);
}

TEST_CASE("force delivered against a steady push, within 3 %") {
  check_rows(bench_delivered);
}

TEST_CASE("predicted stability boundary against simulated divergence, within 2 %") {
  check_rows(bench_boundary);
}

TEST_CASE("time from a fault to no force") {
  check_rows(bench_faults);
}

TEST_CASE("an impact on a textbook spring of 5000 N/m through the whole cycle agrees with an independent program") {
  ContactCase contact;
  contact.haptics.contact = {ContactHold::zero_order, EnergyControl::none, false, true};
  contact.haptics.tuning.wall_damping = 0.0;
  contact.haptics.guard.slew = 100.0;
  contact.lever.encoder_counts = 0.0;
  const struct { double rate, percent; } found[] = {{4000.0, 8.0}, {2000.0, 16.0}, {1000.0, 33.0}, {500.0, 74.0}};
  for (const auto& other : found) {
    contact.haptics.rate = other.rate;
    CHECK(100.0 * run_impacts(contact, is_full_campaign() ? 50 : 20).mean_fraction ==
          doctest::Approx(other.percent).epsilon(0.12));
  }
}

TEST_CASE("the observer holds 5000 N/m at 1 ms with two samples of delay, where the half-sample hold does not") {
  Campaign campaign;
  campaign.contact.lever.delay = 2;
  campaign.contact.haptics.contact.allow_unstable = true;
  campaign.contact.haptics.contact.reversal_limiter = false;
  campaign.runs = is_full_campaign() ? 40 : 16;
  campaign.contact.haptics.contact.hold = ContactHold::observer;
  campaign.contact.haptics.tuning.wall_damping = observed_damping(kPaperAxisY.mass, 0.003);
  const double observed = worst_ripple(run_campaign(campaign)).ripple_p95;
  campaign.contact.haptics.contact.hold = ContactHold::half_sample;
  campaign.contact.haptics.tuning.wall_damping = 10.0;
  const double sampled = worst_ripple(run_campaign(campaign)).ripple_p95;
  CHECK(observed < 0.12e-3);
  CHECK(sampled > 0.14e-3);
}

TEST_CASE("the observer at 5 ms, selected explicitly: 1995 N/m in every hand, the arm included") {
  Campaign campaign;
  campaign.contact.haptics.rate = 200.0;
  campaign.contact.haptics.contact.hold = ContactHold::observer;
  campaign.contact.duration = 2.0;
  campaign.runs = 60;
  const std::vector<HandOutcome> outcomes = run_campaign(campaign);
  CHECK(worst_ripple(outcomes).ripple_p95 < 0.13e-3);
  for (const HandOutcome& outcome : outcomes) CHECK(outcome.softest == doctest::Approx(0.58 * 0.086 / 25e-6));
}
