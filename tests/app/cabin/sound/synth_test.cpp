// The samples of the cabin's sounds, before playback.
#include "app/cabin/sound/synth.h"

#include <algorithm>
#include <numbers>

#include <doctest/doctest.h>

#include "app/cabin/sound/engine_synth.h"
#include "app/cabin/sound/noise.h"
#include "tests/engine/sound/measure.h"

using namespace gearshift::cabin;
using namespace gearshift::engine;
using namespace gearshift::test;

namespace {

// [1] The RMS level in each interval of 10 ms.
std::vector<double> envelope(const std::vector<float>& samples) {
  constexpr std::size_t kWindow = kSoundRate / 100;
  const std::vector<double> x = doubles(samples);
  std::vector<double> out;
  for (std::size_t n = 0; n + kWindow <= x.size(); n += kWindow) out.push_back(rms(std::span(x).subspan(n, kWindow)));
  return out;
}

std::vector<double> twice(const std::vector<float>& loop) {
  std::vector<double> out = doubles(loop);
  out.insert(out.end(), loop.begin(), loop.end());
  return out;
}

}  // namespace

TEST_CASE("every clip stays within full scale, is audible, and is the same in every call") {
  for (const auto make : {wall_knock, gear_in_click, gear_out_click, over_push_loop, saturation_loop}) {
    const std::vector<float> clip = make();
    CHECK(peak(doubles(clip)) <= 0.96);
    CHECK(peak(doubles(clip)) > 0.3);
    CHECK(clip == make());
  }
  for (std::size_t band = 0; band < kEngineBands.size(); ++band) {
    for (int cylinders = 1; cylinders <= 12; ++cylinders) {
      CAPTURE(band);
      CAPTURE(cylinders);
      CHECK(peak(doubles(engine_loop(cylinders, band, EngineLoad::full))) <= 1.0);
    }
    CHECK(engine_loop(4, band, EngineLoad::full) == engine_loop(4, band, EngineLoad::full));
  }
}

TEST_CASE("percussive clips begin at 0, are loudest in their first 30 ms and end at 0") {
  for (const auto make : {wall_knock, gear_in_click, gear_out_click}) {
    const std::vector<float> clip = make();
    const std::vector<double> levels = envelope(clip);
    CHECK(clip.front() == 0.0f);
    CHECK(std::abs(clip.back()) < 1e-6f);
    CHECK(std::max_element(levels.begin(), levels.end()) - levels.begin() < 3);
    CHECK(levels.back() < 0.02 * *std::max_element(levels.begin(), levels.end()));
  }
}

TEST_CASE("no loop clicks at its joint, and the measure would detect a click") {
  for (const auto make : {over_push_loop, saturation_loop}) CHECK(joint_roughness(make()) <= 1.0);
  for (std::size_t band = 0; band < kEngineBands.size(); ++band) {
    for (const EngineLoad load : {EngineLoad::coasting, EngineLoad::full}) {
      for (const int cylinders : {3, 4, 5, 6, 7, 8}) {
        std::vector<float> loop = engine_loop(cylinders, band, load);
        CAPTURE(band);
        CAPTURE(cylinders);
        CHECK(joint_roughness(loop) <= 1.0);
        if (cylinders != 4) continue;
        loop.resize(loop.size() - 1000);  // removes 0.42 of an engine cycle
        CHECK(joint_roughness(loop) > 1.5);
      }
    }
  }
}

TEST_CASE("an engine loop is a whole number of cycles, each of two crankshaft turns") {
  const std::vector<float> loop = engine_loop(4, 1, EngineLoad::full);
  const double cycle = 120.0 / kEngineLoopSpeed * kSoundRate;  // [samples]
  CHECK(std::fmod(static_cast<double>(loop.size()), cycle) == 0.0);
}

TEST_CASE("half orders are present, and at least 12 dB weaker than the firing frequency") {
  const std::vector<double> x = doubles(engine_loop(4, 2, EngineLoad::full));
  const double firing = amplitude_at(x, 80.0);  // [Hz] 2400 rpm / 60 * 4 cylinders / 2
  for (const double half : {20.0, 40.0, 60.0, 100.0}) {
    CHECK(decibels(amplitude_at(x, half) / firing) < -12.0);
    CHECK(decibels(amplitude_at(x, half) / firing) > -45.0);
  }
  // The orders are multiples of 20 Hz. Between them there is only noise.
  for (const double between : {50.0, 70.0, 90.0}) CHECK(decibels(amplitude_at(x, between) / firing) < -30.0);
}

TEST_CASE("every partial is at least as strong under full load as when coasting, and the high ones gain most") {
  for (std::size_t band = 0; band < kEngineBands.size(); ++band) {
    const std::vector<double> coasting = doubles(engine_loop(4, band, EngineLoad::coasting));
    const std::vector<double> full = doubles(engine_loop(4, band, EngineLoad::full));
    double last = 3.0;
    for (int harmonic = 1; harmonic <= 16; harmonic *= 2) {
      const double gain = decibels(amplitude_at(full, 80.0 * harmonic) / amplitude_at(coasting, 80.0 * harmonic));
      CHECK(gain > last - 0.5);
      last = gain;
    }
  }
}

TEST_CASE("no partial of an engine loop aliases at the highest pitch at which its band is audible") {
  const std::array<double, 4> fastest = {1800.0, 3400.0, 6000.0, 8000.0};
  for (std::size_t band = 0; band < kEngineBands.size(); ++band) {
    const Spectrum s = spectrum(doubles(engine_loop(4, band, EngineLoad::full)));
    const double limit = 0.5 * kSoundRate * kEngineLoopSpeed / fastest[band];
    CHECK(10.0 * std::log10(band_power(s, limit, 24000.0) / band_power(s, 0.0, 24000.0)) < -40.0);
  }
}

TEST_CASE(
    "bands cross-fade over the logarithm of the speed: gains sum to 1, two bands sound at most, one at a centre") {
  for (double speed = 0.0; speed < 9000.0; speed += 37.0) {
    const auto weights = band_weights(speed);
    double sum = 0.0;
    for (const double weight : weights) sum += weight;
    CHECK(sum == doctest::Approx(1.0));
    CHECK(std::count_if(weights.begin(), weights.end(), [](double weight) { return weight > 0.0; }) <= 2);
  }
  for (std::size_t band = 0; band < kEngineBands.size(); ++band) CHECK(band_weights(kEngineBands[band])[band] == 1.0);
  CHECK(band_weights(std::sqrt(kEngineBands[1] * kEngineBands[2]))[1] == doctest::Approx(0.5));
}

TEST_CASE("over-push is two tones in turn, without a pause, 2.5 times per second") {
  const std::vector<float> loop = over_push_loop();
  CHECK(static_cast<double>(loop.size()) / kSoundRate == doctest::Approx(1.0 / 2.5));
  const std::vector<double> x = doubles(loop);
  const std::size_t half = x.size() / 2;
  CHECK(strongest_line(std::span(x).first(half)) == doctest::Approx(kOverPushTones[0]).epsilon(1e-3));
  CHECK(strongest_line(std::span(x).subspan(half)) == doctest::Approx(kOverPushTones[1]).epsilon(1e-3));
  const std::vector<double> levels = envelope(loop);
  CHECK(*std::min_element(levels.begin(), levels.end()) > 0.6 * *std::max_element(levels.begin(), levels.end()));
}

TEST_CASE("saturation is three beeps of one tone within 0.3 s, then a pause") {
  const std::vector<double> levels = envelope(saturation_loop());
  int begins = 0;
  double silent = 0.0;
  for (std::size_t n = 0; n < levels.size(); ++n) {
    begins += levels[n] > 0.1 && (n == 0 || levels[n - 1] < 0.1);
    silent += levels[n] < 1e-6 ? 1.0 / static_cast<double>(levels.size()) : 0.0;
    if (n >= 30) CHECK(levels[n] == 0.0);
  }
  CHECK(begins == 3);
  CHECK(silent > 0.5);
  CHECK(strongest_line(twice(saturation_loop())) == doctest::Approx(kSaturationTone).epsilon(0.01));
}

TEST_CASE("the warnings have no tone in common") {
  const auto part = [](const std::vector<float>& loop, double tone) {
    const Spectrum s = spectrum(twice(loop));
    return 10.0 * std::log10(band_power(s, tone * 0.97, tone * 1.03) / band_power(s, 0.0, 24000.0));
  };
  for (const double tone : kOverPushTones) {
    CHECK(part(over_push_loop(), tone) > -4.0);
    CHECK(part(saturation_loop(), tone) < -40.0);
  }
  CHECK(part(saturation_loop(), kSaturationTone) > -4.0);
  CHECK(part(over_push_loop(), kSaturationTone) < -20.0);
}

TEST_CASE("noise is uniform with zero mean, and a filtered noise loop has no audible joint") {
  std::vector<float> x = looping_noise(48000, 5);
  double mean = 0.0;
  for (const float v : x) mean += v / 48000.0;
  CHECK(std::abs(mean) < 0.01);
  // The RMS of a uniform distribution from -1 to 1.
  CHECK(rms(doubles(x)) == doctest::Approx(1.0 / std::sqrt(3.0)).epsilon(0.01));
  CHECK(x != looping_noise(48000, 6));
  // Rotating a loop and then filtering it gives the same samples as filtering it and then rotating it.
  std::vector<float> turned = x;
  std::rotate(turned.begin(), turned.begin() + 12345, turned.end());
  loop_low_pass(x, 500.0);
  loop_low_pass(turned, 500.0);
  std::rotate(x.begin(), x.begin() + 12345, x.end());
  double furthest = 0.0;
  for (std::size_t n = 0; n < x.size(); ++n)
    furthest = std::max(furthest, std::abs(static_cast<double>(x[n] - turned[n])));
  CHECK(furthest < 1e-6);
}
