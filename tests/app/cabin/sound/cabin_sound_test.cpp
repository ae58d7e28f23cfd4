// The sounds that the driver hears, rendered to memory and measured at the ears.
#include "app/cabin/sound/cabin_sound.h"

#include <array>
#include <numbers>
#include <optional>

#include <doctest/doctest.h>

#include "app/cabin/sound/synth.h"
#include "tests/app/cabin/sound/cabin.h"

using namespace gearshift::cabin;
using namespace gearshift::engine;
using namespace gearshift::haptics;
using namespace gearshift::test;
using namespace gearshift::vehicle;

namespace {

// The engine's sound at `speed` [rpm] and `load` [1], `seconds` [s] long.
std::vector<float> engine_sound(Cabin& cabin, double speed, double load, double seconds = 1.0) {
  cabin.car = running(speed, load);
  cabin.run(0.1);
  return cabin.run(seconds);
}

double knock_peak(Cabin& cabin, double impact_speed) {
  cabin.on_event(EventKind::wall_contact, impact_speed);
  return peak(doubles(cabin.run(0.3)));
}

struct OctaveBand {
  double low, high;  // [Hz]
};
constexpr std::array<OctaveBand, 4> kOctaves = {{{354.0, 707.0}, {707.0, 1414.0}, {1414.0, 2828.0}, {2828.0, 5657.0}}};

// Power in each octave band, at each ear.
using OctavePowers = std::array<std::array<double, std::size(kOctaves)>, 2>;

OctavePowers octave_powers(std::span<const float> signal) {
  OctavePowers powers{};
  for (const Ear ear : {Ear::left, Ear::right}) {
    const Spectrum found = spectrum(channel(signal, ear));
    for (std::size_t i = 0; i < std::size(kOctaves); ++i)
      powers[ear == Ear::left ? 0 : 1][i] = band_power(found, kOctaves[i].low, kOctaves[i].high);
  }
  return powers;
}

// [dB] The signal-to-noise ratio in the best octave band, at the ear with the lower ratio.
double best_octave(const OctavePowers& signal, const OctavePowers& noise) {
  double worse_ear = 1e9;
  for (std::size_t ear = 0; ear < 2; ++ear) {
    double best = -1e9;
    for (std::size_t i = 0; i < std::size(kOctaves); ++i)
      best = std::max(best, 10.0 * std::log10(signal[ear][i] / noise[ear][i]));
    worse_ear = std::min(worse_ear, best);
  }
  return worse_ear;
}

}  // namespace

TEST_CASE(
    "with the engine off and no events the output is exactly 0, for any loaded sounds and any position of the head") {
  Cabin cabin;
  CHECK(peak(doubles(cabin.run(0.5))) == 0.0);
  cabin.ears = look_at({0.3, 0.9, 0.2}, {1.0, 0.0, 0.0});
  CHECK(peak(doubles(cabin.run(0.5))) == 0.0);
  for (const EventKind kind :
       {EventKind::over_push_end, EventKind::saturation_end, EventKind::guard_changed, EventKind::stiffness_lowered}) {
    cabin.on_event(kind, 1.0);
  }
  cabin.lever.flags = kFlagContact | kFlagGhost | kFlagFresh | kFlagPushEstimated;
  CHECK(peak(doubles(cabin.run(0.5))) == 0.0);
  cabin.car = running(3000.0, 1.0);
  CHECK(level(cabin.run(0.5)) > 0.003);
  cabin.car = VehicleState{};  // the engine is off again
  cabin.run(0.1);
  CHECK(peak(doubles(cabin.run(0.5))) == 0.0);
}

TEST_CASE("the engine's strongest line is its firing frequency, n / 60 * cylinders / 2, within 0.5 %") {
  double worst = 0.0;
  Cabin four;
  for (const double load : {0.0, 0.4, 1.0}) {
    // [rpm] near the speeds of kEngineBands and between them.
    for (double speed = 800.0; speed <= 6500.0; speed *= 1.17) {
      const double firing = speed / 60.0 * 4.0 / 2.0;
      const double hertz = strongest_line(left(engine_sound(four, speed, load, 2.0)));
      CAPTURE(speed);
      CAPTURE(load);
      CHECK(hertz == doctest::Approx(firing).epsilon(0.005));
      worst = std::max(worst, std::abs(hertz / firing - 1.0));
    }
  }
  for (const int cylinders : {3, 5, 6, 8}) {
    Cabin cabin({.cylinders = cylinders});
    for (const double speed : {850.0, 1300.0, 2500.0, 4600.0, 6500.0}) {
      const double firing = speed / 60.0 * cylinders / 2.0;
      const double hertz = strongest_line(left(engine_sound(cabin, speed, 1.0, 2.0)));
      CAPTURE(cylinders);
      CAPTURE(speed);
      CHECK(hertz == doctest::Approx(firing).epsilon(0.005));
      worst = std::max(worst, std::abs(hertz / firing - 1.0));
    }
  }
  MESSAGE("worst pitch error " << 100.0 * worst << " %");
}

TEST_CASE("between two bands their loops stay in phase: the level is steady, and lies between the two bands' levels") {
  for (const auto& [low, high] : {std::array{900.0, 1800.0}, {1800.0, 3400.0}, {3400.0, 6000.0}}) {
    const double middle = std::sqrt(low * high);
    Cabin cabin;
    const std::vector<float> stereo = engine_sound(cabin, middle, 1.0, 6.0);
    double softest = 1e9, loudest = 0.0;
    constexpr std::size_t kSecond = std::size_t{2} * kSoundRate;
    for (std::size_t n = 0; n < 6; ++n) {
      const double second = level(std::span(stereo).subspan(n * kSecond, kSecond));
      softest = std::min(softest, second);
      loudest = std::max(loudest, second);
    }
    CAPTURE(middle);
    CHECK(decibels(loudest / softest) < 0.5);
    CHECK(level(stereo) > level(engine_sound(cabin, low, 1.0)));
    CHECK(level(stereo) < level(engine_sound(cabin, high, 1.0)));
  }
}

TEST_CASE("loudness rises with load at every speed, by 10 to 16 dB from coasting to full load, and rises with speed") {
  double last_full = 0.0;
  Cabin cabin;
  for (const double speed : {800.0, 1300.0, 1800.0, 2500.0, 3400.0, 4500.0, 6500.0}) {
    CAPTURE(speed);
    const double coasting = level(engine_sound(cabin, speed, 0.0));
    double last = coasting;
    for (const double load : {0.1, 0.25, 0.5, 0.75, 1.0}) {
      const double now = level(engine_sound(cabin, speed, load));
      CHECK(now > last);
      last = now;
    }
    CHECK(decibels(last / coasting) > 10.0);
    CHECK(decibels(last / coasting) < 16.0);
    CHECK(last > last_full);
    last_full = last;
  }
}

TEST_CASE("a sweep of speed and load has no click: the wave bends no more sharply than at constant speed") {
  const auto sharpest = [](std::span<const float> stereo) {
    const std::vector<double> x = left(stereo);
    double bend = 0.0;
    for (std::size_t n = 2; n < x.size(); ++n) bend = std::max(bend, std::abs(x[n] - 2.0 * x[n - 1] + x[n - 2]));
    return bend;
  };
  Cabin cabin;
  const double steady = sharpest(engine_sound(cabin, 6500.0, 1.0, 4.0));
  cabin.car = running(800.0, 1.0);
  cabin.run(0.1);
  double swept = 0.0;
  for (int frame = 0; frame < 240; ++frame) {
    cabin.car = running(800.0 + 5700.0 * frame / 240.0, frame % 40 < 20 ? 1.0 : 0.0);
    swept = std::max(swept, sharpest(cabin.run(kFrame)));
  }
  CHECK(swept < 1.1 * steady);
}

TEST_CASE("half the volume makes the engine 6.02 dB quieter") {
  const auto engine_level = [](const CabinSoundConfig& config) {
    Cabin cabin(config);
    return level(engine_sound(cabin, 3000.0, 0.5));
  };
  const double full = engine_level({.volume = 1.0f});
  for (const float volume : {0.5f, 0.25f, 0.1f}) {
    CHECK(decibels(engine_level({.volume = volume}) / full) == doctest::Approx(decibels(volume)).epsilon(1e-3));
  }
  CHECK(engine_level({.volume = 0.0f}) == 0.0);
  CHECK(engine_level({.engine = false}) == 0.0);
}

TEST_CASE("the knock's peak is proportional to the speed of the impact, up to a maximum") {
  Cabin cabin;
  cabin.run(kFrame);
  const double loudest = knock_peak(cabin, 0.5);
  CHECK(loudest > 0.2);
  for (const double speed : {0.01, 0.05, 0.1, 0.2, 0.3, 0.4}) {
    CAPTURE(speed);
    CHECK(knock_peak(cabin, speed) / loudest == doctest::Approx(speed / 0.5).epsilon(1e-3));
  }
  CHECK(knock_peak(cabin, 0.6) == doctest::Approx(loudest));
  CHECK(knock_peak(cabin, 0.0) == 0.0);
  CHECK(knock_peak(cabin, -0.1) == 0.0);
}

TEST_CASE("engaging a gear sounds within 20 ms, once, and louder than disengaging it") {
  const auto click = [](EventKind kind) {
    Cabin cabin;
    cabin.run(kFrame);
    cabin.on_event(kind, 3.0);
    std::vector<float> first = cabin.run(0.2);
    CHECK(peak(doubles(std::span(first).first(2 * kSoundRate / 50))) > 0.05);  // the click is audible within 20 ms
    CHECK(peak(doubles(cabin.run(0.3))) == 0.0);
    return first;
  };
  const std::vector<float> in = click(EventKind::gear_engaged), out = click(EventKind::gear_left);
  CHECK(level(in) > 1.3 * level(out));
}

TEST_CASE("knock and warnings come from the lever's side, the engine from the front, relative to the driver's head") {
  const auto balance = [](std::span<const float> stereo) {  // [dB] level at the right ear minus level at the left
    return decibels(rms(channel(stereo, Ear::right)) / rms(channel(stereo, Ear::left)));
  };
  const auto knock = [&](Cabin& cabin) {
    cabin.run(kFrame);
    cabin.on_event(EventKind::wall_contact, 0.5);
    return balance(cabin.run(0.2));
  };
  Cabin cabin;
  CHECK(knock(cabin) > 3.0);
  cabin.ears = look_at(cabin.ears.position, glm::dvec3(kKnob));
  CHECK(std::abs(knock(cabin)) < 0.5);
  cabin.lever.flags = kFlagOverPush;
  cabin.ears = look_at({0.0, 0.65, 0.0}, {0.0, 0.65, -1.0});
  cabin.run(0.1);
  CHECK(balance(cabin.run(0.4)) > 3.0);
  cabin.lever.flags = 0;
  const double engine = balance(engine_sound(cabin, 3000.0, 1.0));
  CHECK(engine > 0.0);  // the engine is on the car's centre line, right of the driver
  CHECK(engine < 4.0);
}

TEST_CASE("detent clicks and grind come from the lever's direction and distance") {
  struct EarLevels {
    double left, right;  // [1] RMS
    double balance() const { return decibels(right / left); }
    double both() const { return std::hypot(left, right); }
  };
  // The levels at both ears of a sound that comes from `lever`. The ears are at the origin and face ahead. The low
  // volume keeps the sound below full scale.
  const auto levels_of = [](int sound, glm::vec3 lever) {
    Cabin cabin({.volume = 0.1f, .engine = false});
    cabin.knob = lever;
    cabin.ears = look_at({0.0, 0.0, 0.0}, {0.0, 0.0, -1.0});
    cabin.car.grinding = sound == 2;
    cabin.run(0.1);
    if (sound < 2) cabin.on_event(sound == 0 ? EventKind::gear_engaged : EventKind::gear_left, 3.0);
    const std::vector<float> stereo = cabin.run(0.5);
    return EarLevels{rms(channel(stereo, Ear::left)), rms(channel(stereo, Ear::right))};
  };
  for (const int sound : {0, 1, 2}) {  // 0: gear engaged, 1: gear disengaged, 2: grind
    CAPTURE(sound);
    const EarLevels ahead = levels_of(sound, {0.0f, 0.0f, -1.0f});
    CHECK(ahead.balance() == doctest::Approx(0.0).epsilon(1e-3));
    const EarLevels right = levels_of(sound, {0.5f, 0.0f, -0.8f}), left = levels_of(sound, {-0.5f, 0.0f, -0.8f});
    CHECK(right.balance() > 6.0);
    CHECK(left.balance() == doctest::Approx(-right.balance()).epsilon(1e-3));
    for (const float metres : {2.0f, 4.0f})  // beyond the reference distance of 0.5 m the level falls as 1 / distance
      CHECK(levels_of(sound, {0.0f, 0.0f, -metres}).both() / ahead.both() ==
            doctest::Approx(1.0 / metres).epsilon(1e-3));
  }
}

TEST_CASE("both ears hear a warning for any direction of view: they differ by less than 20 dB") {
  Cabin cabin;
  cabin.lever.flags = kFlagOverPush;
  for (double degrees = 0.0; degrees < 360.0; degrees += 30.0) {
    const double angle = degrees * std::numbers::pi / 180.0;
    const glm::dvec3 eye{0.0, 0.65, 0.0};
    cabin.ears = look_at(eye, eye + glm::dvec3(std::sin(angle), -0.2, -std::cos(angle)));
    cabin.run(0.1);
    const std::vector<float> stereo = cabin.run(0.4);
    const double left_ear = rms(channel(stereo, Ear::left)), right_ear = rms(channel(stereo, Ear::right));
    CAPTURE(degrees);
    CHECK(std::abs(decibels(right_ear / left_ear)) < 20.0);
    CHECK(std::min(left_ear, right_ear) > 0.01);
  }
}

TEST_CASE("over-push sounds within a frame of its event, while the flag is set, and for at least 0.3 s") {
  Cabin cabin;
  cabin.run(0.1);
  cabin.on_event(EventKind::over_push_begin, 60.0);
  cabin.lever.flags = kFlagOverPush;
  CHECK(level(cabin.run(2.0 * kFrame)) > 0.02);
  CHECK(level(cabin.run(2.0)) > 0.05);
  cabin.lever.flags = 0;
  cabin.on_event(EventKind::over_push_end);
  cabin.run(2.0 * kFrame);
  CHECK(peak(doubles(cabin.run(0.5))) == 0.0);

  cabin.on_event(EventKind::over_push_begin, 60.0);  // the over-push begins and ends between two frames
  cabin.on_event(EventKind::over_push_end);
  const std::vector<float> brief = cabin.run(0.3);
  CHECK(level(std::span(brief).last(2 * kSoundRate / 20)) > 0.05);
  cabin.run(2.0 * kFrame);
  CHECK(peak(doubles(cabin.run(0.5))) == 0.0);
}

TEST_CASE("a warning always begins with its first tone") {
  for (const double silence : {0.1, 0.27, 0.43}) {
    Cabin cabin;
    cabin.run(silence);
    cabin.lever.flags = kFlagOverPush;
    CHECK(strongest_line(left(cabin.run(0.15))) == doctest::Approx(kOverPushTones[0]).epsilon(0.01));
    cabin.run(0.05);
    CHECK(strongest_line(left(cabin.run(0.15))) == doctest::Approx(kOverPushTones[1]).epsilon(0.01));
  }
}

TEST_CASE("saturation that flickers faster than the hold is one warning; two warnings at once are both audible") {
  Cabin cabin;
  std::vector<float> stereo;
  for (int n = 0; n < 10; ++n) {  // the force saturates once every 200 ms
    cabin.on_event(EventKind::saturation_begin, 40.0);
    cabin.on_event(EventKind::saturation_end);
    const std::vector<float> some = cabin.run(0.2);
    stereo.insert(stereo.end(), some.begin(), some.end());
  }
  int begins = 0;  // number of beeps: three per half second, so 12 in 2 s, however often the force saturates
  bool was = false;
  for (std::size_t n = 0; n + 960 <= stereo.size(); n += 960) {  // 10 ms
    const bool is = level(std::span(stereo).subspan(n, 960)) > 0.05;
    begins += is && !was;
    was = is;
  }
  CHECK(begins == 12);
  cabin.lever.flags = kFlagSaturated | kFlagOverPush;
  cabin.run(0.1);
  const std::vector<double> both = left(cabin.run(2.0));
  for (const double tone : {kOverPushTones[0], kOverPushTones[1], kSaturationTone}) {
    CHECK(amplitude_at(both, tone) > 10.0 * amplitude_at(both, 1.37 * tone));
  }
}

// NUREG-0700 rev. 2, signal intensity: a warning must exceed the noise by 20 dB in at least one octave band between 200
// and 5000 Hz.
TEST_CASE("each warning exceeds the engine at full load by 20 dB in an octave band, at both ears, at every speed") {
  const auto warning = [](std::uint32_t flag, bool over_revved = false) {
    Cabin cabin;
    cabin.lever.flags = flag;
    cabin.car.over_revved = over_revved;
    cabin.run(0.5);
    return octave_powers(cabin.run(2.0));
  };
  const OctavePowers over_push = warning(kFlagOverPush), saturation = warning(kFlagSaturated);
  const OctavePowers over_rev = warning(0, true);
  Cabin cabin;
  double min_push = 1e9, min_saturation = 1e9, min_over_rev = 1e9;
  for (double speed = 800.0; speed <= 7000.0; speed *= 1.2) {
    const OctavePowers engine = octave_powers(engine_sound(cabin, speed, 1.0, 2.0));
    min_push = std::min(min_push, best_octave(over_push, engine));
    min_saturation = std::min(min_saturation, best_octave(saturation, engine));
    min_over_rev = std::min(min_over_rev, best_octave(over_rev, engine));
  }
  MESSAGE("lowest signal-to-noise ratio: over-push " << min_push << " dB, saturation " << min_saturation
                                                     << " dB, over-rev " << min_over_rev << " dB");
  CHECK(min_push >= 20.0);
  CHECK(min_saturation >= 20.0);
  CHECK(min_over_rev >= 20.0);
}

TEST_CASE("engine at its limiter, grind, gear and all warnings together stay within full scale at the default volume") {
  Cabin cabin;
  cabin.car = running(6500.0, 1.0);
  cabin.car.grinding = cabin.car.over_revved = cabin.car.fuel_cut = true;
  cabin.car.grind_power = 1000.0;
  cabin.lever.flags = kFlagOverPush | kFlagSaturated;
  double highest = 0.0;
  for (int n = 0; n < 10; ++n) {
    cabin.on_event(EventKind::gear_engaged, 3.0);
    highest = std::max(highest, peak(doubles(cabin.run(0.2))));
  }
  MESSAGE("peak of engine, limiter, grind, gear and all warnings: " << highest);
  CHECK(highest > 0.5);
  CHECK(highest <= 1.0);
}

TEST_CASE("the number of cylinders changes the pitch, immediately and reversibly") {
  Cabin cabin;
  cabin.car = running(3000.0, 1.0);
  for (const int cylinders : {4, 6, 4, 3}) {
    CabinSoundConfig config;
    config.cylinders = cylinders;
    cabin.sound.set_config(config);
    cabin.run(0.1);
    CHECK(strongest_line(left(cabin.run(1.0))) == doctest::Approx(25.0 * cylinders).epsilon(0.005));
  }
  CabinSoundConfig config;
  config.cylinders = 1000;
  cabin.sound.set_config(config);
  CHECK(cabin.sound.config().cylinders == 12);
  config.engine = false;
  cabin.sound.set_config(config);
  cabin.run(0.1);
  CHECK(peak(doubles(cabin.run(0.5))) == 0.0);
}

TEST_CASE("equal drives give bit-identical samples") {
  const auto drive = [] {
    Cabin cabin;
    std::vector<float> all;
    for (int n = 0; n < 20; ++n) {
      cabin.car = running(900.0 + 217.0 * n, 0.05 * n);
      if (n % 3 == 0) cabin.on_event(EventKind::wall_contact, 0.02 * n);
      if (n == 7) cabin.on_event(EventKind::saturation_begin);
      cabin.lever.flags = n > 12 ? kFlagOverPush : 0;
      const std::vector<float> some = cabin.run(0.1);
      all.insert(all.end(), some.begin(), some.end());
    }
    return all;
  };
  CHECK(drive() == drive());
}

TEST_CASE("without an audio output every call is safe") {
  SoundWorld world(SoundOutput::none);
  CabinSound sound(world, {});
  for (const EventKind kind : {EventKind::gear_engaged, EventKind::wall_contact, EventKind::over_push_begin}) {
    const HapticEvent event{kind, 0, 0, 1.0};
    CHECK_NOTHROW(sound.update({&event, 1}, {}, running(3000.0, 1.0), {}, kKnob, 0.0));
  }
}
