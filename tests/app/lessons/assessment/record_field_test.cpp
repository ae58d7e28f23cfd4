// Tests that the lists of fields of the records have every member, each once: what a list lacks is lost in the history.
#include <set>
#include <string_view>

#include <doctest/doctest.h>

#include "app/lessons/assessment/lesson_result.h"
#include "haptics/files/parameter.h"

namespace gearshift::test {
namespace {

// others: members that are no fields. nested: fields in a member that is a record, instead of that member.
template <class Record>
void check_fields(const Record& record, const std::set<const void*>& others = {}, std::size_t nested = 0) {
  std::set<const void*> members = others;
  std::set<std::string_view> names;
  each_field(record, [&](const lessons::RecordField& field, const auto& member) {
    CAPTURE(field.name);
    CHECK(members.insert(&member).second);
    CHECK(names.insert(field.name).second);
  });
  CHECK(members.size() == haptics::member_count<Record>() + nested - (nested > 0 ? 1 : 0));
}

}  // namespace

TEST_CASE("every member of a record is one field with a name of its own, except those that are stored otherwise") {
  check_fields(lessons::ShiftRecord{});
  check_fields(lessons::DrivingError{});
  const lessons::LessonResult result;
  check_fields(lessons::RunFigures{});
  check_fields(result, {&result.errors, &result.shifts, &result.had_forces},
               haptics::member_count<lessons::RunFigures>());
}

}  // namespace gearshift::test
