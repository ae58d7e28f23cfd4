// CSV tables.
//
// This work is based on:
// Y. Shafranovich. RFC 4180, Common Format and MIME Type for Comma-Separated Values (CSV) Files. 2005
#pragma once

#include <concepts>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace gearshift::base {

// Puts a field in double quotes if it contains a comma, a double quote or a line end, and doubles the quotes in it.
std::string csv_field(std::string_view text);

// Significant digits of floating-point numbers: precise enough for every result, but few enough that 13.379 is not
// printed as 13.379000000000001.
inline constexpr int kCsvDigits = 12;

// Builds a table field by field; the caller writes the column names as the first line. Independent of the locale.
class CsvTable {
 public:
  CsvTable& text(std::string_view field);
  // Adding 0.0 removes the sign of a negative zero.
  CsvTable& number(std::floating_point auto value) { return text(fmt::format("{:.{}g}", value + 0.0, kCsvDigits)); }
  CsvTable& number(std::integral auto value) { return text(fmt::format("{}", value)); }
  CsvTable& flag(bool on) { return text(on ? "1" : "0"); }
  CsvTable& texts(std::initializer_list<std::string_view> fields);
  void end();  // ends the line
  std::string take() && { return std::move(text_); }

 private:
  std::string text_;
  bool first_ = true;  // true if the next field is the first in its line
};

}  // namespace gearshift::base
