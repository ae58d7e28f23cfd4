// The rig that measures walls, against the energy balance of the handle and the closed form of a spring that is sampled,
// held and late.
#include "app/lab/contact/contact_rig.h"

#include <algorithm>
#include <cmath>
#include <numbers>

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
