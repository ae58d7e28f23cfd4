#include "haptics/loop/trace_format.h"

#include <cstring>
#include <set>
#include <string>
#include <string_view>

#include <doctest/doctest.h>

#include "haptics/files/file_error.h"
#include "haptics/loop/checksum.h"
#include "tests/haptics/loop/trace_bench.h"

namespace gearshift::test {
namespace {

std::span<const std::byte> bytes_of(std::string_view text) {
  return std::as_bytes(std::span(text));
}

std::uint64_t bits(double value) {
  return std::bit_cast<std::uint64_t>(value);
}

bool same_bits(glm::dvec2 a, glm::dvec2 b) {
  return bits(a.x) == bits(b.x) && bits(a.y) == bits(b.y);
}

// Two fields. change: 0 none, 1 another name, 2 another order, 3 another type, 4 a third field.
template <int change>
struct ChangedFields {
  std::conditional_t<change == 3, std::uint64_t, double> a{};
  double b = 0.0;
  bool c = false;
};
template <int change>
constexpr void each_field(const ChangedFields<change>& fields, auto&& visit) {
  if (change == 2) visit("b", fields.b);
  visit("a", fields.a);
  if (change != 2) visit(change == 1 ? "d" : "b", fields.b);
  if (change == 4) visit("c", fields.c);
}

// Compares every member explicitly, without the field lists that define the file format.
bool same_sample(const haptics::TraceSample& a, const haptics::TraceSample& b) {
  const haptics::LeverReading &r = a.reading, &q = b.reading;
  const haptics::DriverControls &c = a.controls, &d = b.controls;
  const haptics::HapticTuning &t = a.tuning, &u = b.tuning;
  const haptics::HapticSnapshot &o = a.out, &p = b.out;
  return a.deadline_ns == b.deadline_ns && a.skipped == b.skipped && a.command == b.command &&
         r.sequence == q.sequence && r.time_ns == q.time_ns && same_bits(r.position, q.position) &&
         same_bits(r.hand_force, q.hand_force) && same_bits(r.actuator_force, q.actuator_force) &&
         r.pressed_down == q.pressed_down && r.lifted == q.lifted && r.stop == q.stop &&
         bits(c.pedals.throttle) == bits(d.pedals.throttle) && bits(c.pedals.brake) == bits(d.pedals.brake) &&
         bits(c.pedals.clutch) == bits(d.pedals.clutch) && bits(c.pedals.hand_brake) == bits(d.pedals.hand_brake) &&
         c.ignition == d.ignition && c.starter == d.starter && bits(t.wall_stiffness) == bits(u.wall_stiffness) &&
         bits(t.wall_damping) == bits(u.wall_damping) && bits(t.feel_scale) == bits(u.feel_scale) &&
         bits(t.aisle_damping) == bits(u.aisle_damping) && bits(t.speed_limit) == bits(u.speed_limit) &&
         bits(t.limit_damping) == bits(u.limit_damping) && o.cycle == p.cycle && o.time_ns == p.time_ns &&
         same_bits(o.lever, p.lever) && same_bits(o.velocity, p.velocity) && same_bits(o.proxy, p.proxy) &&
         same_bits(o.wall_force, p.wall_force) && same_bits(o.feel_force, p.feel_force) &&
         same_bits(o.load_force, p.load_force) && same_bits(o.commanded, p.commanded) && same_bits(o.f_h, p.f_h) &&
         same_bits(o.f_a, p.f_a) && same_bits(o.f_j, p.f_j) && bits(o.road_speed) == bits(p.road_speed) &&
         o.slot == p.slot && o.gear == p.gear && o.guard == p.guard && o.fault == p.fault && o.flags == p.flags;
}

}  // namespace

TEST_CASE("checksum: CRC-32 gives the published check value, in one piece and in two") {
  CHECK(haptics::crc32(bytes_of("123456789")) == 0xCBF43926);  // the published check value of CRC-32
  CHECK(haptics::crc32(bytes_of("")) == 0);
  CHECK(haptics::crc32(bytes_of("The quick brown fox jumps over the lazy dog")) == 0x414FA339);
  const std::string_view fox = "The quick brown fox jumps over the lazy dog";
  for (std::size_t cut = 0; cut <= fox.size(); ++cut)
    CHECK(haptics::crc32(bytes_of(fox.substr(cut)), haptics::crc32(bytes_of(fox.substr(0, cut)))) == 0x414FA339);
}

TEST_CASE("checksum: flipping any one bit, or any two top bits, changes the run hash") {
  std::vector<std::byte> bytes(160);
  const auto hash = [&] {
    haptics::RunHash run;
    for (std::size_t at = 0; at < bytes.size(); at += 40) run.add(std::span(bytes).subspan(at, 40));
    return run.value();
  };
  std::set<std::uint64_t> seen{hash()};
  const auto flip = [&](std::size_t bit) { bytes[bit / 8] ^= std::byte{1} << (bit % 8); };
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    flip(bit);
    CHECK(seen.insert(hash()).second);
    flip(bit);
  }
  // Flips every pair of sign bits. The classic FNV hash, applied word by word, would miss all of these changes.
  for (std::size_t one = 63; one < 8 * bytes.size(); one += 64)
    for (std::size_t two = one + 64; two < 8 * bytes.size(); two += 64) {
      flip(one), flip(two);
      CHECK(seen.insert(hash()).second);
      flip(one), flip(two);
    }
}

TEST_CASE("trace: every bit of every field comes back, NaN payloads and signed zeros included") {
  const TempFolder folder;
  for (const std::size_t count : {1u, 255u, 256u, 257u, 1000u}) {
    const std::vector<haptics::TraceSample> samples = any_samples(count, count);
    write_trace(folder / "t.trace", paper_header(), samples);
    const Trace back = read_trace(folder / "t.trace");
    REQUIRE(back.samples.size() == count);
    for (std::size_t i = 0; i < count; ++i) REQUIRE(same_sample(back.samples[i], samples[i]));
  }
}

TEST_CASE("trace: the whole header is read back") {
  const TempFolder folder;
  haptics::TraceHeader header = paper_header();
  header.config.rate = 2000.0;
  header.config.tuning.wall_stiffness = 1234.5678901234567;
  header.config.guard.overruns_in_row = 3;
  header.config.ghost_offset = std::nextafter(0.02, 1.0);
  header.device.delay = 1;
  header.device.axis_y.mass = 0.5;
  header.device.device_wall_stiffness = {400.0, 300.0};
  header.gate_text += "# \xC3\xBC and a zero: ";
  header.gate_text.push_back('\0');
  header.load = "driveline 7";
  write_trace(folder / "t.trace", header, any_samples(2));

  const haptics::TraceHeader back = read_trace(folder / "t.trace").header;
  CHECK(back.program == "1.2.3");
  CHECK(back.config.rate == 2000.0);
  CHECK(back.config.tuning.wall_stiffness == 1234.5678901234567);
  CHECK(back.config.guard.overruns_in_row == 3);
  CHECK(back.config.ghost_offset == std::nextafter(0.02, 1.0));
  CHECK(back.device.delay == 1);
  CHECK(back.device.axis_y.mass == 0.5);
  CHECK(back.device.device_wall_stiffness == glm::dvec2{400.0, 300.0});
  CHECK(back.device.simulated);
  CHECK_FALSE(back.device.measures_hand_force);
  CHECK(back.gate_file == "paper.toml");
  CHECK(back.gate_text == header.gate_text);
  CHECK(back.load == "driveline 7");
  CHECK(back.armed);
}

TEST_CASE("trace: a sample is little-endian, inputs first, outputs last") {
  haptics::TraceSample sample;
  sample.deadline_ns = 0x0102030405060708;
  sample.out.flags = 0xA1B2C3D4;
  const haptics::EncodedSample bytes = haptics::encode_sample(sample);
  const unsigned char first[] = {8, 7, 6, 5, 4, 3, 2, 1};
  const unsigned char last[] = {0xD4, 0xC3, 0xB2, 0xA1};
  CHECK(std::memcmp(bytes.data(), first, 8) == 0);
  CHECK(std::memcmp(bytes.data() + bytes.size() - 4, last, 4) == 0);
  CHECK(haptics::outputs_of(bytes).data() + haptics::outputs_of(bytes).size() == bytes.data() + bytes.size());
  CHECK(haptics::kSampleBytes - haptics::kOutputBytes ==
        8 + 8 + (8 + 8 + 6 * 8 + 3) + (4 * 8 + 2 + 8 + 4 + 8) + 6 * 8 + 1);
  CHECK(haptics::kOutputBytes == 8 + 8 + 10 * 16 + 2 * 8 + 4 + 4 + 1 + 1 + 4);
}

TEST_CASE("trace: another name, order, type or number of fields gives another hash of the fields") {
  const std::set<std::uint64_t> hashes{
      haptics::fields_hash<ChangedFields<0>>(), haptics::fields_hash<ChangedFields<1>>(),
      haptics::fields_hash<ChangedFields<2>>(), haptics::fields_hash<ChangedFields<3>>(),
      haptics::fields_hash<ChangedFields<4>>(), haptics::fields_hash<ChangedFields<0>, ChangedFields<0>>()};
  CHECK(hashes.size() == 6);
}

TEST_CASE("trace: the parameters are in the order of version 8") {
  haptics::HapticConfig config;
  config.rate = 1.0;
  config.tuning.wall_stiffness = 2.0;
  config.over_push.clear_below = 3.0;
  config.gear_debounce = 4.0;
  config.ghost_offset = 5.0;
  std::array<std::byte, haptics::encoded_size<haptics::HapticConfig>()> bytes;
  haptics::FieldWriter(bytes.data()).put(config);
  const auto number_at = [&](std::size_t offset) {
    double number = 0.0;
    std::memcpy(&number, bytes.data() + offset, sizeof number);
    return number;
  };
  CHECK(number_at(0) == 1.0);
  CHECK(number_at(8) == 2.0);
  CHECK(number_at(bytes.size() - 24) == 3.0);
  CHECK(number_at(bytes.size() - 16) == 4.0);
  CHECK(number_at(bytes.size() - 8) == 5.0);
  CHECK(bytes.size() == 8 + 6 * 8 + 4 + (2 * 8 + 4) + (6 * 8 + 4) + 2 * 8 + 2 * 8);
}

TEST_CASE("trace: the hash of a run changes with every output and every parameter, not with the inputs") {
  const TempFolder folder;
  const auto hash_of = [&](const haptics::TraceHeader& header, const haptics::TraceSample& sample) {
    write_trace(folder / "t.trace", header, std::span(&sample, 1));
    return read_trace(folder / "t.trace").hash;
  };
  const haptics::TraceHeader header = paper_header();
  const haptics::TraceSample sample = any_samples(1)[0];
  const std::uint64_t plain = hash_of(header, sample);

  haptics::TraceSample other = sample;
  other.reading.sequence += 1;
  CHECK(hash_of(header, other) == plain);
  other.out.f_j.y = -0.5;
  CHECK(hash_of(header, other) != plain);
  haptics::TraceHeader changed = header;
  changed.device.position_step = 1e-9;
  CHECK(hash_of(changed, sample) != plain);
  changed = header;
  changed.program = "9.9";  // the version of the program is not hashed
  CHECK(hash_of(changed, sample) == plain);
}

}  // namespace gearshift::test
