// Simulates a device that can be disconnected: OpenAL's memory device with an overridden connection state. Two tests
// start this program again as a child process, one without a sound card and one with OpenAL's null device.
#include <cstdio>
#include <cstdlib>
#include <new>
#include <numbers>
#include <stdexcept>
#include <string>

#include <doctest/doctest.h>

#include "engine/sound/sound_device.h"
#include "tests/engine/sound/measure.h"

using namespace gearshift::engine;
using namespace gearshift::test;

namespace {

struct Socket {
  bool is_plugged = true;
  int opened = 0, open_calls = 0;
};

class PluggedDevice : public SoundDevice {
 public:
  PluggedDevice(SoundOutput output, const Socket& socket)
      : SoundDevice(output), socket_(socket), number_(socket.opened) {}
  // A device that was disconnected stays lost. Only a device opened later can play.
  bool connected() const override {
    return SoundDevice::connected() && socket_.is_plugged && socket_.opened == number_;
  }

 private:
  const Socket& socket_;
  int number_;
};

SoundDeviceOpener opener_of(Socket& socket) {
  return [&socket](SoundOutput output) -> std::unique_ptr<SoundDevice> {
    ++socket.open_calls;
    if (!socket.is_plugged) throw std::runtime_error("unplugged");
    ++socket.opened;
    return std::make_unique<PluggedDevice>(output, socket);
  };
}

std::vector<float> hum(double frequency) {
  std::vector<float> out(kSoundRate / 2);
  for (std::size_t n = 0; n < out.size(); ++n) {
    out[n] =
        0.5f * static_cast<float>(std::sin(2.0 * std::numbers::pi * frequency * static_cast<double>(n) / kSoundRate));
  }
  return out;
}

constexpr glm::vec3 kInFront{0.0f, 0.0f, -0.5f};

// Runs one test case of this program with additional environment variables. Returns its output.
std::string run_case(const std::string& environment, const std::string& name) {
  const std::string command =
      "env " + environment + " /proc/$PPID/exe --no-skip --test-case='" + name + "' 2>&1; echo \"rc $?\"";
  std::string printed;
  FILE* pipe = popen(command.c_str(), "r");
  REQUIRE(pipe != nullptr);
  char line[512];
  while (std::fgets(line, sizeof line, pipe) != nullptr) printed += line;
  pclose(pipe);
  return printed;
}

void use_everything(SoundWorld& world) {
  const ClipId clip = world.add_clip(hum(440.0));
  const VoiceId voice = world.loop(clip, {kInFront});
  for (int n = 0; n < 60; ++n) {
    world.play(clip, {kInFront, 0.1f});
    world.set(voice, {kInFront, 0.01f * static_cast<float>(n)});
    world.restart(voice);
    world.set_listener(kInFront, {0.0f, 0.0f, -1.0f}, {0.0f, 1.0f, 0.0f});
    world.set_volume(0.5f);
    world.update(0.1 * n);
  }
  std::vector<float> stereo(960, 1.0f);
  world.render(stereo);
  CHECK(peak(doubles(stereo)) == 0.0);  // render() writes sound only with SoundOutput::memory
}

}  // namespace

TEST_CASE("a reopened device has all clips and loops in their latest state") {
  Socket socket;
  SoundWorld world(SoundOutput::memory, opener_of(socket));
  const VoiceId voice = world.loop(world.add_clip(hum(440.0)), {kInFront});
  world.set_volume(0.5f);
  world.update(0.0);
  const double before = amplitude_at(channel(listen(world, 0.5), Ear::left), 440.0);

  socket.is_plugged = false;
  world.update(1.0);
  CHECK(world.output() == SoundOutput::none);
  CHECK(world.silence_reason() == "the sound device was lost");
  CHECK(peak(channel(listen(world, 0.1), Ear::left)) == 0.0);
  // While the device is lost, all calls are safe. set() and loop() take effect on the next device.
  world.set(voice, {kInFront, 0.5f, 2.0f});
  const VoiceId late = world.loop(world.add_clip(hum(300.0)), {kInFront, 0.25f});
  world.play(0, {kInFront});
  world.update(1.5);

  socket.is_plugged = true;
  world.update(2.5);
  CHECK(world.output() == SoundOutput::memory);
  CHECK(world.silence_reason().empty());
  const std::vector<double> left = channel(listen(world, 0.5), Ear::left);
  CHECK(amplitude_at(left, 880.0) == doctest::Approx(0.5 * before).epsilon(0.02));
  CHECK(amplitude_at(left, 300.0) == doctest::Approx(0.25 * before).epsilon(0.02));
  CHECK(amplitude_at(left, 440.0) < 0.01 * before);  // play() while the device is lost has no later effect
  world.set(late, {kInFront, 0.0f});
  listen(world, 0.1);
  CHECK(amplitude_at(channel(listen(world, 0.5), Ear::left), 300.0) < 1e-3 * before);
}

TEST_CASE("reopening a lost device is tried at once, then at most once per second, without end") {
  Socket socket;
  SoundWorld world(SoundOutput::memory, opener_of(socket));
  CHECK(socket.open_calls == 1);
  socket.is_plugged = false;
  for (int frame = 0; frame <= 600; ++frame) world.update(100.0 + frame / 60.0);  // 10 s
  CHECK(socket.open_calls >= 1 + 10);
  CHECK(socket.open_calls <= 1 + 11);
  const int so_far = socket.open_calls;
  world.update(5.0);  // the clock goes back by 105 s, but the next attempt is at most 1 s later
  world.update(6.1);
  CHECK(socket.open_calls == so_far + 1);
  socket.is_plugged = true;
  world.update(7.2);
  CHECK(world.output() == SoundOutput::memory);
  CHECK(socket.opened == 2);
  for (int frame = 0; frame < 600; ++frame) world.update(8.0 + frame / 60.0);
  CHECK(socket.opened == 2);  // a working device is not reopened
}

TEST_CASE("after each of ten losses in a row, the device is reopened, and nothing leaks") {
  Socket socket;
  SoundWorld world(SoundOutput::memory, opener_of(socket));
  world.loop(world.add_clip(hum(440.0)), {kInFront});
  const double before = amplitude_at(channel(listen(world, 0.5), Ear::left), 440.0);
  for (int n = 0; n < 10; ++n) {
    socket.is_plugged = false;
    world.update(10.0 * n);
    CHECK(world.output() == SoundOutput::none);
    socket.is_plugged = true;
    world.update(10.0 * n + 2.0);
    CHECK(amplitude_at(channel(listen(world, 0.5), Ear::left), 440.0) == doctest::Approx(before).epsilon(1e-3));
  }
}

TEST_CASE("an opener that fails in any way causes silence, not an exception") {
  SoundWorld without_card(SoundOutput::card, [](SoundOutput) -> std::unique_ptr<SoundDevice> {
    throw std::runtime_error("there is no sound card");
  });
  CHECK(without_card.output() == SoundOutput::none);
  CHECK(without_card.silence_reason() == "there is no sound card");
  use_everything(without_card);
  bool is_first = true;
  SoundWorld once(SoundOutput::memory, [&is_first](SoundOutput output) -> std::unique_ptr<SoundDevice> {
    struct DisconnectedDevice : SoundDevice {
      using SoundDevice::SoundDevice;
      bool connected() const override { return false; }
    };
    if (!std::exchange(is_first, false)) throw std::bad_alloc();
    return std::make_unique<DisconnectedDevice>(output);
  });
  CHECK(once.output() == SoundOutput::memory);
  CHECK_NOTHROW(once.update(1.0));
  CHECK(once.output() == SoundOutput::none);
}

TEST_CASE("child: without a sound card every call is safe and silent" * doctest::skip()) {
  SoundWorld world(SoundOutput::card);
  CHECK(world.output() == SoundOutput::none);
  CHECK(world.silence_reason() == "there is no sound card");
  use_everything(world);
  CHECK(SoundWorld(SoundOutput::memory).output() == SoundOutput::memory);  // the memory device needs no sound card
}

TEST_CASE("child: a null device counts as a card" * doctest::skip()) {
  SoundWorld world(SoundOutput::card);
  CHECK(world.output() == SoundOutput::card);
  CHECK(world.silence_reason().empty());
  use_everything(world);
  CHECK(world.output() == SoundOutput::card);
}

TEST_CASE("without a sound card the world is silent, says so, prints nothing of its own, and every call is safe") {
  const std::string printed = run_case("ALSOFT_DRIVERS=alsa ALSA_CONFIG_PATH=/nonexistent", "child: without*");
  CAPTURE(printed);
  CHECK(printed.find("1 passed") != std::string::npos);
  CHECK(printed.find("rc 0") != std::string::npos);
  CHECK(printed.find("ALSA lib") == std::string::npos);
  CHECK(printed.find("AL lib") == std::string::npos);
}

TEST_CASE("a sound card plays in the mixer's own thread while every call is made") {
  const std::string printed = run_case("ALSOFT_DRIVERS=null", "child: a null*");
  CAPTURE(printed);
  CHECK(printed.find("1 passed") != std::string::npos);
  CHECK(printed.find("rc 0") != std::string::npos);
}
