// Tests that a written preset is read back with every key and every bit.
#include <bit>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <numbers>
#include <random>
#include <string>

#include <doctest/doctest.h>

#include "haptics/files/file_error.h"
#include "haptics/loop/field_codec.h"
#include "haptics/loop/preset.h"
#include "tests/support/temp_folder.h"
#include "tests/support/whole_campaign.h"

using namespace gearshift::haptics;
using namespace gearshift::test;

namespace {

class RandomPreset {
 public:
  explicit RandomPreset(std::uint64_t seed) : chance_(seed) {}

  Preset make() {
    Preset preset;
    preset.name = "Name \"" + std::to_string(chance_()) + "\" \\ \xc3\xa9";
    fill(preset.haptics);
    fill(preset.lever);
    return preset;
  }

 private:
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(chance_); }
  bool flag() { return chance_() % 2 == 0; }

  void fill(HapticConfig& config) {
    auto& [rate, tuning, contact, estimator, guard, over_push, debounce, ghost] = config;
    rate = between(100.0, 4000.0);
    tuning = {between(0.0, 2e4),  between(0.0, 100.0), between(0.0, 4.0),
              between(0.0, 50.0), between(0.05, 5.0),  between(0.0, 50.0)};
    contact = {static_cast<ContactHold>(chance_() % 4), static_cast<EnergyControl>(chance_() % 3), flag(), flag()};
    estimator = {between(1e-5, 1.0), between(0.1, 1000.0), static_cast<int>(1 + chance_() % 64)};
    guard = {between(2.0, 100.0),
             between(0.001, 60.0),
             between(0.001, 1.0),
             between(0.001, 1.0),
             static_cast<int>(1 + chance_() % 1000),
             between(0.0, 50.0),
             between(0.0, 1.0)};
    over_push.warn_above = between(1.0, 1000.0);
    over_push.clear_below = between(0.0, over_push.warn_above);
    debounce = between(0.0, 0.5);
    ghost = between(0.0, 1.0);
  }

  // Computes the angles from degrees as the reader does, so that every bit agrees.
  void fill(SimulatedLeverConfig& lever) {
    auto& [yoke, axis_x, axis_y, friction, counts, actuator, sensor, delay, own, hand, error, jitter, seed] = lever;
    const double degree = std::numbers::pi / 180.0;
    yoke = {between(0.01, 10.0), between(1.0, 80.0) * degree, 35.0 * degree};
    axis_x = {between(1e-3, 1e3), between(0.0, 1e4), between(0.0, 1e6)};
    axis_y = {between(1e-3, 1e3), between(0.0, 1e4), between(0.0, 1e6)};
    friction = between(0.0, 1e3);
    counts = flag() ? 0.0 : between(1.0, 1e6);
    actuator.peak_force = between(0.0, 1e4);
    actuator.continuous_force = between(0.0, actuator.peak_force);
    actuator.overload_time = between(0.0, 1e4);
    sensor = {between(-1e9, 1e9), between(1e-9, 1e9), between(0.0, 1e6), between(1e-3, 1e9), between(0.0, 1e6)};
    delay = static_cast<int>(chance_() % 9);
    own = flag() ? 0.0 : between(0.0, 1e5);
    hand = flag() ? kNamedHands[chance_() % 4].hand
                  : HandImpedance{between(0.0, 1e3), between(0.0, 1e4), between(0.0, 1e6)};
    if (flag()) hand = {between(0.1, 1e3), 1.0, 2.0, between(0.0, 1e3), between(0.0, 1e3), between(1.0, 1e5)};
    error = between(0.0, 0.5);
    jitter = between(0.0, 0.5);
    seed = chance_() >> 11;  // up to 2^53
  }

  std::mt19937_64 chance_;
};

std::vector<std::byte> bytes_of(const HapticConfig& config) {
  std::vector<std::byte> bytes(encoded_size<HapticConfig>());
  FieldWriter(bytes.data()).put(config);
  return bytes;
}

// The structured bindings stop compiling when a struct gains a member, so no member can be forgotten here.
std::vector<double> numbers_of(const SimulatedLeverConfig& lever) {
  const auto& [yoke, x, y, friction, counts, actuator, sensor, delay, own, hand, error, jitter, seed] = lever;
  const auto& [radius, theta, phi] = yoke;
  const auto& [peak, continuous, overload] = actuator;
  const auto& [offset, gain, resolution, range, noise] = sensor;
  const auto& [hand_mass, hand_damping, hand_stiffness, finger_mass, grip_damping, grip_stiffness] = hand;
  return {radius,       theta,          phi,          x.mass,         x.damping,
          x.stiffness,  y.mass,         y.damping,    y.stiffness,    friction,
          counts,       peak,           continuous,   overload,       offset,
          gain,         resolution,     range,        noise,          static_cast<double>(delay),
          own,          hand_mass,      hand_damping, hand_stiffness, finger_mass,
          grip_damping, grip_stiffness, error,        jitter,         static_cast<double>(seed)};
}

void check_equal(const Preset& a, const Preset& b) {
  CHECK(a.name == b.name);
  CHECK(bytes_of(a.haptics) == bytes_of(b.haptics));
  CHECK(numbers_of(a.lever) == numbers_of(b.lever));
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string refusal(const Preset& preset, const std::filesystem::path& file) {
  try {
    write_preset(preset, file);
  } catch (const FileError& error) {
    return error.what();
  }
  return "written";
}

std::size_t files_in(const TempFolder& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder.path()), {}));
}

}  // namespace

TEST_CASE("a written preset is read back: every key and every bit") {
  const TempFolder folder;
  const std::filesystem::path file = folder / "my.toml";
  for (std::uint64_t seed = 0; seed < (is_full_campaign() ? 300u : 60u); ++seed) {
    CAPTURE(seed);
    const Preset preset = RandomPreset(seed).make();
    write_preset(preset, file);
    check_equal(read_preset(file.string()), preset);
  }
  CHECK(files_in(folder) == 1);
}

TEST_CASE("the shipped presets survive being written") {
  const TempFolder folder;
  for (const char* name : {"default", "measured", "paper"}) {
    CAPTURE(name);
    const Preset preset = read_preset(std::string(GEARSHIFT_ASSETS "/presets/") + name + ".toml");
    write_preset(preset, folder / "copy.toml");
    check_equal(read_preset((folder / "copy.toml").string()), preset);
  }
}

TEST_CASE("the comparison of these tests detects one bit of any number") {
  Preset a = RandomPreset(1).make(), b = a;
  b.haptics.guard.fade_time = std::nextafter(b.haptics.guard.fade_time, 2.0);
  CHECK(bytes_of(a.haptics) != bytes_of(b.haptics));
  b.lever.seed += 1;
  CHECK(numbers_of(a.lever) != numbers_of(b.lever));
}

TEST_CASE("an angle that no number of degrees gives exactly comes back within its last bit") {
  const TempFolder folder;
  std::mt19937_64 chance(5);
  Preset preset;
  preset.name = "angles";
  int exact = 0;
  for (int i = 0; i < 300; ++i) {
    preset.lever.yoke.theta_limit = std::uniform_real_distribution<double>(0.02, 1.39)(chance);
    write_preset(preset, folder / "a.toml");
    const double back = read_preset((folder / "a.toml").string()).lever.yoke.theta_limit;
    const auto bits = [](double value) { return std::bit_cast<std::int64_t>(value); };
    CHECK(std::abs(bits(back) - bits(preset.lever.yoke.theta_limit)) <= 1);
    exact += back == preset.lever.yoke.theta_limit ? 1 : 0;
  }
  CHECK(exact > 200);
}

TEST_CASE("a preset that the reader would refuse is not written, and the old file stays") {
  const TempFolder folder;
  const std::filesystem::path file = folder / "my.toml";
  write_preset(RandomPreset(7).make(), file);
  const std::string before = text_of(file);
  Preset preset = RandomPreset(8).make();
  SUBCASE("a number out of range") {
    preset.haptics.tuning.wall_stiffness = 1e6;
    const std::string message = refusal(preset, file);
    CHECK(message.find(
              "my.toml: not written, because it could not be read back: wall_stiffness_n_per_m = 1000000: must be") !=
          std::string::npos);
    CHECK(message.find(".part") == std::string::npos);
  }
  SUBCASE("no number") {
    preset.lever.model_error = std::numeric_limits<double>::quiet_NaN();
    CHECK(refusal(preset, file).find("model_error = nan: must be") != std::string::npos);
  }
  SUBCASE("no name") {
    preset.name = "";
    CHECK(refusal(preset, file).find("must not be empty") != std::string::npos);
  }
  SUBCASE("a name that is no line") {
    preset.name = "a\nb";
    CHECK(refusal(preset, file).find("not written") != std::string::npos);
  }
  CHECK(text_of(file) == before);
  CHECK(files_in(folder) == 1);
}

TEST_CASE("a path that cannot be written is reported in one sentence and leaves nothing behind") {
  const TempFolder folder;
  const Preset preset = RandomPreset(9).make();
  CHECK(refusal(preset, folder / "no" / "my.toml").find("my.toml: cannot be written") != std::string::npos);
  std::filesystem::create_directory(folder / "my.toml");
  std::ofstream(folder / "my.toml" / "inside") << "x";
  CHECK(refusal(preset, folder / "my.toml").find("my.toml: cannot be written") != std::string::npos);
  CHECK(files_in(folder) == 1);
}
