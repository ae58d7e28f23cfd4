// Tests of sound that is rendered to memory and measured.
#include "engine/sound/sound_world.h"

#include <limits>
#include <numbers>
#include <stdexcept>

#include <doctest/doctest.h>

#include "tests/engine/sound/measure.h"

using namespace gearshift::engine;
using namespace gearshift::test;

namespace {

// A sine. If `frequency` is even, 0.5 s contains a whole number of periods, so that the clip loops without a step.
std::vector<float> sine(double frequency, double amplitude, double seconds = 0.5) {
  std::vector<float> out(static_cast<std::size_t>(std::lround(seconds * kSoundRate)));
  for (std::size_t n = 0; n < out.size(); ++n) {
    const double turns = frequency * static_cast<double>(n) / kSoundRate;
    out[n] = static_cast<float>(amplitude * std::sin(2.0 * std::numbers::pi * turns));
  }
  return out;
}

constexpr glm::vec3 kAhead{0.0f, 0.0f, -0.5f};
constexpr glm::vec3 kRight{0.5f, 0.0f, 0.0f};

// Renders a 1 kHz loop of amplitude 0.5 with the given voice, and leaves out the first 0.1 s.
std::vector<float> render_voice(const Voice& voice, float volume = 1.0f) {
  SoundWorld world(SoundOutput::memory);
  world.set_volume(volume);
  world.loop(world.add_clip(sine(1000.0, 0.5)), voice);
  listen(world, 0.1);
  return listen(world, 1.0);
}

double left_amplitude(const Voice& voice, float volume = 1.0f) {
  return amplitude_at(channel(render_voice(voice, volume), Ear::left), 1000.0);
}

}  // namespace

TEST_CASE("a memory world reports memory, and a silent one reports its reason") {
  CHECK(SoundWorld(SoundOutput::memory).output() == SoundOutput::memory);
  CHECK(SoundWorld(SoundOutput::memory).silence_reason().empty());
  CHECK(SoundWorld(SoundOutput::none).output() == SoundOutput::none);
  CHECK(!SoundWorld(SoundOutput::none).silence_reason().empty());
}

TEST_CASE("silence is exactly 0, before the first call and with voices at gain 0") {
  SoundWorld world(SoundOutput::memory);
  CHECK(peak(channel(listen(world, 0.5), Ear::left)) == 0.0);
  world.loop(world.add_clip(sine(440.0, 0.5)), {.gain = 0.0f});
  CHECK(peak(channel(listen(world, 0.5), Ear::left)) == 0.0);
}

TEST_CASE("pitch is the clip's pitch times the voice's, within the mixer's step of 1/4096") {
  for (const float pitch : {0.25f, 0.5f, 0.97f, 1.0f, 1.3f, 2.0f, 4.0f}) {
    CAPTURE(pitch);
    const double hertz = strongest_line(channel(render_voice({kAhead, 1.0f, pitch}), Ear::left));
    const double step = std::round(pitch * 4096.0) / 4096.0;
    CHECK(hertz == doctest::Approx(1000.0 * step).epsilon(4e-5));
    CHECK(hertz == doctest::Approx(1000.0 * pitch).epsilon(0.5 / 4096.0 / 0.25));
  }
}

TEST_CASE("amplitude is proportional to the voice's gain and to the overall volume") {
  const double full = left_amplitude({kAhead});
  CHECK(full > 0.1);
  for (const float gain : {0.5f, 0.25f, 0.1f, 0.01f}) {
    CHECK(decibels(left_amplitude({kAhead, gain}) / full) == doctest::Approx(decibels(gain)).epsilon(1e-3));
    CHECK(decibels(left_amplitude({kAhead}, gain) / full) == doctest::Approx(decibels(gain)).epsilon(1e-3));
  }
}

TEST_CASE("gain falls as reference / distance, and is constant within the reference distance") {
  // The voices have a gain of 0.1, so that the product of gain and distance factor stays below 1, the largest gain in
  // OpenAL.
  const double near = left_amplitude({{0.0f, 0.0f, -kSoundReferenceDistance}, 0.1f});
  for (const float distance : {0.1f, 0.3f, 0.5f, 0.7f, 1.0f, 2.0f, 5.0f, 20.0f}) {
    CAPTURE(distance);
    const double law = kSoundReferenceDistance / std::max(kSoundReferenceDistance, distance);
    CHECK(left_amplitude({{0.0f, 0.0f, -distance}, 0.1f}) / near == doctest::Approx(law).epsilon(1e-3));
  }
}

TEST_CASE("a source on the right is louder in the right ear, mirrored on the left; turning the listener changes that") {
  const auto balance = [](glm::vec3 source, glm::vec3 forward) {  // [dB] right level relative to left level
    SoundWorld world(SoundOutput::memory);
    world.set_listener(glm::vec3(0.0f), forward, {0.0f, 1.0f, 0.0f});
    world.loop(world.add_clip(sine(1000.0, 0.5)), {source});
    const std::vector<float> stereo = listen(world, 0.5);
    return decibels(rms(channel(stereo, Ear::right)) / rms(channel(stereo, Ear::left)));
  };
  const glm::vec3 north{0.0f, 0.0f, -1.0f}, east{1.0f, 0.0f, 0.0f};
  CHECK(balance(kAhead, north) == doctest::Approx(0.0).epsilon(1e-3));
  double last = 0.0;
  for (const float degrees : {10.0f, 20.0f, 30.0f, 45.0f}) {
    CAPTURE(degrees);
    const float angle = degrees * std::numbers::pi_v<float> / 180.0f;
    const glm::vec3 source{std::sin(angle), 0.0f, -std::cos(angle)}, mirrored{-source.x, 0.0f, source.z};
    CHECK(balance(source, north) > last + 3.0);
    CHECK(balance(mirrored, north) == doctest::Approx(-balance(source, north)).epsilon(1e-3));
    last = balance(source, north);
  }
  CHECK(balance(kRight, north) > last);
  CHECK(std::abs(balance(kRight, east)) < 0.01);  // kRight is now straight ahead
  CHECK(balance(kAhead, east) < -6.0);            // kAhead is now to the left
}

TEST_CASE("moving the listener equals moving everything else the other way") {
  const auto amplitudes_at = [](glm::vec3 ears, glm::vec3 source) {
    SoundWorld world(SoundOutput::memory);
    world.set_listener(ears, {0.0f, 0.0f, -1.0f}, {0.0f, 1.0f, 0.0f});
    world.loop(world.add_clip(sine(1000.0, 0.5)), {source, 0.1f});
    listen(world, 0.1);
    const std::vector<float> stereo = listen(world, 0.5);
    return std::pair(rms(channel(stereo, Ear::left)), rms(channel(stereo, Ear::right)));
  };
  const glm::vec3 source{0.4f, 0.1f, -0.9f};
  const auto [left, right] = amplitudes_at(glm::vec3(0.0f), source);
  for (const glm::vec3 ears : {glm::vec3(3.0f, 0.0f, 0.0f), {0.0f, 0.65f, 0.05f}, {-7.0f, 2.0f, 40.0f}}) {
    const auto [left_there, right_there] = amplitudes_at(ears, source + ears);
    CHECK(left_there == doctest::Approx(left).epsilon(1e-3));
    CHECK(right_there == doctest::Approx(right).epsilon(1e-3));
  }
  // A source at the origin is heard from 1 m and from 4 m: an amplitude ratio of 4, which is 12.04 dB.
  const double near = amplitudes_at({0.0f, 0.0f, 1.0f}, {}).first, far = amplitudes_at({0.0f, 0.0f, 4.0f}, {}).first;
  CHECK(decibels(near / far) == doctest::Approx(12.041).epsilon(1e-3));
}

TEST_CASE("a point source at the listener's side is heard in one ear, a source as wide as its distance in both") {
  const std::vector<float> point = render_voice({kRight}), wide = render_voice({.position = kRight, .radius = 0.5f});
  CHECK(rms(channel(point, Ear::left)) < 1e-3 * rms(channel(point, Ear::right)));
  CHECK(rms(channel(wide, Ear::left)) > 0.25 * rms(channel(wide, Ear::right)));
  CHECK(rms(channel(wide, Ear::left)) < 0.5 * rms(channel(wide, Ear::right)));
}

TEST_CASE("a loop continues across its joint without a step") {
  const std::vector<double> left = channel(render_voice({kAhead}), Ear::left);
  const double amplitude = amplitude_at(left, 1000.0);
  // Deviation from a 1 kHz sine. For a sine with angle w per sample, x[n] - 2 cos(w) x[n - 1] + x[n - 2] = 0.
  double residue = 0.0;
  const double factor = 2.0 * std::cos(2.0 * std::numbers::pi * 1000.0 / kSoundRate);
  for (std::size_t n = 2; n < left.size(); ++n) {
    residue = std::max(residue, std::abs(left[n] - factor * left[n - 1] + left[n - 2]));
  }
  CHECK(residue < 1e-4 * amplitude);

  SoundWorld world(SoundOutput::memory);  // negative control: a loop of 500.25 periods has a jump at its end
  world.loop(world.add_clip(sine(1000.5, 0.5)), {kAhead});
  const std::vector<double> broken = channel(listen(world, 1.0), Ear::left);
  residue = 0.0;
  for (std::size_t n = 2; n < broken.size(); ++n) {
    residue = std::max(residue, std::abs(broken[n] - factor * broken[n - 1] + broken[n - 2]));
  }
  CHECK(residue > 0.1 * amplitude);
}

TEST_CASE("loops of equal pitch stay in phase: two in opposition are silent during any change of pitch") {
  SoundWorld world(SoundOutput::memory);
  const VoiceId one = world.loop(world.add_clip(sine(300.0, 0.5)), {kAhead, 0.8f, 0.9f});
  const VoiceId other = world.loop(world.add_clip(sine(300.0, -0.5)), {kAhead, 0.8f, 0.9f});
  double loudest = 0.0;
  for (int frame = 0; frame < 120; ++frame) {
    const float pitch = 0.9f + 0.0137f * static_cast<float>(frame);
    world.set(one, {kAhead, 0.8f, pitch});
    world.set(other, {kAhead, 0.8f, pitch});
    loudest = std::max(loudest, peak(channel(listen(world, 1.0 / 60.0), Ear::left)));
  }
  CHECK(loudest < 1e-6);
  world.set(other, {kAhead, 0.8f, 1.1f});
  CHECK(peak(channel(listen(world, 0.5), Ear::left)) > 0.1);
}

TEST_CASE("restart begins a loop at its first sample") {
  std::vector<float> ramp(4800);  // rises from 0 to 1, so the level reveals the position
  for (std::size_t n = 0; n < ramp.size(); ++n) ramp[n] = static_cast<float>(n) / 4800.0f;
  SoundWorld world(SoundOutput::memory);
  const VoiceId voice = world.loop(world.add_clip(ramp), {kAhead});
  std::vector<float> stereo(4800);
  world.render(stereo);
  const float half_way = stereo[stereo.size() - 2];
  CHECK(half_way > 0.1f);
  world.restart(voice);
  stereo.resize(960);
  world.render(stereo);
  // 480 frames after the restart, the level must be 480/2400 = 0.2 times `half_way`, the level at frame 2400.
  CHECK(stereo[stereo.size() - 2] == doctest::Approx(0.2 * half_way).epsilon(0.02));
}

TEST_CASE("a one-shot is heard once; beyond 24 at a time, the oldest is stopped") {
  SoundWorld world(SoundOutput::memory);
  std::vector<ClipId> clips;
  for (int n = 0; n < kOneShotVoices + 2; ++n) clips.push_back(world.add_clip(sine(200.0 + 100.0 * n, 0.04, 0.5)));
  for (int n = 0; n < kOneShotVoices; ++n) world.play(clips[static_cast<std::size_t>(n)], {kAhead});
  const auto is_audible = [](std::span<const float> stereo, int n) {
    return amplitude_at(channel(stereo, Ear::left), 200.0 + 100.0 * n) > 0.01;
  };
  std::vector<float> stereo = listen(world, 0.1);
  for (int n = 0; n < kOneShotVoices; ++n) CHECK(is_audible(stereo, n));
  world.play(clips[kOneShotVoices], {kAhead});
  world.play(clips[kOneShotVoices + 1], {kAhead});
  listen(world, 0.05);  // let it settle
  stereo = listen(world, 0.1);
  for (int n = 0; n < kOneShotVoices + 2; ++n) {
    CAPTURE(n);
    CHECK(is_audible(stereo, n) == (n >= 2));
  }
  listen(world, 0.5);
  CHECK(peak(channel(listen(world, 0.1), Ear::left)) == 0.0);  // all have ended
  world.play(clips[0], {kAhead});
  CHECK(is_audible(listen(world, 0.1), 0));
}

TEST_CASE("the same calls give the same samples, bit for bit") {
  const auto scene = [] {
    SoundWorld world(SoundOutput::memory);
    const ClipId clip = world.add_clip(sine(730.0, 0.4));
    const VoiceId voice = world.loop(clip, {kRight, 0.5f, 1.1f});
    std::vector<float> all;
    for (int frame = 0; frame < 60; ++frame) {
      if (frame % 7 == 0) world.play(clip, {kAhead, 0.1f * static_cast<float>(frame % 5), 1.5f});
      world.set(voice, {kRight, 0.5f, 1.1f + 0.01f * static_cast<float>(frame)});
      world.set_listener({0.0f, 0.0f, 0.01f * static_cast<float>(frame)}, {0.0f, 0.0f, -1.0f}, {0.0f, 1.0f, 0.0f});
      const std::vector<float> some = listen(world, 1.0 / 60.0);
      all.insert(all.end(), some.begin(), some.end());
    }
    return all;
  };
  const std::vector<float> first = scene();
  CHECK(rms(channel(first, Ear::right)) > 0.05);
  CHECK(first == scene());
}

TEST_CASE("two worlds do not affect each other") {
  SoundWorld one(SoundOutput::memory), other(SoundOutput::memory);
  one.loop(one.add_clip(sine(500.0, 0.5)), {kAhead});
  other.loop(other.add_clip(sine(900.0, 0.5)), {kAhead});
  const std::vector<double> from_one = channel(listen(one, 0.5), Ear::left);
  const std::vector<double> from_other = channel(listen(other, 0.5), Ear::left);
  CHECK(strongest_line(from_one) == doctest::Approx(500.0).epsilon(1e-4));
  CHECK(strongest_line(from_other) == doctest::Approx(900.0).epsilon(1e-4));
  CHECK(amplitude_at(from_one, 900.0) < 1e-3);
}

TEST_CASE("invalid numbers are clamped or ignored, unknown ids throw") {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();
  SoundWorld world(SoundOutput::memory);
  const ClipId clip = world.add_clip(sine(1000.0, 0.5));
  const VoiceId voice = world.loop(clip, {{kNan, 0.0f, 0.0f}, kNan, kNan});
  world.set_listener({kNan, 0.0f, 0.0f}, {kInf, 0.0f, 0.0f}, {0.0f, kNan, 0.0f});
  world.set_volume(kNan);
  world.update(std::numeric_limits<double>::quiet_NaN());
  CHECK(peak(channel(listen(world, 0.1), Ear::left)) == 0.0);
  world.set_volume(7.0f);
  world.set_listener({0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -1.0f}, {0.0f, 1.0f, 0.0f});
  world.set(voice, {kAhead, 40.0f, 400.0f});
  listen(world, 0.1);
  const std::vector<double> left = channel(listen(world, 0.5), Ear::left);
  CHECK(strongest_line(left) == doctest::Approx(4000.0).epsilon(1e-4));
  CHECK(amplitude_at(left, 4000.0) < 0.5);
  world.add_clip({});
  world.play(clip + 1, {});
  world.loop(clip + 1, {});
  CHECK(std::isfinite(rms(channel(listen(world, 0.1), Ear::left))));
  CHECK_THROWS_AS(world.play(99, {}), std::out_of_range);
  CHECK_THROWS_AS(world.loop(-1, {}), std::out_of_range);
  CHECK_THROWS_AS(world.set(99, {}), std::out_of_range);
}
