// A gate layout as written in its file: read and range-checked, but not yet compiled.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "haptics/files/parameter.h"
#include "haptics/gate/gate.h"

namespace gearshift::haptics {

// 4 mm are 53 counts of the paper's encoder (75.4 um each). In a narrower aisle the user would feel both walls at the
// same time.
inline constexpr double kMinAisleWidth = 0.004;  // [m] minimum width of the neutral aisle and of a slot
inline constexpr double kMinSlotProper = 0.010;  // [m] minimum length of a slot behind its mouth

enum class JunctionKind { open, closed };  // closed: an end junction with a buffer on its closed side

struct SlotLayout {
  int gear = kNeutralGear;  // kReverseGear, or a forward gear 1, 2, ...
  int line = 0;             // in the file
  std::string label;        // empty: the gear's name
};

struct ColumnLayout {
  double position = 0.0;     // [m] x of the centre line
  SlotLayout forward, back;  // a gear of kNeutralGear means no slot on this side
  JunctionKind junction = JunctionKind::open;
  double spring_force = 0.0;  // [N] replaces FeelLayout::center_force from here outwards; 0: does not
  int line = 0;
};

// A straight aisle of a mechanism that is not an H gate, with round ends.
struct AisleLayout {
  double from_x = 0.0, from_y = 0.0, to_x = 0.0, to_y = 0.0;  // [m] ends of the centre line
  double width = 0.010;                                       // [m] from wall to wall
  double spring_force = 0.0;                                  // [N] along the aisle, towards `spring_to`
  double spring_to = 0.0;                                     // [m] distance from the first end
  int line = 0;
};

// A place of such a mechanism, on the centre line of an aisle.
struct PlaceLayout {
  double x = 0.0, y = 0.0;    // [m]
  double radius = 0.0;        // [m] 0: as much as there is room for, at most kPlaceRadius
  double lock_force = 7.0;    // [N] resists leaving the place
  double detent_force = 2.0;  // [N] resists entering it
  int gear = kNeutralGear;    // kReverseGear, a forward gear, kNeutralGear, or a position
  std::string label;          // empty: the gear's name
  int line = 0;
};

struct LockoutLayout {
  int gear = kNeutralGear;
  LockoutKind kind = LockoutKind::push_down;
  int after_gear = kNeutralGear;
  std::uint32_t only_after = 0;  // as in Lockout, like `is_leaving`
  bool is_leaving = false;
  double close_above = 20.0 / kKmhPerMps;  // [m/s]
  double open_below = 15.0 / kKmhPerMps;   // [m/s]
  int line = 0;
};

// Forces at the knob. haptics/gate/README.md shows the resulting curve along a slot.
struct FeelLayout {
  double center_force = 3.0;  // [N] centres the lever sideways, towards the neutral column; 0: nothing does
  double aisle_force = 1.0;   // [N] centres the lever fore and aft in the neutral aisle
  double mouth_force = 4.0;   // [N] resists entering a slot's mouth
  double detent_force = 6.0;  // [N] resists the lever before a gear engages
  double lock_force = 12.0;   // [N] resists pulling the lever out of an engaged gear; none in a sequential gate
  double buffer_force = 4.0;  // [N] deflects the lever in the buffer of a closed junction
};

// Line numbers in the file, for error messages about parts that have no `line` member. 0: unknown.
struct LayoutLines {
  int gate = 0;
  int slot_length = 0;
  int feel = 0;
};

struct GateLayout {
  std::string name;
  std::string file;                   // for messages
  std::string text;                   // content of the layout file, for storing in traces
  std::vector<ColumnLayout> columns;  // in order from left to right
  int sequential_gears = 0;           // as in Gate; there is one column, with the slots kNextGear and kPreviousGear
  int neutral_column = 0;
  std::vector<AisleLayout> aisles;  // empty: an H gate or a sequential gate
  std::vector<PlaceLayout> places;
  double aisle_width = 0.012;  // [m] width of the neutral aisle, from wall to wall
  double slot_width = 0.010;   // [m] width of a slot, from wall to wall
  double slot_length = 0.040;  // [m] from the neutral aisle's centre line to the end stop
  double chamfer = 0.004;      // [m] leg of the 45 degree chamfer at slot mouths
  FeelLayout feel;
  std::vector<LockoutLayout> lockouts;
  LayoutLines lines;
};

// Parameters of gate files that are numbers.
template <>
inline constexpr Parameter<GateLayout> kParameters<GateLayout>[] = {
    {&GateLayout::aisle_width, "aisle_width", "aisle_width_mm",
     FileRange{1e3 * kMinAisleWidth, 40.0, file_unit::kMillimetres}, "Neutral aisle, wall to wall."},
    {&GateLayout::slot_width, "slot_width", "slot_width_mm",
     FileRange{1e3 * kMinAisleWidth, 30.0, file_unit::kMillimetres}, "Slots, wall to wall."},
    {&GateLayout::slot_length, "slot_length", "slot_length_mm",
     FileRange{1e3 * kMinSlotProper, 120.0, file_unit::kMillimetres}, "Aisle's centre line to end stop."},
    {&GateLayout::chamfer, "chamfer", "chamfer_mm", FileRange{0.0, 10.0, file_unit::kMillimetres},
     "Leg of a slot's 45 degree corners."},
};
static_assert(describes_all(&GateLayout::name, &GateLayout::file, &GateLayout::text, &GateLayout::columns,
                            &GateLayout::sequential_gears, &GateLayout::neutral_column, &GateLayout::feel,
                            &GateLayout::aisles, &GateLayout::places, &GateLayout::lockouts, &GateLayout::lines));

template <>
inline constexpr Parameter<ColumnLayout> kParameters<ColumnLayout>[] = {
    {&ColumnLayout::position, "position", "position_mm", FileRange{-200.0, 200.0, file_unit::kMillimetres},
     "Sideways position of the column's centre line."},
    {&ColumnLayout::spring_force, "spring_force", "spring_n", FileRange{0.0, 15.0},
     "Sideways force from this column outwards; 0: `center_force_n`."},
};
static_assert(describes_all(&ColumnLayout::forward, &ColumnLayout::back, &ColumnLayout::junction, &ColumnLayout::line));

// The paper's lever has a peak force of 31.7 N; a lock must leave some of it for the walls.
template <>
inline constexpr Parameter<FeelLayout> kParameters<FeelLayout>[] = {
    {&FeelLayout::center_force, "center_force", "center_force_n", FileRange{0.0, 10.0},
     "Sideways, to the neutral column; grows with the distance. 0: none."},
    {&FeelLayout::aisle_force, "aisle_force", "aisle_force_n", FileRange{0.0, 5.0},
     "Fore and aft, to the aisle's centre line."},
    {&FeelLayout::mouth_force, "mouth_force", "mouth_force_n", FileRange{0.0, 15.0}, "Bump at the mouth of a slot."},
    {&FeelLayout::detent_force, "detent_force", "detent_force_n", FileRange{0.0, 20.0},
     "Resistance before a gear engages."},
    {&FeelLayout::lock_force, "lock_force", "lock_force_n", FileRange{1.0, 25.0}, "Pull-out force of an engaged gear."},
    {&FeelLayout::buffer_force, "buffer_force", "buffer_force_n", FileRange{0.0, 10.0},
     "Turning force at a closed junction."},
};
static_assert(DescribesAll<FeelLayout>);

template <>
inline constexpr Parameter<AisleLayout> kParameters<AisleLayout>[] = {
    {&AisleLayout::from_x, "from_x", "from_x_mm", FileRange{-200.0, 200.0, file_unit::kMillimetres},
     "One end of the centre line, to the right."},
    {&AisleLayout::from_y, "from_y", "from_y_mm", FileRange{-200.0, 200.0, file_unit::kMillimetres}, "Forward."},
    {&AisleLayout::to_x, "to_x", "to_x_mm", FileRange{-200.0, 200.0, file_unit::kMillimetres}, "The other end."},
    {&AisleLayout::to_y, "to_y", "to_y_mm", FileRange{-200.0, 200.0, file_unit::kMillimetres}, "Forward."},
    {&AisleLayout::width, "width", "width_mm", FileRange{1e3 * kMinAisleWidth, 40.0, file_unit::kMillimetres},
     "Wall to wall."},
    {&AisleLayout::spring_force, "spring_force", "spring_n", FileRange{0.0, 15.0},
     "Along the aisle, wherever no other aisle meets it."},
    {&AisleLayout::spring_to, "spring_to", "spring_to_mm", FileRange{0.0, 400.0, file_unit::kMillimetres},
     "Where the spring pulls to, from the first end."},
};
static_assert(describes_all(&AisleLayout::line));

template <>
inline constexpr Parameter<PlaceLayout> kParameters<PlaceLayout>[] = {
    {&PlaceLayout::x, "x", "x_mm", FileRange{-200.0, 200.0, file_unit::kMillimetres}, "To the right."},
    {&PlaceLayout::y, "y", "y_mm", FileRange{-200.0, 200.0, file_unit::kMillimetres}, "Forward."},
    {&PlaceLayout::radius, "radius", "radius_mm", FileRange{0.0, 30.0, file_unit::kMillimetres},
     "How far its detent reaches; 0: as far as there is room."},
    {&PlaceLayout::lock_force, "lock_force", "lock_force_n", FileRange{0.0, 25.0}, "Resists leaving; 0: no detent."},
    {&PlaceLayout::detent_force, "detent_force", "detent_force_n", FileRange{0.0, 20.0}, "Resists entering."},
};
static_assert(describes_all(&PlaceLayout::gear, &PlaceLayout::label, &PlaceLayout::line));

template <>
inline constexpr Parameter<LockoutLayout> kParameters<LockoutLayout>[] = {
    {&LockoutLayout::close_above, "close_above", "close_above_kmh", FileRange{0.0, 400.0, file_unit::kKmPerHour},
     "Road speed; for `speed` only."},
    {&LockoutLayout::open_below, "open_below", "open_below_kmh", FileRange{0.0, 400.0, file_unit::kKmPerHour},
     "Road speed; for `speed` only."},
};
static_assert(describes_all(&LockoutLayout::gear, &LockoutLayout::kind, &LockoutLayout::after_gear,
                            &LockoutLayout::only_after, &LockoutLayout::is_leaving, &LockoutLayout::line));

// Throws FileError (haptics/files) with file, line, key, value and allowed range.
GateLayout read_gate_layout(const std::filesystem::path& file);
// The same, for programs that need a car's gearbox: rejects a mechanism of aisles.
GateLayout read_gearbox_layout(const std::filesystem::path& file);
GateLayout parse_gate_layout(std::string_view text, std::string file_name);

}  // namespace gearshift::haptics
