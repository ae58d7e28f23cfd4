// One list of fields per record: each_field(record, visit), beside ShiftRecord, LessonResult and DrivingError, calls
// visit(field, member) for every field. The columns of the history and of CSV files and the report's table of shifts
// derive from these lists. A test (record_field_test.cpp) checks that no member is missing.
#pragma once

#include <concepts>
#include <type_traits>

namespace gearshift::lessons {

struct RecordField {
  const char* name;        // column in the history and in CSV files, with its unit
  const char* label = "";  // column in the report's table of shifts, with its unit; empty: not in that table
  int decimals = 0;        // in that table
  bool is_gear = false;    // a gear, whose name is written to CSV files
};

template <class Record, class Of>
concept FieldsOf = std::same_as<std::remove_cvref_t<Record>, Of>;

}  // namespace gearshift::lessons
