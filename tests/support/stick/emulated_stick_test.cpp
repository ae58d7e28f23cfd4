// Checks emulated sticks against closed-form solutions, and against bytes derived by hand from the report descriptors
// in tests/data/hid. PID 1.0 is the Device Class Definition for Physical Interface Devices of 1999.
#include "tests/support/stick/emulated_stick.h"

#include <cmath>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

using namespace gearshift::haptics;
using namespace gearshift::test;

namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::int64_t kStickMs = 1'000'000;
constexpr StickFamily kFamilies[] = {StickFamily::sidewinder, StickFamily::openffboard, StickFamily::vjoy};

Bytes hex(const std::string& text) {
  std::istringstream stream(text);
  Bytes bytes;
  for (unsigned value = 0; stream >> std::hex >> value;) bytes.push_back(static_cast<std::uint8_t>(value));
  return bytes;
}

struct PushingHand final : HandDriver {
  HandTarget next(double, glm::dvec2) noexcept override { return target; }
  HandTarget target;
};

// A stick without a spring of its own, on a lever of 5 m, so that the knob practically moves in a plane.
EmulatedStickConfig plain(StickFamily family) {
  EmulatedStickConfig config;
  config.family = family;
  config.lever.axis_x = config.lever.axis_y = {0.1, 3.0, 0.0};
  config.lever.yoke.radius = 5.0;
  return config;
}

struct Rig {
  explicit Rig(const EmulatedStickConfig& config) : family(config.family), stick(config, hand) { stick.advance(0); }
  explicit Rig(StickFamily a_family) : Rig(plain(a_family)) {}

  // Picks the text for the stick family of this rig.
  const char* pick(const char* sidewinder, const char* openffboard, const char* vjoy) const {
    return family == StickFamily::sidewinder ? sidewinder : family == StickFamily::openffboard ? openffboard : vjoy;
  }
  bool out(const std::string& text) {
    const Bytes bytes = hex(text);
    if (family != StickFamily::vjoy) return stick.output(bytes);
    const UsbSetup setup{0x21, 9, static_cast<std::uint16_t>(0x200 | bytes[0]), 0,
                         static_cast<std::uint16_t>(bytes.size())};
    return stick.control(setup, bytes).has_value();
  }
  bool set(const std::string& text) {
    const Bytes bytes = hex(text);
    const UsbSetup setup{0x21, 9, static_cast<std::uint16_t>(0x300 | bytes[0]), 0,
                         static_cast<std::uint16_t>(bytes.size())};
    return stick.control(setup, bytes).has_value();
  }
  std::optional<Bytes> get(int kind_and_id, std::uint16_t size = 64) {
    return stick.control({0xA1, 1, static_cast<std::uint16_t>(kind_and_id), 0, size}, {});
  }
  // Creates an effect of the given type and returns the block load report, which contains the effect's block.
  Bytes load(int type) {
    const char* types[] = {"00", "01", "08", "09", "0C", "0D"};
    for (const char* name : types) {
      if (std::stoi(name, nullptr, 16) == type) set(pick("01 ", "11 ", "11 ") + std::string(name) + " 00 00");
    }
    return *get(0x300 | pick("\x02", "\x12", "\x12")[0]);
  }
  void enable() { out(pick("0C 01", "0C 01", "1C 01")); }
  void start(const std::string& block, const char* loops = "01") {
    out(pick("0A ", "0A ", "1A ") + block + " 01 " + loops);
  }
  void run(std::int64_t ms) {
    for (; ms > 0; --ms) stick.advance(stick.time_ns() + kStickMs);
  }

  StickFamily family;
  PushingHand hand;
  EmulatedStick stick;
};

// Creates a constant force to the right, that is, from 270 degrees, for 300 ms. Returns its block: 2 on the SideWinder,
// 1 on the other sticks.
std::string constant_to_the_right(Rig& rig) {
  const int block = rig.load(1)[1];
  REQUIRE(block == (rig.family == StickFamily::sidewinder ? 2 : 1));
  // 300 ms are 0x012C. 270 degrees are 192 (0xC0) of 256 counts on the SideWinder, 27000 (0x6978) of 36000 on
  // OpenFFBoard, and 24575 (0x5FFF) of 32767 on vJoy.
  rig.out(rig.pick("01 02 01 2C 01 00 00 00 00 FF 00 04 C0 00 00 00",
                   "01 01 01 2C 01 00 00 00 00 00 00 FF 00 04 78 69 00 00 00 00 00 00",
                   "11 01 01 2C 01 00 00 00 00 00 00 FF 00 04 FF 5F 00 00 00 00 00 00"));
  return rig.pick("02", "01", "01");
}

// Sets a fifth of the full magnitude: 51 (0x33) of 255 on the SideWinder, 6553 (0x1999) of 32767 on OpenFFBoard, and
// 2000 (0x07D0) of 10000 on vJoy.
void fifth_of_full(Rig& rig) {
  rig.out(rig.pick("05 02 33 00", "05 01 99 19", "15 01 D0 07"));
}

// Creates a spring (or a condition of the given type) on X and Y and returns its block. Each condition report contains:
// report ID, block, parameter block, centre, two coefficients, two saturations, dead band. Coefficients and saturations
// are at their maximum; centre and dead band are 0.
std::string full_spring(Rig& rig, const char* type_and_load = "08") {
  const int type = std::stoi(type_and_load, nullptr, 16);
  rig.load(type);
  const std::string kind = type_and_load;
  rig.out(rig.pick("01 02 ", "01 01 ", "11 01 ") + kind +
          rig.pick(" 00 00 00 00 00 00 FF 00 03 00 00 00 00",
                   " 00 00 00 00 00 00 00 00 FF 00 03 00 00 00 00 00 00 00 00",
                   " 00 00 00 00 00 00 00 00 FF 00 03 00 00 00 00 00 00 00 00"));
  for (const char* axis : {"00", "01"}) {
    rig.out(
        std::string(rig.pick("03 02 ", "03 01 ", "13 01 ")) + axis +
        rig.pick(" 00 7F 7F FF FF 00", " 00 00 FF 7F FF 7F FF 7F FF 7F 00 00", " 00 00 10 27 10 27 10 27 10 27 00 00"));
  }
  return rig.pick("02", "01", "01");
}

}  // namespace

TEST_CASE("a steady push comes to rest where the spring holds it: x = F / K") {
  for (StickFamily family : kFamilies) {
    CAPTURE(to_string(family));
    Rig rig(family);
    rig.hand.target.push = {6.0, -4.0};
    rig.enable();
    rig.start(full_spring(rig));
    rig.run(3000);
    CHECK(rig.stick.position().x == doctest::Approx(6.0 / 400.0).epsilon(1e-9));
    CHECK(rig.stick.position().y == doctest::Approx(-4.0 / 400.0).epsilon(1e-9));
    CHECK(rig.stick.force().x == doctest::Approx(-6.0).epsilon(1e-9));
  }
}

TEST_CASE("dead band, centre, coefficients on either side and saturation of a condition") {
  // The condition on X: centre at 0.25 of 70 mm, half of the full stiffness to the right, a quarter to the left, at
  // most 0.3 of 20 N in either direction, dead band 0.1 of 70 mm. On vJoy, the fraction 1 is 10000 counts, so the
  // values are exact: 0x09C4, 0x1388, 0x09C4, 0x0BB8 (twice) and 0x03E8. The low byte comes first.
  Rig rig(StickFamily::vjoy);
  rig.enable();
  const std::string block = full_spring(rig);
  rig.out("13 01 00 C4 09 88 13 C4 09 B8 0B B8 0B E8 03");
  rig.start(block);
  const double centre = 0.0175, dead = 0.007;
  rig.hand.target.push = {2.0, 0.0};
  rig.run(4000);
  CHECK(rig.stick.position().x == doctest::Approx(centre + dead + 2.0 / 200.0).epsilon(1e-9));
  rig.hand.target.push = {-2.0, 0.0};
  rig.run(6000);
  CHECK(rig.stick.position().x == doctest::Approx(centre - dead - 2.0 / 100.0).epsilon(1e-9));
  rig.hand.target.push = {6.5, 0.0};  // more than the saturation of 6 N: the lever moves on to the stop
  rig.run(4000);
  CHECK(rig.stick.position().x == doctest::Approx(0.070).epsilon(1e-6));
  CHECK(rig.stick.force().x == doctest::Approx(-6.0).epsilon(1e-9));
  rig.stick.place({centre + 0.9 * dead, 0.0});
  rig.out("1A 01 01 01");
  CHECK(rig.stick.force().x == 0.0);
}

TEST_CASE("under a damper, a push F moves the lever at F / (b + D), where D is the full force per 1 m/s") {
  for (StickFamily family : kFamilies) {
    CAPTURE(to_string(family));
    Rig rig(family);
    rig.enable();
    rig.start(full_spring(rig, "09"));
    rig.hand.target.push = {2.3, 0.0};
    rig.run(200);
    CHECK(rig.stick.velocity().x == doctest::Approx(2.3 / (3.0 + 20.0)).epsilon(1e-4));
  }
}

TEST_CASE("a force pushes from its direction, which counts clockwise from the far side (PID 1.0 section 4.2)") {
  // A force from 0 degrees pushes towards the user, from 90 degrees left, from 180 degrees away from the user, and from
  // 270 degrees right. 90 degrees are 64 (0x40) of 256 counts on the SideWinder, 9000 (0x2328) of 36000 on OpenFFBoard,
  // and 8192 (0x2000) of 32767 on vJoy.
  const char* sidewinder[] = {"00", "40", "80", "C0"};
  const char* openffboard[] = {"00 00", "28 23", "50 46", "78 69"};
  const char* vjoy[] = {"00 00", "00 20", "00 40", "FF 5F"};
  const glm::dvec2 pushes[] = {{0.0, -1.0}, {-1.0, 0.0}, {0.0, 1.0}, {1.0, 0.0}};
  for (StickFamily family : kFamilies) {
    for (int i = 0; i < 4; ++i) {
      CAPTURE(to_string(family));
      CAPTURE(i * 90);
      Rig rig(family);
      rig.enable();
      const std::string block = constant_to_the_right(rig);
      const std::string head =
          rig.pick("01 02 01 2C 01 00 00 00 00 FF 00 04 ", "01 01 01 2C 01 00 00 00 00 00 00 FF 00 04 ",
                   "11 01 01 2C 01 00 00 00 00 00 00 FF 00 04 ");
      rig.out(head + rig.pick(sidewinder[i], openffboard[i], vjoy[i]) +
              rig.pick(" 00 00 00", " 00 00 00 00 00 00", " 00 00 00 00 00 00"));
      fifth_of_full(rig);
      rig.start(block);
      CHECK(glm::length(rig.stick.force() - 4.0 * pushes[i]) < 2e-3);
      rig.run(50);
      CHECK(glm::dot(rig.stick.position(), pushes[i]) > 1e-3);
    }
  }
}

TEST_CASE("the configured signs invert constant forces and springs, per axis") {
  EmulatedStickConfig config = plain(StickFamily::vjoy);
  config.constant_sign = {-1, 1};
  config.spring_sign = {1, -1};
  Rig rig(config);
  rig.enable();
  const std::string block = constant_to_the_right(rig);
  fifth_of_full(rig);
  rig.start(block);
  CHECK(rig.stick.force().x == doctest::Approx(-4.0).epsilon(1e-3));
  Rig inverted_spring(config);
  inverted_spring.enable();
  inverted_spring.start(full_spring(inverted_spring));
  inverted_spring.stick.place({0.01, 0.01});
  inverted_spring.run(1);
  CHECK(inverted_spring.stick.force().x < -3.0);
  CHECK(inverted_spring.stick.force().y > 3.0);
}

TEST_CASE("an effect of 300 ms pushes for 300 periods of 1 ms, with two loops for 600; a new start restarts it") {
  for (StickFamily family : kFamilies) {
    CAPTURE(to_string(family));
    Rig rig(family);
    rig.enable();
    const std::string block = constant_to_the_right(rig);
    fifth_of_full(rig);
    rig.start(block);
    rig.run(299);
    CHECK(rig.stick.force().x == doctest::Approx(4.0).epsilon(1e-3));
    rig.run(1);
    CHECK(rig.stick.force() == glm::dvec2(0.0));
    CHECK(rig.stick.playing() == 0);
    rig.start(block, "02");
    rig.run(599);
    CHECK(rig.stick.playing() == 1);
    rig.start(block);
    rig.run(299);
    CHECK(rig.stick.playing() == 1);
    rig.run(1);
    CHECK(rig.stick.playing() == 0);
  }
}

TEST_CASE("effects with zero or maximum duration never end") {
  for (const char* duration : {"00 00", "FF 7F", "FF FF"}) {
    Rig rig(StickFamily::openffboard);
    rig.load(1);
    rig.out(std::string("01 01 01 ") + duration + " 00 00 00 00 00 00 FF 00 04 78 69 00 00 00 00 00 00");
    rig.start("01");
    rig.run(70'000);
    CHECK(rig.stick.playing() == 1);
  }
}

TEST_CASE("the start delay of an effect, and the delay of the device") {
  EmulatedStickConfig config = plain(StickFamily::openffboard);
  config.delay = 0.003;
  Rig rig(config);
  const std::string block = constant_to_the_right(rig);
  rig.out("01 01 01 2C 01 00 00 00 00 14 00 FF 00 04 78 69 00 00 00 00 00 00");  // 20 ms
  fifth_of_full(rig);
  rig.start(block);
  for (int ms = 0; ms < 400; ++ms) {
    CAPTURE(ms);
    CHECK((rig.stick.force().x > 0.0) == (ms >= 23 && ms < 323));
    rig.run(1);
  }
}

TEST_CASE("gains of effect and device multiply; all forces together are at most the full force") {
  Rig rig(StickFamily::sidewinder);
  rig.enable();
  const std::string block = constant_to_the_right(rig);
  rig.out("01 02 01 2C 01 00 00 00 00 80 00 04 C0 00 00 00");  // 128 of 255
  rig.out("05 02 FF 00");
  rig.start(block);
  CHECK(rig.stick.force().x == doctest::Approx(20.0 * 128.0 / 255.0));
  rig.out("0D 33");  // 51 of 255
  CHECK(rig.stick.force().x == doctest::Approx(20.0 * 128.0 / 255.0 * 0.2));
  rig.out("05 02 01 FF");  // -255
  CHECK(rig.stick.force().x == doctest::Approx(-20.0 * 128.0 / 255.0 * 0.2));
  rig.out("0D FF");
  rig.load(1);
  rig.out("01 03 01 2C 01 00 00 00 00 FF 00 04 40 00 00 00");  // a second constant force, from the right
  rig.out("05 03 FF 00");
  rig.start("03");
  CHECK(rig.stick.force().x == -20.0);
}

TEST_CASE("the pool: lowest block first, full, freed, used again; unknown types") {
  EmulatedStickConfig config = plain(StickFamily::sidewinder);
  config.blocks = 3;
  Rig rig(config);  // block 1 is the SideWinder's own centring spring, so the host creates block 2 first
  CHECK(rig.load(1) == hex("02 02 01 40 00"));  // report 2: block 2, success, 0x40 = 64 bytes left
  CHECK(rig.load(8) == hex("02 03 01 20 00"));
  CHECK(rig.load(9) == hex("02 04 01 00 00"));
  CHECK(rig.load(1) == hex("02 00 02 00 00"));  // full
  rig.out("0B 03");
  rig.out("0B 01");  // has no effect: the host cannot free block 1
  CHECK(rig.load(1) == hex("02 03 01 00 00"));
  rig.out("0B 02");
  CHECK(rig.load(13) == hex("02 00 03 20 00"));     // error
  CHECK(*rig.get(0x303) == hex("03 60 00 03 01"));  // 0x60 = 96 bytes, 3 effects at once, pool managed by the device

  CHECK((*Rig(StickFamily::openffboard).get(0x313))[3] == 40);
  CHECK((*Rig(StickFamily::vjoy).get(0x313))[3] == 100);
  CHECK(Rig(StickFamily::openffboard).load(12)[2] == 3);  // status 3 (error): no effect type 12 (custom force)
}

TEST_CASE("faults of the pool, and finite effects refused") {
  Rig rig(StickFamily::openffboard);
  rig.stick.faults.pool_full = true;
  CHECK(rig.load(1)[2] == 2);
  rig.stick.faults = {};
  rig.stick.faults.refuses_effects = true;
  CHECK(rig.load(1)[2] == 3);

  EmulatedStickConfig config = plain(StickFamily::openffboard);
  config.finite_refused = true;
  Rig endless(config);
  const std::string block = constant_to_the_right(endless);
  CHECK((*endless.get(0x312))[1] == 1);
  CHECK((*endless.get(0x312))[2] == 3);
  endless.start(block);
  CHECK(endless.stick.playing() == 0);
  endless.out("01 01 01 FF 7F 00 00 00 00 00 00 FF 00 04 78 69 00 00 00 00 00 00");
  endless.start(block);
  CHECK(endless.stick.playing() == 1);
}

TEST_CASE("device control (PID 1.0): enable, disable, stop all, reset, pause, continue") {
  for (StickFamily family : {StickFamily::sidewinder, StickFamily::vjoy}) {
    CAPTURE(to_string(family));
    Rig rig(family);
    const auto control = [&](const char* number) { rig.out(std::string(rig.pick("0C ", "", "1C ")) + number); };
    CHECK_FALSE(rig.stick.actuators_on());
    const std::string block = constant_to_the_right(rig);
    fifth_of_full(rig);
    rig.start(block);
    CHECK(rig.stick.force().x == 0.0);
    control("01");
    CHECK(rig.stick.force().x > 3.9);
    control("02");
    CHECK(rig.stick.force().x == 0.0);
    control("01");
    rig.run(100);
    control("05");  // paused: time does not pass for the effect
    CHECK(rig.stick.force().x == 0.0);
    rig.run(500);
    control("06");
    rig.run(199);
    CHECK(rig.stick.force().x > 3.9);
    rig.run(1);
    CHECK(rig.stick.force().x == 0.0);
    rig.start(block);
    control("03");
    CHECK(rig.stick.playing() == 0);
    control("02");
    control("04");  // resets: all blocks are free, actuators on
    CHECK(rig.stick.actuators_on());
    rig.start(block);
    CHECK(rig.stick.playing() == 0);
  }
}

TEST_CASE("OpenFFBoard's one switch: pause, stop all and reset turn it off, setting an effect turns it on") {
  Rig rig(StickFamily::openffboard);
  CHECK_FALSE(rig.stick.actuators_on());
  const std::string block = constant_to_the_right(rig);
  CHECK(rig.stick.actuators_on());
  fifth_of_full(rig);
  rig.start(block);
  for (const char* off : {"02", "04", "10"}) {  // the bits of disable, stop all and pause
    rig.out(std::string("0C ") + off);
    CHECK(rig.stick.force().x == 0.0);
    CHECK(rig.stick.playing() == 1);
    rig.out("0C 20");
    CHECK(rig.stick.force().x > 3.9);
  }
  rig.out("0C 08");
  CHECK_FALSE(rig.stick.actuators_on());
  CHECK(rig.stick.playing() == 0);
  rig.out("0C 00");  // Linux 6.1's hid-pidff sends this as a reset, so it must not turn the actuators on
  CHECK_FALSE(rig.stick.actuators_on());
}

TEST_CASE("starting solo stops the other effects, stop stops one effect") {
  Rig rig(StickFamily::vjoy);
  constant_to_the_right(rig);
  rig.load(1);
  rig.out("11 02 01 2C 01 00 00 00 00 00 00 FF 00 04 FF 5F 00 00 00 00 00 00");
  rig.start("01");
  rig.start("02");
  CHECK(rig.stick.playing() == 2);
  rig.out("1A 02 02 01");
  CHECK(rig.stick.playing() == 1);
  rig.out("1A 01 03 00");
  CHECK(rig.stick.playing() == 1);
  rig.out("1A 02 03 00");
  CHECK(rig.stick.playing() == 0);
}

TEST_CASE("the lever's report: rest, right, forward, buttons, in the bits that the descriptors define") {
  struct Case {
    StickFamily family;
    const char *rest, *right, *forward;  // the bytes from X up to and including Y
    std::size_t size, from;
  };
  // The SideWinder's axes have 10 bits in two bytes, -512 (0x0200) to 511 (0x01FF). The middle, -0.5, is rounded to 0.
  // The bytes of the other sticks were derived in the same way.
  const Case cases[] = {
      {StickFamily::sidewinder, "00 00 00 00", "FF 01 00 00", "00 00 00 02", 13, 1},
      {StickFamily::openffboard, "00 00 00 00", "FF 7F 00 00", "00 00 01 80", 25, 9},
      {StickFamily::vjoy, "00 40 00 00 00 40 00 00", "FF 7F 00 00 00 40 00 00", "00 40 00 00 00 00 00 00", 97, 1},
  };
  for (const Case& c : cases) {
    CAPTURE(to_string(c.family));
    Rig rig(c.family);
    const auto axes_at = [&](glm::dvec2 position) {
      rig.stick.place(position);
      const Bytes report = *rig.get(0x101, 128);
      CHECK(report.size() == c.size);
      CHECK(report[0] == 1);
      const std::size_t length = c.family == StickFamily::vjoy ? 8 : 4;
      const auto from = report.begin() + static_cast<std::ptrdiff_t>(c.from);
      return Bytes(from, from + static_cast<std::ptrdiff_t>(length));
    };
    CHECK(axes_at({0.0, 0.0}) == hex(c.rest));
    CHECK(axes_at({0.070, 0.0}) == hex(c.right));
    CHECK(axes_at({0.0, 0.070}) == hex(c.forward));
    rig.hand.target.lifted = true;
    rig.stick.held_buttons = 0x10;
    rig.run(1);
    const std::size_t buttons[] = {8, 1, 81};
    CHECK((*rig.get(0x101, 128))[buttons[static_cast<std::size_t>(c.family)]] == 0x12);
  }
}

TEST_CASE("reports come at every interval or only after a change, each once") {
  EmulatedStickConfig config = plain(StickFamily::sidewinder);
  config.input_interval = 0.004;
  Rig rig(config);
  int reports = 0;
  for (int ms = 0; ms < 100; ++ms) {
    rig.run(1);
    const bool due = (ms + 1) % 4 == 0;
    CHECK(rig.stick.input().has_value() == due);
    CHECK_FALSE(rig.stick.input());
    reports += due ? 1 : 0;
  }
  CHECK(reports == 25);

  config.reports_only_changes = true;
  Rig unchanged(config);
  unchanged.run(4);
  CHECK(unchanged.stick.input());
  unchanged.run(100);
  CHECK_FALSE(unchanged.stick.input());
  CHECK(unchanged.stick.time_ns() - unchanged.stick.fetched_ns() == 100 * kStickMs);
  CHECK(unchanged.get(0x101));
  CHECK(unchanged.stick.fetched_ns() == unchanged.stick.time_ns());
  unchanged.stick.place({0.01, 0.0});
  unchanged.run(4);
  CHECK(unchanged.stick.input());
}

TEST_CASE("state reports after changes: SideWinder's with the block, OpenFFBoard's without, none on vJoy") {
  Rig rig(StickFamily::sidewinder);
  rig.enable();
  CHECK(*rig.stick.input() == hex("02 16 00"));  // 0x16: actuators, safety switch, power; 0x00: no block
  const std::string block = constant_to_the_right(rig);
  CHECK(*rig.stick.input() == hex("02 16 04"));  // 0x04: 2 * 2 for block 2, plus 0 because it does not play
  rig.start(block);
  CHECK(*rig.stick.input() == hex("02 16 05"));  // block 2 plays
  rig.run(299);
  while (const auto report = rig.stick.input()) CHECK((*report)[0] == 1);
  rig.run(1);
  CHECK(*rig.stick.input() == hex("02 16 04"));  // ended
  CHECK(*rig.get(0x102) == hex("02 16 04"));

  Rig board(StickFamily::openffboard);
  board.enable();
  CHECK(*board.stick.input() == hex("02 0E"));
  board.start(constant_to_the_right(board));
  CHECK(*board.stick.input() == hex("02 0E"));
  CHECK(*board.stick.input() == hex("02 1E"));

  Rig feeder(StickFamily::vjoy);
  feeder.start(constant_to_the_right(feeder));
  CHECK_FALSE(feeder.stick.input());
  CHECK(*feeder.get(0x314) == hex("14 01"));
}

TEST_CASE("faults: jumps, short reports, the same report forever, silence, outputs stalled") {
  Rig rig(StickFamily::openffboard);
  rig.stick.faults.jump = true;
  int jumps = 0;
  for (int ms = 0; ms < 200; ++ms) {
    rig.run(1);
    const Bytes report = *rig.stick.input();
    const int x = static_cast<std::int16_t>(report[9] | report[10] << 8);
    if (x == 0) continue;
    CHECK(x == 19660);  // 0.6 x 32767
    ++jumps;
  }
  CHECK(jumps == 4);
  rig.stick.faults = {};
  rig.stick.faults.wrong_length = true;
  rig.run(1);
  CHECK(rig.stick.input()->size() == 24);
  rig.stick.faults = {};
  rig.stick.faults.stuck = true;
  rig.run(1);
  const Bytes stuck = *rig.stick.input();
  rig.stick.place({0.03, 0.0});
  rig.run(1);
  CHECK(*rig.stick.input() == stuck);
  CHECK(*rig.get(0x101) == stuck);
  rig.stick.faults = {};
  rig.stick.faults.silent = true;
  rig.run(10);
  CHECK_FALSE(rig.stick.input());
  CHECK_FALSE(rig.get(0x101));
  rig.stick.faults = {};
  CHECK(rig.out("0C 01"));
  rig.stick.faults.stalls_outputs = true;
  CHECK_FALSE(rig.out("0C 01"));
}

TEST_CASE("unknown or short reports stall; vJoy has no output pipe") {
  for (StickFamily family : kFamilies) {
    CAPTURE(to_string(family));
    Rig rig(family);
    CHECK_FALSE(rig.out("7E 01"));
    CHECK_FALSE(rig.out(rig.pick("05 02 33", "05 01 33", "15 01 33")));
    CHECK_FALSE(rig.set("7E 01"));
    CHECK_FALSE(rig.get(0x37E));
    CHECK_FALSE(rig.get(0x17E));
  }
  Rig rig(StickFamily::vjoy);
  CHECK_FALSE(rig.stick.output(hex("1C 01")));
  CHECK(rig.out("1C 01"));
}

TEST_CASE("descriptors: consistent lengths, endpoints, strings; idle rate and configuration are stored") {
  struct Case {
    StickFamily family;
    const char* device;
    std::size_t report, configuration;
  };
  const Case cases[] = {
      {StickFamily::sidewinder, "12 01 10 01 00 00 00 40 5E 04 1B 00 00 01 01 02 00 01", 1343, 41},
      {StickFamily::openffboard, "12 01 00 02 00 00 00 40 09 12 B0 FF 00 01 01 02 03 01", 1215, 41},
      {StickFamily::vjoy, "12 01 00 02 00 00 00 40 34 12 AD BE 22 02 01 02 03 01", 1330, 34},
  };
  for (const Case& c : cases) {
    CAPTURE(to_string(c.family));
    Rig rig(c.family);
    const auto descriptor = [&](int type, int index, std::uint8_t recipient, std::uint16_t size = 4096) {
      return rig.stick.control({recipient, 6, static_cast<std::uint16_t>(type << 8 | index), 0, size}, {});
    };
    CHECK(*descriptor(1, 0, 0x80) == hex(c.device));
    CHECK(descriptor(1, 0, 0x80, 8)->size() == 8);
    const Bytes configuration = *descriptor(2, 0, 0x80);
    CHECK(configuration.size() == c.configuration);
    CHECK(configuration[2] == c.configuration);
    CHECK(descriptor(0x22, 0, 0x81)->size() == c.report);
    CHECK((configuration[25] | configuration[26] << 8) == static_cast<int>(c.report));
    CHECK(*descriptor(0x21, 0, 0x81) == Bytes(configuration.begin() + 18, configuration.begin() + 27));
    CHECK(*descriptor(3, 0, 0x80) == hex("04 03 09 04"));
    CHECK(descriptor(3, 2, 0x80));
    CHECK_FALSE(descriptor(3, 9, 0x80));
    CHECK_FALSE(descriptor(6, 0, 0x80));  // no device qualifier, because the stick is full speed
    CHECK(rig.stick.control({0x00, 9, 1, 0, 0}, {}));
    CHECK(*rig.stick.control({0x80, 8, 0, 0, 1}, {}) == hex("01"));
    CHECK(rig.stick.control({0x21, 10, 0x0800, 0, 0}, {}));
    CHECK(*rig.stick.control({0xA1, 2, 0, 0, 1}, {}) == hex("08"));
  }
}

TEST_CASE("messages are logged; an unplug resets everything") {
  Rig rig(StickFamily::sidewinder);
  rig.enable();
  rig.start(constant_to_the_right(rig));
  fifth_of_full(rig);
  REQUIRE(rig.stick.log.size() == 6);
  CHECK(message_line(rig.stick.log[0]) == "out 0c 01");
  CHECK(message_line(rig.stick.log[1]) == "set 01 01 00 00");
  CHECK(message_line(rig.stick.log[2]) == "get 02 02 01 c0 04");  // 0x04C0 bytes left: 38 blocks of 32 bytes
  CHECK(message_line(rig.stick.log[5]) == "out 05 02 33 00");
  CHECK(rig.stick.force().x > 3.9);
  rig.stick.unplug();
  CHECK(rig.stick.force() == glm::dvec2(0.0));
  CHECK_FALSE(rig.stick.actuators_on());
  CHECK(rig.load(1)[1] == 2);
}

TEST_CASE("the same calls give the same motion, bit for bit, in steps of any length") {
  const auto drive = [](std::int64_t step_ns) {
    Rig rig(StickFamily::openffboard);
    rig.hand.target.push = {3.0, 1.0};
    rig.start(full_spring(rig));
    for (std::int64_t t = 0; t <= 250 * kStickMs; t += step_ns) rig.stick.advance(t);
    return rig.stick.position();
  };
  CHECK(drive(kStickMs) == drive(kStickMs));
  CHECK(drive(kStickMs) == drive(kStickMs / 8));
  CHECK(drive(kStickMs) == drive(25 * kStickMs));
}
