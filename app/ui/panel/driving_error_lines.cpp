#include "app/ui/panel/driving_error_lines.h"

#include <algorithm>

#include "app/lessons/assessment/driving_error.h"
#include "app/ui/panel/palette.h"
#include "app/ui/panel/text_lines.h"

namespace gearshift::ui {

bool needs_advice(const lessons::LessonResult& result, std::size_t error, const std::vector<std::size_t>& listed) {
  const lessons::ErrorKind kind = result.errors[error].kind;
  const bool is_repeated =
      std::any_of(listed.begin(), listed.end(), [&](std::size_t other) { return result.errors[other].kind == kind; });
  return !is_repeated && result.errors[error].severity != lessons::Severity::note &&
         !lessons::error_advice(kind).empty();
}

void put_advice(lessons::ErrorKind kind) {
  put_wrapped(lessons::error_advice(kind), ink::kAccent);
}

}  // namespace gearshift::ui
