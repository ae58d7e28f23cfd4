#include "app/base/csv.h"

#include "haptics/files/printable.h"

namespace gearshift::base {
namespace {

// A spreadsheet takes the full-width forms for the same signs. A single sign is no formula.
bool is_formula(std::string_view text) {
  if (text.size() < 2) return false;
  for (const std::string_view sign : {"=", "+", "-", "@", "\uff1d", "\uff0b", "\uff0d", "\uff20"})
    if (text.starts_with(sign)) return true;
  return false;
}

}  // namespace

std::string csv_field(std::string_view text, char separator) {
  const char special[] = {separator, '"', '\r', '\n', '\0'};
  if (text.find_first_of(special) == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

CsvTable& CsvTable::field(std::string_view text) {
  if (!first_) text_ += format_.separator;
  first_ = false;
  text_ += csv_field(text, format_.separator);
  return *this;
}

CsvTable& CsvTable::text(std::string_view text) {
  const std::string lines = haptics::printable_lines(text);
  return field(is_formula(lines) ? "'" + lines : lines);
}

CsvTable& CsvTable::texts(std::initializer_list<std::string_view> fields) {
  for (const std::string_view field : fields) text(field);
  return *this;
}

void CsvTable::end() {
  text_ += "\r\n";
  first_ = true;
}

}  // namespace gearshift::base
