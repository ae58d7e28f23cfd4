// Tests that layouts are read, and that bad layouts are rejected in one sentence with file, line and reason.
#include "haptics/gate/gate_layout.h"

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "haptics/files/file_error.h"
#include "haptics/files/printable.h"
#include "haptics/gate/gate_compiler.h"
#include "tests/support/gates.h"

using namespace gearshift::haptics;
using namespace gearshift::test;

namespace {

struct Hostile {
  const char* file;
  const char* sentence;  // error message after the file name
};

// Line and reason of the error expected for each file in tests/data/hostile_layouts.
constexpr Hostile kHostile[] = {
    {"after_gear_elsewhere", ":29: a lockout of gear R after gear 4 needs both gears in the same column"},
    {"after_itself", ":29: gear R could never be engaged, because its lockout would open only after the same gear"},
    {"after_nothing",
     ":29: after is missing: it must be one of R, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18"},
    {"aisle_too_narrow", ":4: aisle_width_mm = 3.5: must be between 4 and 40"},
    {"barely_negative", ":7: chamfer_mm = -1e-09: must be between 0 and 10"},
    {"buffer_holds_the_lever",
     ":9: buffer_force_n = 4 would hold the lever at a closed junction; there the buffer pulls the lever with "
     "2.62 N, but center_force_n is only 2"},
    {"byte_order_of_utf16", ":1: not valid TOML: "},
    {"center_force_too_weak", ":5: center_force_n = 1: must be at least 1.6, or the lever would not return"},
    {"center_force_too_steep", ":9: center_force_n or spring_n is too large for such narrow slots"},
    {"column_not_a_list", ":3: column = (a table): must be a list of tables: write each as [[column]]"},
    {"column_without_gear", ":23: the column at 30 mm has no gear"},
    {"columns_not_in_order", ":23: the column at -60 mm is not to the right of the previous one"},
    {"columns_of_numbers", ":2: column must be a list of tables: write each as [[column]]"},
    {"date_for_a_number", ":5: slot_width_mm = (a date or time): must be a number between 4 and 30"},
    {"duplicate_gear", ":26: gear 3 is already on line 19"},
    {"duplicate_key", ":8: not valid TOML: "},
    {"duplicate_key_with_escape", ":8: not valid TOML: "},
    {"empty", ":1: name is missing: it must be text in quotes"},
    {"empty_name", ":1: name = \"\": must not be empty"},
    {"escape_for_a_key", ":7: not valid TOML: "},
    {"gate_is_a_number", ":2: gate = 4: must be a table: write [gate]"},
    {"gear_gap", ":24: there is a gear 5 but no gear 3"},
    {"gear_on_both_sides", ":26: gear 5 is already on line 25"},
    {"gear_with_escape", ":14: forward = \"?[2J1\": must be one line without control characters"},
    {"infinity", ":10: lock_force_n = inf: must be between 1 and 25"},
    {"junction_ajar", ":27: junction = \"ajar\": must be one of open, closed"},
    {"key_with_escape", ":7: chamfer?[31m _mm is not a known key; known keys: aisle_width_mm"},
    {"lockout_of_no_gear", ":29: this lockout is for gear 6, but the gate has no such gear"},
    {"lockout_without_gear",
     ":29: gear is missing: it must be one of R, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18"},
    {"lower_case_reverse",
     ":26: back = \"r\": must be one of R, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18"},
    {"missing_position", ":17: position_mm is missing: it must be a number between -200 and 200"},
    {"mixed_columns", ":2: column must be a list of tables: write each as [[column]]"},
    {"name_of_two_lines", ":1: name = \"Hos tile\": must be one line without control characters"},
    {"name_too_long", ":1: name = \"Hostile Hostile Hostile Hostile Hostile ...\": must be at most 200 bytes long"},
    {"name_with_c1_escape", ":1: name = \"?31mHostile\": must be one line without control characters"},
    {"name_with_escape", ":1: name = \"?[31mHostile\": must be one line without control characters"},
    {"nan", ":24: position_mm = nan: must be between -200 and 200"},
    {"negative_chamfer", ":7: chamfer_mm = -1: must be between 0 and 10"},
    {"nested_too_deep", ":1: not valid TOML: "},
    {"neutral_closed", ":12: the neutral column's junction cannot be closed"},
    {"neutral_not_a_flag", ":21: neutral = \"yes\": must be true or false"},
    {"no_columns", ":1: column is missing: write one [[column]] for every column of gears"},
    {"no_forward_gear", ":17: the column at 30 mm has no gear"},
    {"no_neutral", ":12: no column is neutral; write neutral = true in exactly one [[column]]"},
    {"not_toml", ":4: not valid TOML: "},
    {"not_utf8", ":1: not valid TOML: "},
    {"number_for_a_gear", ":14: forward = 1: must be text in quotes"},
    {"number_past_double", ":10: not valid TOML: "},
    {"out_of_range", ":10: lock_force_n = 60: must be between 1 and 25"},
    {"outside_corner",
     ":12: the column at -64 mm has its wall at 69 mm, outside the workspace, which is narrower at its "
     "corners; with end stops at 61 mm, walls must lie within 11.5 mm of the centre"},
    {"outside_fore_aft", ":6: slot_length_mm puts the end stops at 62 mm, outside the workspace"},
    {"outside_sideways",
     ":23: the column at 70 mm has its wall at 75 mm, outside the workspace; the device "
     "reaches 77.1 mm sideways and 68.8 mm fore and aft"},
    {"overlapping_columns",
     ":23: the column at 19.9 mm overlaps the previous one, because slots of this width and chamfer "
     "need 20 mm from centre to centre, but have 19.9 mm"},
    {"reverse_only", ":12: a gate must have a forward gear"},
    {"same_column_twice", ":23: the column at 0 mm is not to the right of the previous one"},
    {"slot_too_short", ":6: slot_length_mm is too short; with this aisle and chamfer it must be at least 20 mm"},
    {"slot_too_short_for_its_feel", ":6: slot_length_mm is too short; below 38.1 mm"},
    {"speed_below_zero", ":33: open_below_kmh = -1: must be between 0 and 400"},
    {"speed_of_a_lift_ring", ":32: close_above_kmh is not a known key; known keys: gear, kind"},
    {"speeds_in_reverse", ":29: open_below_kmh must be smaller than close_above_kmh"},
    {"text_for_a_number", ":5: slot_width_mm = \"10 mm\": must be a number between 4 and 30"},
    {"too_many_columns", ":53: a gate must have between 1 and 10 columns, but this one has 11"},
    {"too_many_lockouts", ":95: a gate can have at most 16 lockouts"},
    {"two_neutrals", ":27: neutral = true: only one column can be neutral, but the column on line 21 already is"},
    {"unknown_gear",
     ":14: forward = \"19\": must be one of R, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18"},
    {"unknown_key", ":8: chamfer_in is not a known key; known keys: aisle_width_mm, slot_width_mm"},
    {"unknown_kind", ":31: kind = \"magnet\": must be one of push_down, lift, speed, after_gear"},
    {"unknown_table",
     ":9: sound is not a known key; known keys: name, aisle, gate, feel, sequential, "
     "column, lockout"},
    {"unreachable_gears",
     ":17: only an end column can have a closed junction; here it would block the "
     "way to gear 5 and R"},
};

constexpr const char* kFolder = GEARSHIFT_TEST_DATA "/hostile_layouts";

std::string refusal(const std::filesystem::path& file) {
  try {
    compile_gate(read_gate_layout(file), kPaperWorkspace);
  } catch (const FileError& error) {
    return error.what();
  }
  return "not refused";
}

}  // namespace

TEST_CASE("every hostile layout is rejected in one sentence with file, line and reason") {
  for (const Hostile& hostile : kHostile) {
    const std::filesystem::path file = std::filesystem::path(kFolder) / (std::string(hostile.file) + ".toml");
    const std::string sentence = refusal(file);
    CAPTURE(sentence);
    CHECK(sentence.find(file.string() + hostile.sentence) == 0);
    CHECK(sentence.find('\n') == std::string::npos);
    CHECK(sentence.find('\x1b') == std::string::npos);
    CHECK(is_printable(sentence));
  }
}

TEST_CASE("every hostile layout in the folder is tested") {
  std::set<std::string> expected, found;
  for (const Hostile& hostile : kHostile) expected.insert(hostile.file);
  for (const auto& entry : std::filesystem::directory_iterator(kFolder)) found.insert(entry.path().stem().string());
  CHECK(found == expected);
}

TEST_CASE("every gear and every kind of lockout is read by its canonical name") {
  const auto layout_with = [](const std::string& gear, const std::string& lockout) {
    return parse_gate_layout("name = \"Test\"\n[[column]]\nposition_mm = 0\nneutral = true\nforward = \"" + gear +
                                 "\"\n[[lockout]]\ngear = \"R\"\n" + lockout,
                             "test.toml");
  };
  for (int gear = kReverseGear; gear <= kMaxGateGear; ++gear) {
    if (gear == kNeutralGear) continue;
    CHECK(layout_with(gear_name(gear), "kind = \"lift\"").columns[0].forward.gear == gear);
  }
  CHECK(std::string(gear_name(kMaxGateGear + 1)) == "?");
  for (const LockoutKind kind :
       {LockoutKind::push_down, LockoutKind::lift, LockoutKind::speed, LockoutKind::after_gear}) {
    std::string lines = std::string("kind = \"") + to_string(kind) + "\"\n";
    if (kind == LockoutKind::after_gear) lines += "after = \"1\"\n";
    CHECK(layout_with("1", lines).lockouts[0].kind == kind);
  }
}

TEST_CASE("a layout is read as written, in metres, newtons and metres per second") {
  const GateLayout layout = parse_gate_layout(R"(name = "Test"
[gate]
aisle_width_mm = 14
slot_width_mm = 9.5
slot_length_mm = 44
chamfer_mm = 3
[feel]
center_force_n = 2
aisle_force_n = 0.5
mouth_force_n = 3
detent_force_n = 5
lock_force_n = 9
buffer_force_n = 1
[[column]]
position_mm = -20
back = "R"
junction = "closed"
[[column]]
position_mm = 12.5
forward = "1"
back = "2"
neutral = true
[[lockout]]
gear = "R"
kind = "speed"
close_above_kmh = 36
open_below_kmh = 18
[[lockout]]
gear = "2"
kind = "after_gear"
after = "1"
)",
                                              "test.toml");
  CHECK(layout.name == "Test");
  CHECK(layout.file == "test.toml");
  CHECK(layout.text.find("position_mm = 12.5") != std::string::npos);
  CHECK(layout.aisle_width == doctest::Approx(0.014));
  CHECK(layout.slot_width == doctest::Approx(0.0095));
  CHECK(layout.slot_length == doctest::Approx(0.044));
  CHECK(layout.chamfer == doctest::Approx(0.003));
  CHECK(layout.feel.center_force == 2.0);
  CHECK(layout.feel.aisle_force == 0.5);
  CHECK(layout.feel.mouth_force == 3.0);
  CHECK(layout.feel.detent_force == 5.0);
  CHECK(layout.feel.lock_force == 9.0);
  CHECK(layout.feel.buffer_force == 1.0);

  REQUIRE(layout.columns.size() == 2);
  CHECK(layout.neutral_column == 1);
  CHECK(layout.columns[0].position == doctest::Approx(-0.020));
  CHECK(layout.columns[0].forward.gear == kNeutralGear);
  CHECK(layout.columns[0].back.gear == kReverseGear);
  CHECK(layout.columns[0].back.line == 16);
  CHECK(layout.columns[0].junction == JunctionKind::closed);
  CHECK(layout.columns[0].line == 14);
  CHECK(layout.columns[1].forward.gear == 1);
  CHECK(layout.columns[1].back.gear == 2);
  CHECK(layout.columns[1].junction == JunctionKind::open);

  REQUIRE(layout.lockouts.size() == 2);
  CHECK(layout.lockouts[0].kind == LockoutKind::speed);
  CHECK(layout.lockouts[0].gear == kReverseGear);
  CHECK(layout.lockouts[0].close_above == doctest::Approx(10.0));
  CHECK(layout.lockouts[0].open_below == doctest::Approx(5.0));
  CHECK(layout.lockouts[1].kind == LockoutKind::after_gear);
  CHECK(layout.lockouts[1].after_gear == 1);
  CHECK(layout.lockouts[1].line == 28);
}

TEST_CASE("missing keys have defaults; a speed lockout closes above 20 and opens below 15 km/h") {
  const GateLayout layout = parse_gate_layout(
      "name = \"Short\"\n"
      "[[column]]\nposition_mm = 0\nforward = \"1\"\nneutral = true\n"
      "[[column]]\nposition_mm = 30\nforward = \"R\"\n"
      "[[lockout]]\ngear = \"R\"\nkind = \"speed\"\n",
      "short.toml");
  const GateLayout plain;
  CHECK(layout.slot_width == plain.slot_width);
  CHECK(layout.feel.lock_force == plain.feel.lock_force);
  CHECK(layout.lockouts.at(0).close_above * 3.6 == doctest::Approx(20.0));
  CHECK(layout.lockouts.at(0).open_below * 3.6 == doctest::Approx(15.0));
  CHECK(compile_gate(layout, kPaperWorkspace).slot_count == 2);
}
