// A gate layout as written in its file: read and range-checked, but not yet assembled.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "haptics/gate/gate.h"

namespace gearshift::haptics {

// 4 mm are 53 counts of the paper's encoder (75.4 um each). In a narrower aisle both walls would be felt at once.
inline constexpr double kMinAisleWidth = 0.004;  // [m] minimum width of the neutral aisle and of a slot
inline constexpr double kMinSlotProper = 0.010;  // [m] minimum length of a slot behind its mouth

enum class JunctionKind { open, closed };  // closed: an end junction with a buffer on its closed side

struct SlotLayout {
  int gear = kNeutralGear;  // kReverseGear or 1, 2, ...
  int line = 0;             // in the file
};

struct ColumnLayout {
  double position = 0.0;     // [m] x of the centre line
  SlotLayout forward, back;  // gear kNeutralGear = no slot on this side
  JunctionKind junction = JunctionKind::open;
  int line = 0;
};

struct LockoutLayout {
  int gear = kNeutralGear;
  LockoutKind kind = LockoutKind::push_down;
  int after_gear = kNeutralGear;
  double close_above = 20.0 / kKmhPerMps;  // [m/s]
  double open_below = 15.0 / kKmhPerMps;   // [m/s]
  int line = 0;
};

// Forces at the knob. haptics/gate/README.md shows the resulting curve along a slot.
struct FeelLayout {
  double center_force = 3.0;  // [N] select centring towards the neutral column
  double aisle_force = 1.0;   // [N] shift centring inside the neutral aisle
  double mouth_force = 4.0;   // [N] bump at the slot's mouth, towards neutral
  double detent_force = 6.0;  // [N] resistance before a gear engages
  double lock_force = 12.0;   // [N] pull-out force of an engaged gear
  double buffer_force = 4.0;  // [N] deflecting force in a closed junction's buffer
};

// Line numbers in the file, for messages about parts that have no `line` member. 0: unknown.
struct LayoutLines {
  int gate = 0;
  int slot_length = 0;
  int feel = 0;
};

struct GateLayout {
  std::string name;
  std::string file;                   // for messages
  std::string text;                   // the whole file as read, for traces
  std::vector<ColumnLayout> columns;  // from left to right
  int neutral_column = 0;
  double aisle_width = 0.012;  // [m] width of the neutral aisle, wall to wall
  double slot_width = 0.010;   // [m] wall to wall
  double slot_length = 0.040;  // [m] length from the aisle's centre line to the end stop
  double chamfer = 0.004;      // [m] leg of the 45 degree slot mouths
  FeelLayout feel;
  std::vector<LockoutLayout> lockouts;
  LayoutLines lines;
};

// Throws FileError (haptics/files) with file, line, key, value and allowed range.
GateLayout read_gate_layout(const std::filesystem::path& file);
GateLayout parse_gate_layout(std::string_view text, std::string file_name);

}  // namespace gearshift::haptics
