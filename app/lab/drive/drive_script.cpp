#include "app/lab/drive/drive_script.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "haptics/files/file_error.h"
#include "haptics/files/number_text.h"
#include "haptics/files/printable.h"
#include "haptics/files/text_file.h"
#include "haptics/files/toml_reader.h"

namespace gearshift::lab {
namespace {

constexpr haptics::Range kTime{0.0, 1800.0};  // [s]
constexpr haptics::Range kFraction{0.0, 1.0};
constexpr haptics::Range kSlopePercent{-100.0, 100.0};
constexpr haptics::Range kLeverMm{-100.0, 100.0};

constexpr const char* kScriptColumns[] = {"time_s", "throttle", "brake",   "clutch",     "hand_brake", "slope_percent",
                                          "gear",   "ignition", "starter", "lever_x_mm", "lever_y_mm"};

std::string between(haptics::Range range) {
  return "between " + haptics::number_text(range.min) + " and " + haptics::number_text(range.max);
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

// The fields of a line of CSV. A field in double quotes may contain commas.
std::vector<std::string> fields_of(std::string_view line, const std::string& file, int number) {
  std::vector<std::string> fields(1);
  bool is_quoted = false;
  for (const char c : line) {
    if (c == '"')
      is_quoted = !is_quoted;
    else if (c == ',' && !is_quoted)
      fields.emplace_back();
    else
      fields.back() += c;
  }
  if (is_quoted) throw haptics::FileError(file, number, "a double quote is not closed");
  for (std::string& field : fields) field = trimmed(field);
  return fields;
}

// A row of a CSV file, with the functions of TomlTable that read_row() needs.
class CsvRow {
 public:
  CsvRow(std::string file, int line, const std::vector<std::string>& names, std::vector<std::string> fields)
      : file_(std::move(file)), line_(line) {
    if (fields.size() != names.size())
      throw haptics::FileError(file_, line_,
                               fmt::format("has {} values, but there are {} columns", fields.size(), names.size()));
    for (std::size_t i = 0; i < names.size(); ++i) values_[names[i]] = std::move(fields[i]);
  }

  bool has(std::string_view key) const {
    const auto found = values_.find(key);
    return found != values_.end() && !found->second.empty();
  }

  double number(std::string_view key, haptics::Range range) const {
    const std::string value = has(key) ? text(key) : std::string();
    double number = NAN;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
    const bool is_number = error == std::errc() && end == value.data() + value.size() && !value.empty();
    if (!is_number || !(number >= range.min && number <= range.max))
      fail(key, fmt::format("must be {}{}", is_number ? "" : "a number ", between(range)));
    return number;
  }

  const std::string& text(std::string_view key) const { return values_.find(key)->second; }

  [[noreturn]] void fail(std::string_view key, const std::string& reason) const {
    const std::string value = has(key) ? text(key) : "\"\"";
    throw haptics::FileError(file_, line_, fmt::format("{} = {}: {}", key, haptics::printable(value), reason));
  }

 private:
  std::string file_;
  int line_;
  std::map<std::string, std::string, std::less<>> values_;
};

int gear_of(const auto& source) {
  const std::string word = source.text("gear");
  std::string known;
  for (int gear = haptics::kReverseGear; gear <= haptics::kMaxGear; ++gear) {
    if (word == haptics::gear_name(gear)) return gear;
    known += (known.empty() ? "" : ", ") + std::string(haptics::gear_name(gear));
  }
  source.fail("gear", "must be one of " + known);
}

double lever_of(const auto& source, const char* key, double before) {
  return source.has(key) ? 1e-3 * source.number(key, kLeverMm) : before;
}

// Reads a row of either kind of file; `before` is the row before it.
ScriptRow read_row(const auto& source, const ScriptRow& before, bool is_first) {
  ScriptRow row = before;
  row.time = source.number("time_s", kTime);
  if (!is_first && row.time < before.time)
    source.fail("time_s",
                fmt::format("must be at least that of the row before, {}", haptics::number_text(before.time)));
  const auto read = [&](const char* key, double& value) {
    if (source.has(key)) value = source.number(key, kFraction);
  };
  const auto read_switch = [&](const char* key, bool& value) {
    if (!source.has(key)) return;
    const double number = source.number(key, kFraction);
    if (number != 0.0 && number != 1.0) source.fail(key, "must be 0 or 1");
    value = number == 1.0;
  };
  haptics::DriverControls& controls = row.controls;
  read("throttle", controls.pedals.throttle);
  read("brake", controls.pedals.brake);
  read("clutch", controls.pedals.clutch);
  read("hand_brake", controls.pedals.hand_brake);
  read_switch("ignition", controls.ignition);
  read_switch("starter", controls.starter);
  if (source.has("slope_percent")) controls.slope = std::atan(source.number("slope_percent", kSlopePercent) / 100.0);
  if (source.has("gear")) row.gear = gear_of(source);
  const bool has_x = source.has("lever_x_mm"), has_y = source.has("lever_y_mm");
  if (has_x || has_y) {
    if (row.gear) source.fail(has_x ? "lever_x_mm" : "lever_y_mm", "cannot be combined with gear");
    const glm::dvec2 last = before.lever.value_or(glm::dvec2{0.0});
    row.lever = {lever_of(source, "lever_x_mm", last.x), lever_of(source, "lever_y_mm", last.y)};
  }
  return row;
}

void add_row(const auto& source, DriveScript& script) {
  ScriptRow first;
  first.controls.ignition = true;
  const bool is_first = script.rows.empty();
  script.rows.push_back(read_row(source, is_first ? first : script.rows.back(), is_first));
}

void check_columns(const std::vector<std::string>& names, const std::string& file, int line) {
  for (auto name = names.begin(); name != names.end(); ++name) {
    if (std::find(std::begin(kScriptColumns), std::end(kScriptColumns), *name) == std::end(kScriptColumns))
      throw haptics::FileError(
          file, line,
          fmt::format("\"{}\" is not a known column; known: {}", haptics::printable(*name), script_columns()));
    if (std::find(names.begin(), name, *name) != name) throw haptics::FileError(file, line, *name + " is there twice");
  }
  if (std::find(names.begin(), names.end(), "time_s") == names.end())
    throw haptics::FileError(file, line, "the column time_s is missing");
}

DriveScript parse_csv(std::string_view text, const std::string& file) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  DriveScript script;
  std::vector<std::string> names;
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.empty() || line.front() == '#') continue;
    if (names.empty()) {
      names = fields_of(line, file, number);
      check_columns(names, file, number);
    } else {
      add_row(CsvRow(file, number, names, fields_of(line, file, number)), script);
    }
  }
  return script;
}

DriveScript parse_toml(std::string_view text, const std::string& file) {
  const haptics::TomlTable root = haptics::TomlTable::parse(text, file);
  DriveScript script;
  for (const haptics::TomlTable& row : root.tables("row")) {
    add_row(row, script);
    row.reject_unknown_keys();
  }
  root.reject_unknown_keys();
  return script;
}

double mixed(double a, double b, double fraction) noexcept {
  return a + fraction * (b - a);
}

}  // namespace

DriveScript read_drive_script(const std::filesystem::path& file) {
  return parse_drive_script(haptics::read_text_file(file), file.string());
}

DriveScript parse_drive_script(std::string_view text, const std::string& file_name) {
  const bool is_toml = std::filesystem::path(file_name).extension() == ".toml";
  DriveScript script = is_toml ? parse_toml(text, file_name) : parse_csv(text, file_name);
  script.file = file_name;
  if (script.rows.empty())
    throw haptics::FileError(
        file_name, 0, is_toml ? "has no [[row]]" : "has no rows below the line of column names: " + script_columns());
  return script;
}

void check_script_fits(const DriveScript& script, const haptics::Gate& gate) {
  for (const ScriptRow& row : script.rows) {
    if (!row.gear || haptics::has_gear(gate, *row.gear)) continue;
    throw haptics::FileError(script.file, 0,
                             fmt::format("gear = {} at {} s: this gate has no such gear", haptics::gear_name(*row.gear),
                                         haptics::number_text(row.time)));
  }
}

std::string script_columns() {
  std::string names;
  for (const char* name : kScriptColumns) names += (names.empty() ? "" : ", ") + std::string(name);
  return names;
}

ScriptRow ScriptPlayer::at(double time) noexcept {
  const std::vector<ScriptRow>& rows = script_.rows;
  while (next_ < rows.size() && rows[next_].time <= time) ++next_;
  if (next_ == 0 || next_ == rows.size()) return rows[next_ == 0 ? 0 : next_ - 1];
  const ScriptRow &from = rows[next_ - 1], &to = rows[next_];
  const double fraction = (time - from.time) / (to.time - from.time);
  ScriptRow row = from;
  row.time = time;
  haptics::Pedals& pedals = row.controls.pedals;
  const haptics::Pedals& last = to.controls.pedals;
  pedals.throttle = mixed(pedals.throttle, last.throttle, fraction);
  pedals.brake = mixed(pedals.brake, last.brake, fraction);
  pedals.clutch = mixed(pedals.clutch, last.clutch, fraction);
  pedals.hand_brake = mixed(pedals.hand_brake, last.hand_brake, fraction);
  row.controls.slope = std::atan(mixed(std::tan(from.controls.slope), std::tan(to.controls.slope), fraction));
  if (from.lever && to.lever)
    row.lever = {mixed(from.lever->x, to.lever->x, fraction), mixed(from.lever->y, to.lever->y, fraction)};
  return row;
}

}  // namespace gearshift::lab
