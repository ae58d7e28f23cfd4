// A scripted drive: pedals, handbrake, slope and lever as a function of time, read from a CSV or TOML file.
//
// A CSV file has one line of column names and one line per row; a TOML file has one [[row]] each. Numbers are linear
// between rows, gears and switches change at their row. A value that a row leaves out is that of the row before. Two
// rows at the same time make a step.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>

#include "haptics/gate/gate.h"
#include "haptics/loop/lever_load.h"

namespace gearshift::lab {

struct ScriptRow {
  double time = 0.0;  // [s]
  haptics::DriverControls controls;
  std::optional<int> gear;          // that the hand shifts into; empty: the hand does not shift
  std::optional<glm::dvec2> lever;  // [m] target of the hand, instead of `gear`
};

struct DriveScript {
  std::vector<ScriptRow> rows;  // never empty; times do not fall
  std::string file;             // for messages
  double end() const noexcept { return rows.back().time; }
};

// Throws FileError with file, line, key, value and allowed range.
DriveScript read_drive_script(const std::filesystem::path& file);
DriveScript parse_drive_script(std::string_view text, const std::string& file_name);

// Throws FileError if the script asks for a gear that the gate lacks.
void check_script_fits(const DriveScript& script, const haptics::Gate& gate);

// The names of all columns, separated by commas.
std::string script_columns();

// Follows a script in time.
class ScriptPlayer {
 public:
  explicit ScriptPlayer(const DriveScript& script) : script_(script) {}  // the script must outlive this object
  // Call with times that do not fall. Returns the row at this time [s].
  ScriptRow at(double time) noexcept;

 private:
  const DriveScript& script_;
  std::size_t next_ = 0;  // first row after the last time
};

}  // namespace gearshift::lab
