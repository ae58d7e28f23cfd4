// H gates and sequential gates must compile to exactly the numbers that they had before the compiler learned other
// mechanisms, because recordings replay bit for bit. The hashes below were made by the compiler of commit a7bb2f53.
#include <cstdint>
#include <cstring>
#include <string_view>

#include <doctest/doctest.h>

#include "app/lab/random_gates/random_layout.h"
#include "haptics/files/fnv_1a.h"
#include "tests/support/gates.h"

using namespace gearshift::haptics;
using namespace gearshift::test;

namespace {

class GateHash {
 public:
  void add(double value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    hash_ = fnv_1a(std::string_view(bytes, sizeof bytes), hash_);
  }
  void add(const FeelCurve& curve) {
    add(curve.pieces);
    add(curve.force_before);
    for (int i = 0; i < curve.pieces; ++i) {
      const FeelCurve::Piece& piece = curve.piece[static_cast<std::size_t>(i)];
      add(piece.from);
      for (const double c : piece.c) add(c);
    }
  }
  void add(const Gate& gate) {
    for (const double value : {gate.half_aisle, gate.select_min, gate.select_max, gate.chamfer}) add(value);
    for (const int value : {gate.neutral_column, gate.sequential_gears}) add(value);
    for (const Column& c : columns(gate)) {
      for (const double value : {c.center, c.half_width, c.back, c.forward}) add(value);
      for (const int value : {c.back_slot, c.forward_slot}) add(value);
    }
    for (const Slot& s : slots(gate)) {
      for (const int value : {s.column, static_cast<int>(s.side), s.gear}) add(value);
      for (const double value : {s.end, s.rest, s.engage_depth, s.release_depth}) add(value);
      add(s.feel);
    }
    for (const Lockout& l : lockouts(gate)) {
      for (const int value :
           {static_cast<int>(l.kind), l.slot, static_cast<int>(l.lateral), l.beyond, l.after_gear, l.from_gear})
        add(value);
      for (const double value : {l.barrier, l.close_above, l.open_below}) add(value);
    }
    for (const Buffer& b : buffers(gate)) {
      for (const double value : {b.wall, b.inner, b.force}) add(value);
      for (const bool value : {b.back_open, b.forward_open}) add(value);
    }
    add(gate.select_feel);
    add(gate.aisle_feel);
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = fnv_1a("");
};

struct KnownGate {
  const char* name;
  std::uint64_t hash;
};

constexpr KnownGate kKnownGates[] = {
    {"paper", 0xd5d08af6674b417f},
    {"five_speed_r_left_up", 0xae6f3e0fafea994a},
    {"five_speed_r_right_down", 0x16d33f7843915cb6},
    {"six_speed_r_left_up", 0xbbfb382abb8a132e},
    {"six_speed_r_left_down", 0xe6ea2a45f5ee13e7},
    {"six_speed_r_right_down", 0xb0c59ac4f2696796},
    {"dog_leg_five", 0x7bfa1beddf96b2f8},
    {"four_speed", 0x5bb947269bbbf518},
    {"sequential_six", 0x4d237b986bdc4007},
};

}  // namespace

TEST_CASE("the gates shipped before other mechanisms compile to the same bits") {
  for (const KnownGate& known : kKnownGates) {
    CAPTURE(known.name);
    GateHash hash;
    hash.add(shipped_gate(known.name));
    CHECK(hash.value() == known.hash);
  }
}

TEST_CASE("500 random H gates compile to the same bits") {
  GateHash hash;
  for (std::uint64_t seed = 1; seed <= 500; ++seed)
    hash.add(compile_gate(gearshift::lab::random_layout(seed), kPaperWorkspace));
  CHECK(hash.value() == 0x5b622740c4e8eef7);
}
