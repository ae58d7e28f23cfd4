// The samples of the driveline's sounds, before playback.
#include "app/cabin/sound/car_synth.h"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "app/cabin/sound/car_voices.h"
#include "app/cabin/sound/synth.h"
#include "tests/engine/sound/measure.h"

using namespace gearshift::cabin;
using namespace gearshift::engine;
using namespace gearshift::test;

namespace {

std::vector<double> rounds(const std::vector<float>& loop, int count) {
  std::vector<double> out;
  for (int i = 0; i < count; ++i) out.insert(out.end(), loop.begin(), loop.end());
  return out;
}

// [1] The modulation depth at `frequency` [Hz]: the line in the spectrum of the signal's power, divided by the mean
// power.
double modulation(std::vector<double> x, double frequency) {
  for (double& v : x) v = v * v;
  double mean = 0.0;
  for (const double v : x) mean += v / static_cast<double>(x.size());
  return amplitude_at(x, frequency) / mean;
}

}  // namespace

TEST_CASE("every driveline clip stays within full scale, is audible, and is the same in every call") {
  for (const auto make : {grind_loop, starter_loop, judder_loop, limiter_loop, over_rev_loop, stall_chime}) {
    const std::vector<float> clip = make();
    CHECK(peak(doubles(clip)) <= 0.96);
    CHECK(peak(doubles(clip)) > 0.3);
    CHECK(clip == make());
  }
}

TEST_CASE("no driveline loop clicks at its joint") {
  for (const auto make : {grind_loop, starter_loop, judder_loop, limiter_loop, over_rev_loop})
    CHECK(joint_roughness(make()) <= 1.0);
  std::vector<float> cut = judder_loop();
  cut.resize(cut.size() - 1000);  // removes 1.25 periods of the tone
  CHECK(joint_roughness(cut) > 1.5);
}

TEST_CASE("each loop is modulated at the rate of its law, and not at others") {
  struct Beats {
    std::vector<float> (*make)();
    double rate;  // [Hz]
  };
  for (const Beats& beats : {Beats{grind_loop, 150.0},                 // teeth
                             Beats{starter_loop, 240.0 / 60.0 * 2.0},  // four cylinders: two compressions per turn
                             Beats{judder_loop, 400.0 / 60.0 * 2.0},   // firings
                             Beats{limiter_loop, 12.0}, Beats{over_rev_loop, 4.0}}) {
    const std::vector<double> x = rounds(beats.make(), 8);
    const double rate = beats.rate;
    CAPTURE(rate);
    CHECK(modulation(x, rate) > 0.25);
    CHECK(modulation(x, rate) > 4.0 * modulation(x, 0.73 * rate));
    CHECK(modulation(x, rate) > 4.0 * modulation(x, 1.31 * rate));
  }
}

TEST_CASE(
    "the starter whines with its ring's teeth, 520 Hz at 240 rpm; the stall drones at 60 Hz; over-rev is 900 Hz") {
  CHECK(strongest_line(rounds(starter_loop(), 2)) == doctest::Approx(520.0).epsilon(1e-3));
  CHECK(strongest_line(rounds(judder_loop(), 2)) == doctest::Approx(60.0).epsilon(1e-3));
  const std::vector<float> over_rev = over_rev_loop();
  CHECK(strongest_line(doubles(std::vector<float>(over_rev.begin(), over_rev.begin() + 6000))) ==
        doctest::Approx(900.0).epsilon(2e-3));
}

TEST_CASE("over-rev has no tone in common with the lever's warnings") {
  const auto part = [](const std::vector<float>& loop, double tone) {
    const Spectrum s = spectrum(rounds(loop, 4));
    return 10.0 * std::log10(band_power(s, tone * 0.97, tone * 1.03) / band_power(s, 0.0, 24000.0));
  };
  CHECK(part(over_rev_loop(), kOverRevTone) > -4.0);
  for (const double tone : {kOverPushTones[0], kOverPushTones[1], kSaturationTone})
    CHECK(part(over_rev_loop(), tone) < -30.0);
  CHECK(part(over_push_loop(), kOverRevTone) < -30.0);
  CHECK(part(saturation_loop(), kOverRevTone) < -30.0);
}

TEST_CASE("the chime is a bell followed by a lower bell, and ends at 0") {
  const std::vector<double> x = doubles(stall_chime());
  const std::size_t apart = kSoundRate * 22 / 100;
  CHECK(strongest_line(std::span(x).first(apart)) == doctest::Approx(kStallTones[0]).epsilon(0.01));
  CHECK(strongest_line(std::span(x).subspan(x.size() / 2)) == doctest::Approx(kStallTones[1]).epsilon(0.01));
  CHECK(kStallTones[1] < kStallTones[0]);
  CHECK(std::abs(x.back()) < 1e-6);
  CHECK(x.front() == 0.0);
}

TEST_CASE(
    "tooth_pass_rate() is |difference| z / (2 pi); a grind is always audible and grows with the root of its power") {
  // A gear with 36 teeth at one revolution per second.
  CHECK(tooth_pass_rate(2.0 * 3.14159265358979, 36.0) == doctest::Approx(36.0));
  CHECK(tooth_pass_rate(-20.0, 40.0) == doctest::Approx(127.32).epsilon(1e-4));
  CHECK(grind_gain(0.0) == 0.32);
  CHECK(grind_gain(25.0) == doctest::Approx(0.41));  // a quarter of 100 W gives half of the gain's range
  CHECK(grind_gain(100.0) == doctest::Approx(0.5));
  CHECK(grind_gain(1e9) == doctest::Approx(0.5));
}
