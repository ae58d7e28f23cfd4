// The rig that measures walls, against the energy balance of the handle and the closed form of a spring that is sampled,
// held and late.
#include "app/lab/contact/contact_rig.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>

#include <doctest/doctest.h>

#include "app/lab/contact/contact_campaign.h"

using namespace gearshift::haptics;
using namespace gearshift::lab;

namespace {

// A textbook spring on a bare handle without damping and spring, so that the motors alone change its energy.
ContactCase spring_on_mass(double rate, int delay, double stiffness) {
  ContactCase contact;
  contact.haptics.rate = rate;
  contact.haptics.contact = {ContactHold::zero_order, EnergyControl::none, false, true};
  contact.haptics.tuning.wall_stiffness = stiffness;
  contact.haptics.tuning.wall_damping = 0.0;
  contact.haptics.tuning.aisle_damping = contact.haptics.tuning.limit_damping = 0.0;
  contact.haptics.guard.slew = 100.0;
  contact.lever.delay = delay;
  contact.lever.encoder_counts = 0.0;
  contact.lever.axis_x = {0.095, 0.0, 0.0};
  contact.push = 0.0;
  contact.duration = 0.3;
  return contact;
}

}  // namespace

TEST_CASE(
    "the energy of a contact is all that the motors did: restitution squared, less one, is its share of the impact") {
  for (const auto& [rate, delay] : {std::pair{1000.0, 0}, {1000.0, 3}, {500.0, 1}, {200.0, 0}, {100.0, 0}}) {
    CAPTURE(rate);
    CAPTURE(delay);
    for (const double phase : {0.0, 0.3, 0.8}) {
      ContactCase contact = spring_on_mass(rate, delay, 400.0);
      contact.phase = phase;
      const ContactResult one = run_contact(contact);
      REQUIRE(one.restitution > 0.5);
      CHECK(one.energy / one.impact == doctest::Approx(one.restitution * one.restitution - 1.0).epsilon(0.02));
    }
  }
}

TEST_CASE("on the shipped wall the energy lost is what restitution shows, less what the handle's damping takes") {
  int contacts = 0;
  for (const auto& [rate, delay] :
       {std::pair{2000.0, 0}, {1000.0, 0}, {1000.0, 2}, {1000.0, 3}, {500.0, 1}, {200.0, 0}}) {
    CAPTURE(rate);
    CAPTURE(delay);
    for (const double speed : {0.1, 0.5, 1.0}) {
      ContactCase contact;
      contact.haptics.rate = rate;
      contact.haptics.tuning.aisle_damping = contact.haptics.tuning.limit_damping = 0.0;
      contact.lever.delay = delay;
      contact.lever.axis_x = {0.095, 0.5, 0.0};  // it stores no energy, and the hand that moves it hardly works
      contact.push = 0.0;
      contact.speed = speed;
      contact.duration = 0.3;
      const ContactResult one = run_contact(contact);
      if (one.restitution == 0.0) continue;  // it stays in the wall
      const double kept = one.restitution * one.restitution;
      CHECK(std::abs((one.energy - one.damped) / one.impact - (kept - 1.0)) < 0.05);
      ++contacts;
    }
  }
  CHECK(contacts >= 12);
}

TEST_CASE("rate-hardness of a spring is K sin(w W) / (w W) in a window W of 5 ms, whatever the period") {
  constexpr double kStiffness = 400.0, kWindow = 0.005;
  const double angle = kWindow * std::sqrt(kStiffness / 0.095);
  for (const double rate : {4000.0, 1000.0, 500.0, 200.0}) {
    CAPTURE(rate);
    const double hardness = run_contact(spring_on_mass(rate, 0, kStiffness)).hardness;
    CHECK(hardness == doctest::Approx(kStiffness * std::sin(angle) / angle).epsilon(0.06));
  }
}

TEST_CASE("a pulse on entry makes a wall harder, and adds energy where forces are held long") {
  ContactCase contact;
  const ImpactEnergy plain = run_impacts(contact, 5);
  contact.pulse = 0.006;
  const ImpactEnergy fast = run_impacts(contact, 5);
  CHECK(fast.hardness > 1.3 * plain.hardness);
  CHECK(fast.worst_fraction < 0.0);
  contact.haptics.rate = 100.0;
  CHECK(run_impacts(contact, 5).worst_fraction > 0.0);
}

TEST_CASE("random hands differ in their contacts, and a seed determines them") {
  Campaign campaign;
  campaign.hands = {{"grip", kGripHand}, {"grip again", kGripHand}};
  campaign.runs = 2;
  const std::vector<HandOutcome> first = run_campaign(campaign), same = run_campaign(campaign);
  CHECK(first[0].peak != first[1].peak);
  CHECK(first[0].peak == same[0].peak);
  campaign.seed += 1;
  CHECK(run_campaign(campaign)[0].peak != first[0].peak);
}

TEST_CASE("dynamic stiffness of a sampled, held and late spring: K cos(w t) and -K sin(w t) / w, t = (delay + 1/2) T") {
  const double frequencies[] = {0.5, 2.0, 5.0, 10.0, 20.0};
  for (const auto& [rate, delay] : {std::pair{1000.0, 0}, {1000.0, 3}, {500.0, 2}, {200.0, 0}}) {
    CAPTURE(rate);
    CAPTURE(delay);
    ContactCase contact = spring_on_mass(rate, delay, 1000.0);
    contact.lever.axis_x = {0.095, 30.0, 500.0};  // damping keeps the late spring stable
    contact.lever.hand = kGripHand;
    for (const DynamicStiffness& found : dynamic_stiffness(contact, frequencies)) {
      CAPTURE(found.frequency);
      const double omega = 2.0 * std::numbers::pi * found.frequency, late = (delay + 0.5) / rate;
      const double held = std::sin(0.5 * omega / rate) / (0.5 * omega / rate);
      CHECK(found.stiffness == doctest::Approx(held * 1000.0 * std::cos(omega * late)).epsilon(0.01));
      CHECK(found.damping == doctest::Approx(-held * 1000.0 * std::sin(omega * late) / omega).epsilon(0.03));
    }
  }
}

TEST_CASE("weak motors and stiff walls: the swing stays within the motors' force, so Z is the closed form there, too") {
  const double frequencies[] = {2.0, 10.0};
  for (const auto& [force, stiffness] : {std::pair{8.0, 5000.0}, {31.7, 10000.0}, {3.0, 2000.0}}) {
    CAPTURE(force);
    CAPTURE(stiffness);
    ContactCase contact = spring_on_mass(1000.0, 0, stiffness);
    contact.lever.axis_x = {0.095, 30.0, 500.0};
    contact.lever.actuator.peak_force = contact.lever.actuator.continuous_force = force;
    contact.lever.hand = kGripHand;
    contact.lever.model_error = contact.lever.period_jitter = 0.05;  // of the device, not of Z
    for (const DynamicStiffness& found : dynamic_stiffness(contact, frequencies)) {
      CAPTURE(found.frequency);
      const double omega = 2.0 * std::numbers::pi * found.frequency, late = 0.0005;
      CHECK(found.stiffness == doctest::Approx(stiffness * std::cos(omega * late)).epsilon(0.01));
      CHECK(found.saturated == 0.0);
    }
  }
}

TEST_CASE("a push beyond the motors' force is reported: the lever is then past the wall and still") {
  Campaign campaign;
  campaign.contact.lever.actuator.peak_force = campaign.contact.lever.actuator.continuous_force = 8.0;
  campaign.hands = {{"grip", kGripHand}};
  campaign.runs = 5;
  campaign.min_push = campaign.max_push = 20.0;
  CHECK(run_campaign(campaign)[0].saturated == 5);
  campaign.min_push = campaign.max_push = 6.0;
  CHECK(run_campaign(campaign)[0].saturated == 0);
}

TEST_CASE("impacts are those of the plan: their speeds and place, without the device's errors") {
  ContactCase contact;
  const double usual = run_impacts(contact, 5).worst;
  contact.lever.model_error = contact.lever.period_jitter = 0.3;
  CHECK(run_impacts(contact, 5).worst == usual);
  ContactCase one = contact;  // a single impact by hand
  one.lever = {};
  one.haptics.tuning.aisle_damping = one.haptics.tuning.limit_damping = 0.0;
  one.push = 0.0;
  one.duration = 0.3;
  one.speed = 0.7;
  one.phase = 0.5;
  one.place = 0.4;
  const ImpactEnergy found = run_impacts(contact, 1, {{0.7}, 0.4});
  CHECK(found.worst == run_contact(one).energy);
  CHECK(found.hardness == run_contact(one).hardness);
  CHECK(found.hardness_speed == 0.7);
}

TEST_CASE("a wall of the device's springs, wholly or nearly, gives no impact energy") {
  for (const auto& [delay, springs, wanted] : {std::tuple{5, 3000.0, 3000.0},
                                               {5, 3000.0, 3200.0},
                                               {3, 3000.0, 3000.0},
                                               {3, 5000.0, 5350.0},
                                               {2, 5000.0, 5350.0},
                                               {8, 1000.0, 1000.0},
                                               {8, 1000.0, 1070.0},
                                               {8, 5000.0, 5800.0},
                                               {2, 1000.0, 1800.0}}) {
    CAPTURE(delay);
    CAPTURE(springs);
    CAPTURE(wanted);
    ContactCase contact;
    contact.lever.delay = delay;
    contact.lever.device_wall_stiffness = springs;
    contact.haptics.tuning.wall_stiffness = wanted;
    const ImpactEnergy impact = run_impacts(contact, 20);
    CHECK(impact.worst_fraction < 0.0);
    CHECK(impact.restitution < 0.85);
    contact.haptics.contact = {ContactHold::half_sample, EnergyControl::none, true, true};  // as the user wants it
    if (springs >= 3000.0 && delay >= 5) CHECK(run_impacts(contact, 20).worst_fraction > 0.05);
  }
}

TEST_CASE("no wall is softened that is admitted, however stiff: the arm's swing bounds it") {
  for (const auto& [rate, delay] :
       {std::pair{2000.0, 2}, {2000.0, 3}, {1500.0, 1}, {4000.0, 8}, {1000.0, 1}, {500.0, 0}}) {
    CAPTURE(rate);
    CAPTURE(delay);
    Campaign campaign;
    campaign.contact.haptics.rate = rate;
    campaign.contact.haptics.tuning.wall_stiffness = 20000.0;
    campaign.contact.lever.delay = delay;
    campaign.hands = {{"arm", kArmHand}, {"heavier", {1.46, 5.1, 273.0}}, {"heaviest", {2.5, 6.0, 250.0}}};
    campaign.runs = 20;
    const std::vector<HandOutcome> outcomes = run_campaign(campaign);
    for (const HandOutcome& outcome : outcomes) CHECK(outcome.softened == 0);
    // Never softer than what the half-sample hold may show.
    const AdmittedTuning admitted = admitted_wall(campaign.contact);
    const double tau = (delay + 1.0) / rate;
    CHECK(admitted.tuning.wall_stiffness >= 0.999 * std::min(0.25 * 0.086 / (tau * tau), 10000.0));
  }
  // Negative control: the observer hold as stiff as 0.58 m / tau^2 allows.
  Campaign wild;
  wild.contact.haptics.rate = 4000.0;
  wild.contact.haptics.contact = {ContactHold::observer, EnergyControl::none, true, true};
  wild.contact.haptics.tuning.wall_stiffness = 9252.0;
  wild.contact.haptics.tuning.wall_damping = 26.8;
  wild.contact.lever.delay = 8;
  wild.hands = {{"arm", kArmHand}};
  wild.runs = 5;
  CHECK(run_campaign(wild)[0].softened == 5);
}

namespace {

struct Quietness {
  double ripple_counts = 0.0, ripple = 0.0;  // [1] encoder counts; [m]
  double energy = 0.0;                       // [1] of the worst impact
  double softened = 0.0;                     // [1]
};
Quietness quietness(const ContactCase& contact) {
  Campaign campaign;
  campaign.contact = contact;
  campaign.runs = 12;
  const std::vector<HandOutcome> outcomes = run_campaign(campaign);
  const double count = contact.lever.yoke.radius * std::numbers::pi / 180.0 / contact.lever.encoder_counts;
  const double ripple = worst_ripple(outcomes).ripple_p95;
  return {ripple / count, ripple, run_impacts(contact, 12).worst_fraction, softened_fraction(outcomes, campaign.runs)};
}

struct Demand {
  const char* name;
  double rate;      // [Hz]
  int delay;        // [samples]
  double damping;   // [N s/m]
  double counts;    // [counts/deg]
  double slew;      // [N/cycle]
  const char* law;  // part of the sentence that the user sees
};
ContactCase demanded(const Demand& demand) {
  ContactCase contact;
  contact.haptics.rate = demand.rate;
  contact.haptics.tuning.wall_damping = demand.damping;
  contact.haptics.guard.slew = demand.slew;
  contact.lever.delay = demand.delay;
  contact.lever.encoder_counts = demand.counts;
  return contact;
}

}  // namespace

TEST_CASE("what is admitted is quiet: within 0.12 mm or 1.5 counts, no impact gains energy, nothing is softened") {
  constexpr double kPaper = 2250.0 / 80.0;
  const Demand demands[] = {{"buzz", 4000.0, 0, 100.0, kPaper, 25.0, "B <= 3 N T / q"},
                            {"coarse", 1000.0, 0, 10.0, 5.0, 25.0, "K <= m (0.1 m/s / (3 q))^2"},
                            {"coarse, 2", 1000.0, 2, 10.0, 5.0, 25.0, "K <= m (0.1 m/s / (3 q))^2"},
                            {"coarse, 8", 1000.0, 8, 10.0, 5.0, 25.0, "K <= 0.2 m / tau^2"},
                            {"coarse, slow", 500.0, 0, 10.0, 10.0, 25.0, "K <= m (0.1 m/s / (3 q))^2"},
                            {"coarse, slow, 1", 500.0, 1, 10.0, 10.0, 25.0, "K <= 0.2 m / tau^2"},
                            {"coarsest", 1000.0, 0, 10.0, 2.5, 25.0, "K <= m (0.1 m/s / (3 q))^2"},
                            {"slew", 1000.0, 0, 10.0, kPaper, 2.0, "K <= S / (T 1 m/s)"},
                            {"slew, slow", 500.0, 0, 10.0, kPaper, 4.0, "K <= S / (T 1 m/s)"},
                            {"slew, slower", 250.0, 0, 10.0, kPaper, 4.0, "K <= S / (T 1 m/s)"}};
  for (const Demand& demand : demands) {
    CAPTURE(demand.name);
    const ContactCase contact = demanded(demand);
    std::string laws;
    for (const TuningLimit& limit : admitted_wall(contact).limits) laws += describe(limit) + "; ";
    CHECK(laws.find(demand.law) != std::string::npos);
    const Quietness found = quietness(contact);
    CHECK((found.ripple <= 0.12e-3 || found.ripple_counts <= 1.5));
    CHECK(found.energy < 0.0);
    CHECK(found.softened == 0.0);
    ContactCase unlimited = contact;
    unlimited.haptics.contact.allow_unstable = true;
    const Quietness wild = quietness(unlimited);
    CHECK((wild.ripple > 1.5 * found.ripple || wild.energy > 0.0));
  }
}

TEST_CASE("whatever K and B are wanted, with any hold: within 0.12 mm, no impact gains energy, nothing is softened") {
  constexpr std::pair<double, int> kTimings[] = {{4000.0, 0}, {4000.0, 4}, {2000.0, 2}, {1000.0, 0}, {1000.0, 1},
                                                 {1000.0, 4}, {500.0, 0},  {500.0, 1},  {200.0, 0}};
  for (const auto& [rate, delay] : kTimings) {
    for (const ContactHold hold : {ContactHold::automatic, ContactHold::half_sample, ContactHold::zero_order}) {
      for (const auto& [stiffness, damping] : {std::pair{20e3, 0.0}, {20e3, 10.0}, {20e3, 100.0}, {2e3, 0.0}}) {
        CAPTURE(rate);
        CAPTURE(delay);
        CAPTURE(to_string(hold));
        CAPTURE(stiffness);
        CAPTURE(damping);
        ContactCase contact;
        contact.haptics.rate = rate;
        contact.haptics.contact.hold = hold;
        contact.haptics.tuning.wall_stiffness = stiffness;
        contact.haptics.tuning.wall_damping = damping;
        contact.lever.delay = delay;
        const Quietness found = quietness(contact);
        CHECK(found.ripple <= 0.12e-3);
        CHECK(found.energy < 0.0);
        CHECK(found.softened == 0.0);
      }
    }
  }
  // Negative controls: without damping, and two samples late at 2 kHz with K = 0.35 m / tau^2, a wall is not quiet.
  ContactCase bare;
  bare.haptics.contact.hold = ContactHold::half_sample;
  bare.haptics.contact.allow_unstable = true;
  bare.haptics.tuning.wall_damping = 0.0;
  CHECK(quietness(bare).energy > 0.1);
  ContactCase late = bare;
  late.haptics.rate = 2000.0;
  late.haptics.tuning.wall_stiffness = 13378.0;
  late.haptics.tuning.wall_damping = 5.0;
  late.lever.delay = 2;
  CHECK(quietness(late).ripple > 0.12e-3);
}

TEST_CASE("the wall's place within an encoder count matters: its ripple is not that of one place") {
  double least = 1.0, most = 0.0;
  for (const double place : {0.0, 0.2, 0.4, 0.6, 0.8}) {
    ContactCase contact;
    contact.place = place;
    const double ripple = run_contact(contact).ripple;
    least = std::min(least, ripple);
    most = std::max(most, ripple);
  }
  CHECK(most > 1.2 * least);
}
