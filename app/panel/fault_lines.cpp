#include "app/panel/fault_lines.h"

#include <algorithm>

#include "app/panel/text_lines.h"
#include "app/training/drive_fault.h"

namespace gearshift {

bool needs_advice(const LessonResult& result, std::size_t fault, const std::vector<std::size_t>& told) {
  const FaultKind kind = result.faults[fault].kind;
  const bool is_told =
      std::any_of(told.begin(), told.end(), [&](std::size_t other) { return result.faults[other].kind == kind; });
  return !is_told && result.faults[fault].severity != Severity::note && !fault_advice(kind).empty();
}

void put_advice(FaultKind kind) {
  put_wrapped(fault_advice(kind), ink::kAccent);
}

}  // namespace gearshift
