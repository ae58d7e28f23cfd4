// Reads, writes and checks the parameters of a struct by its table (parameter.h).
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "haptics/files/number_text.h"
#include "haptics/files/parameter.h"
#include "haptics/files/range_check.h"
#include "haptics/files/toml_reader.h"
#include "haptics/files/toml_text.h"

namespace gearshift::haptics {

// The keys of all values of an enumeration, in order.
template <class Enum>
std::vector<std::string> file_keys() {
  std::vector<std::string> keys;
  for (int i = 0; i <= static_cast<int>(last_value(Enum{})); ++i) keys.emplace_back(file_key(static_cast<Enum>(i)));
  return keys;
}

// The parameter's value in the file's unit.
inline double to_file(const FileUnit& unit, double value) {
  const auto read_back = [&](double number) { return number * unit.multiply / unit.divide; };
  const double nearest = value * unit.divide / unit.multiply;
  for (const double number : {nearest, std::nextafter(nearest, -HUGE_VAL), std::nextafter(nearest, HUGE_VAL)})
    if (read_back(number) == value) return number;
  return nearest;
}

// The largest allowed value, in the file's unit.
template <class S, class... Enums>
Range allowed_range(const Parameter<S, Enums...>& parameter, const S& object) {
  Range range{parameter.range.min, parameter.range.max};
  if (parameter.max_member != nullptr)
    range.max = std::min(range.max, to_file(parameter.range.unit, object.*parameter.max_member));
  return range;
}

// The number in the struct's unit. range: allowed, in the file's unit. Throws FileError.
double read_number(const TomlTable& table, const auto& parameter, Range range) {
  const FileUnit& unit = parameter.range.unit;
  return table.number(parameter.key, range) * unit.multiply / unit.divide;
}

// For keys that a file lacks: keep the struct's default, or throw FileError.
enum class Missing { default_value, error };

// Reads each parameter. A parameter must be present if another value has put its default out of range. Throws FileError
// with file, line, key, value and allowed range.
template <class S>
void read_parameters(const TomlTable& table, S& object, Missing missing = Missing::default_value) {
  each_parameter(object, [&](const auto& parameter, auto& value) {
    using Value = std::remove_cvref_t<decltype(value)>;
    const char* key = parameter.key;
    if constexpr (std::is_same_v<Value, std::optional<double>>) {
      if (table.has(key)) value = read_number(table, parameter, allowed_range(parameter, object));
    } else if constexpr (std::is_same_v<Value, std::optional<bool>>) {
      if (table.has(key)) value = table.flag_or(key, false);
    } else if constexpr (std::is_same_v<Value, bool>) {
      value = table.flag_or(key, value);
    } else if constexpr (std::is_enum_v<Value>) {
      if (missing == Missing::default_value && !table.has(key)) return;
      const std::vector<std::string> keys = file_keys<Value>();
      const std::string chosen = table.choice(key, keys);
      value = static_cast<Value>(std::find(keys.begin(), keys.end(), chosen) - keys.begin());
    } else {
      const Range range = allowed_range(parameter, object);
      const double present = to_file(parameter.range.unit, static_cast<double>(value));
      const bool is_optional = missing == Missing::default_value && present >= range.min && present <= range.max;
      if (is_optional && !table.has(key)) return;
      const double number = read_number(table, parameter, range);
      if constexpr (std::is_integral_v<Value>)
        if (number != std::floor(number)) table.fail(key, "must be a whole number");
      value = static_cast<Value>(number);
    }
  });
}

// "0 to 20000 N/m", "automatic, zero_order", "true or false": the values that a file may have.
template <class S, class... Enums, class Value>
std::string allowed_text(const Parameter<S, Enums...>& parameter, const Value&) {
  if constexpr (std::is_same_v<Value, bool> || std::is_same_v<Value, std::optional<bool>>) {
    return "true or false";
  } else if constexpr (std::is_enum_v<Value>) {
    std::string text;
    for (const std::string& key : file_keys<Value>()) text += (text.empty() ? "" : ", ") + key;
    return text;
  } else {
    std::string max = number_text(parameter.range.max);
    for (const auto& other : kParameters<S>)
      if (const auto* member = std::get_if<double S::*>(&other.member); member && *member == parameter.max_member)
        max = other.key;
    return number_text(parameter.range.min) + " to " + max;
  }
}

// A parameter's value as a file has it.
template <class S, class... Enums, class Value>
requires(!std::is_same_v<Value, std::optional<double>> && !std::is_same_v<Value, std::optional<bool>>) std::string
    value_text(const Parameter<S, Enums...>& parameter, const Value& value) {
  if constexpr (std::is_same_v<Value, bool>)
    return value ? "true" : "false";
  else if constexpr (std::is_enum_v<Value>)
    return toml_string(file_key(value));
  else if constexpr (std::is_same_v<Value, double>)
    return toml_number(to_file(parameter.range.unit, value));
  else
    return toml_number(value);
}

// One line of a TOML file, with a comment if the text for it is not empty.
inline std::string commented(std::string line, const std::string& comment) {
  constexpr std::size_t kCommentColumn = 36;
  if (!comment.empty()) {
    line.resize(std::max(line.size() + 1, kCommentColumn), ' ');
    line += "# " + comment;
  }
  return line + '\n';
}

// The parameters as lines of a TOML table. described: with each parameter's description and allowed values.
template <class S>
std::string parameters_text(const S& object, bool described) {
  std::string text;
  each_parameter(object, [&](const auto& parameter, const auto& value) {
    const std::string comment = described ? allowed_text(parameter, value) + ". " + parameter.description : "";
    text += commented(parameter.key + (" = " + value_text(parameter, value)), comment);
  });
  return text;
}

// The parameters as a Markdown table: key, allowed values and default, description. defaults: one object of each section
// of a file, with the section's name, such as "[feel]"; a required section has no defaults.
class ParameterTable {
 public:
  explicit ParameterTable(Missing missing = Missing::default_value) : missing_(missing) {}

  template <class S>
  ParameterTable& add(std::string_view section, const S& defaults) {
    each_parameter(defaults, [&](const auto& parameter, const auto& value) {
      text_ += '`' + std::string(section) + (section.empty() ? "" : " ") + parameter.key + "` | " +
               allowed_text(parameter, value);
      if (missing_ == Missing::default_value) text_ += default_text(parameter, value);
      text_ += std::string(" |") + (*parameter.description == '\0' ? "" : " ") + parameter.description + '\n';
    });
    return *this;
  }

  const std::string& text() const noexcept { return text_; }

 private:
  static std::string default_text(const auto& parameter, const auto& value) {
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, double>)
      return ", " + number_text(to_file(parameter.range.unit, value));
    else if constexpr (requires { value_text(parameter, value); })
      return ", " + value_text(parameter, value);
    else
      return {};  // an optional value has no default
  }

  Missing missing_;
  std::string text_ = "key | allowed, default | meaning\n---|---|---\n";
};

// True if every number is in its range. A std::uint64_t is limited only in files, which hold numbers as doubles.
template <class S>
bool is_in_range(const S& object) {
  bool is = true;
  each_parameter(object, [&](const auto& parameter, const auto& value) {
    using Value = std::remove_cvref_t<decltype(value)>;
    if constexpr (std::is_same_v<Value, double> || std::is_same_v<Value, int>) {
      const Range range = allowed_range(parameter, object);
      const double number = to_file(parameter.range.unit, static_cast<double>(value));
      is = is && number >= range.min && number <= range.max;
    }
  });
  return is;
}

// Throws std::invalid_argument with one sentence: the first parameter out of range, its value and its range. where: the
// name of the table in files, such as "guard"; may be empty.
template <class S>
void check_parameters(const S& object, std::string_view where) {
  if (is_in_range(object)) return;
  each_parameter(object, [&](const auto& parameter, const auto& value) {
    using Value = std::remove_cvref_t<decltype(value)>;
    if constexpr (std::is_same_v<Value, double> || std::is_same_v<Value, int>) {
      const Range range = allowed_range(parameter, object);
      require_between(std::string(where) + (where.empty() ? "" : ".") + parameter.key,
                      to_file(parameter.range.unit, static_cast<double>(value)), range.min, range.max);
    }
  });
}

}  // namespace gearshift::haptics
