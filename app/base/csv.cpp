#include "app/base/csv.h"

namespace gearshift::base {

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

CsvTable& CsvTable::text(std::string_view field) {
  if (!first_) text_ += format_.separator;
  first_ = false;
  text_ += csv_field(field, format_.separator);
  return *this;
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
