// CSV tables.
//
// This work is based on:
// Y. Shafranovich. RFC 4180, Common Format and MIME Type for Comma-Separated Values (CSV) Files. 2005
// OWASP. CSV Injection
#pragma once

#include <algorithm>
#include <concepts>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace gearshift::base {

// The default is for programs. A spreadsheet expects the list separator and the decimal sign of its locale (both together:
// a semicolon where the decimal sign is a comma), and takes a file without a byte order mark for an old code page.
struct CsvFormat {
  char separator = ',';
  bool has_decimal_comma = false;
  bool has_byte_order_mark = false;  // UTF-8
};

// Puts a field in double quotes if it contains the separator, a double quote or a line end, and doubles the quotes in it.
std::string csv_field(std::string_view text, char separator = ',');

// Significant digits of floating-point numbers: precise enough for every result, but few enough that 13.379 is not
// printed as 13.379000000000001.
inline constexpr int kCsvDigits = 12;

// Builds a table field by field; the caller writes the column names as the first line. Independent of the locale.
class CsvTable {
 public:
  explicit CsvTable(const CsvFormat& format = {})
      : format_(format), text_(format.has_byte_order_mark ? "\ufeff" : "") {}

  // A text that a spreadsheet would run as a formula gets an apostrophe in front, as OWASP advises. Lines are printable
  // (haptics/files/printable.h).
  CsvTable& text(std::string_view text);
  // Adding 0.0 removes the sign of a negative zero.
  CsvTable& number(std::floating_point auto value) {
    std::string digits = fmt::format("{:.{}g}", value + 0.0, kCsvDigits);
    if (format_.has_decimal_comma) std::replace(digits.begin(), digits.end(), '.', ',');
    return field(digits);
  }
  CsvTable& number(std::integral auto value) { return field(fmt::format("{}", value)); }
  CsvTable& flag(bool on) { return text(on ? "1" : "0"); }
  CsvTable& texts(std::initializer_list<std::string_view> fields);
  void end();  // ends the line
  std::string take() && { return std::move(text_); }

 private:
  CsvTable& field(std::string_view text);

  CsvFormat format_;
  std::string text_;
  bool first_ = true;  // true if the next field is the first in its line
};

}  // namespace gearshift::base
