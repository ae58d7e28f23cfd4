#include "haptics/loop/trace_csv.h"

#include <cerrno>
#include <charconv>
#include <cstring>
#include <string_view>
#include <type_traits>
#include <utility>

#include "haptics/files/file_error.h"
#include "haptics/files/parameter_file.h"
#include "haptics/loop/trace_fields.h"
#include "haptics/loop/trace_format.h"

namespace gearshift::haptics {
namespace {

constexpr int kDigits = 12;  // significant digits; the trace itself is lossless

// The unit in the column of a field, which the trace holds in SI units. Fields that are not listed have no unit.
struct ColumnUnit {
  std::string_view field, unit;
  double scale;  // from the SI unit
};
constexpr ColumnUnit kUnits[] = {
    {"lever", "_mm", 1e3},
    {"proxy", "_mm", 1e3},
    {"position", "_mm", 1e3},
    {"wall_force", "_n", 1.0},
    {"feel_force", "_n", 1.0},
    {"load_force", "_n", 1.0},
    {"commanded", "_n", 1.0},
    {"f_h", "_n", 1.0},
    {"f_a", "_n", 1.0},
    {"f_j", "_n", 1.0},
    {"hand_force", "_n", 1.0},
    {"actuator_force", "_n", 1.0},
    {"slope", "_rad", 1.0},
    {"velocity", "_mm_per_s", 1e3},
    {"road_speed", "_m_per_s", 1.0},
    {"wall_stiffness", "_n_per_m", 1.0},
};
constexpr ColumnUnit unit_of(std::string_view field) {
  for (const ColumnUnit& unit : kUnits)
    if (unit.field == field) return unit;
  return {field, "", 1.0};
}

// Collects the cells of one line. The same code builds the header line and the data lines, so that their columns match.
class Row {
 public:
  explicit Row(bool names) : names_(names) {}

  template <class T>
  void cell(std::string_view name, T value) {
    if (!text_.empty()) text_ += ',';
    if (names_)
      text_ += name;
    else if constexpr (std::is_convertible_v<T, std::string_view>)
      text_ += value;
    else
      number(value);
  }

  std::string take() { return std::move(text_); }

 private:
  template <class T>
  void number(T value) {
    char text[64];
    char* const end = text + sizeof text;
    if constexpr (std::is_same_v<T, double>)
      text_.append(text, std::to_chars(text, end, value, std::chars_format::general, kDigits).ptr);
    else if constexpr (std::is_same_v<T, bool>)
      text_ += value ? '1' : '0';
    else
      text_.append(text, std::to_chars(text, end, value).ptr);
  }

  bool names_;
  std::string text_;
};

// Adds the columns of a field; those of a struct are named `prefix` and the member's name.
template <class T>
void add(Row& row, const std::string& prefix, std::string_view field, const T& value) {
  const ColumnUnit unit = unit_of(field);
  const std::string name = prefix + std::string(field);
  if constexpr (std::is_same_v<T, glm::dvec2>) {
    row.cell(name + "_x" + std::string(unit.unit), unit.scale * value.x);
    row.cell(name + "_y" + std::string(unit.unit), unit.scale * value.y);
  } else if constexpr (std::is_same_v<T, double>) {
    row.cell(name + std::string(unit.unit), unit.scale * value);
  } else if constexpr (std::is_enum_v<T>) {
    row.cell(name, to_string(value));
  } else if constexpr (LeafField<T>) {
    row.cell(name, value);
  } else {
    each_field(value, [&](const char* member, const auto& inner) { add(row, prefix, member, inner); });
  }
}

void add_flags(Row& row, std::uint32_t flags) {
  constexpr std::pair<const char*, std::uint32_t> kFlags[] = {
      {"contact", kFlagContact},    {"saturated", kFlagSaturated},
      {"over_push", kFlagOverPush}, {"push_estimated", kFlagPushEstimated},
      {"ghost", kFlagGhost},        {"fresh", kFlagFresh}};
  for (const auto& [name, bit] : kFlags) row.cell(name, (flags & bit) != 0);
}

std::string row_of(const TraceSample& sample, std::int64_t first_ns, bool names) {
  const auto& [deadline_ns, skipped, reading, controls, tuning, command, out] = sample;
  const auto seconds = [first_ns](std::int64_t ns) {
    return 1e-9 * static_cast<double>(nanoseconds_between(first_ns, ns));
  };
  Row row(names);
  row.cell("time_s", seconds(deadline_ns));
  each_field(out, [&](std::string_view field, const auto& value) {
    if (field == "time_ns") return;  // the deadline
    if (field == "flags") return add_flags(row, sample.out.flags);
    add(row, "", field, value);
  });
  row.cell("skipped_cycles", skipped);
  each_field(reading, [&](std::string_view field, const auto& value) {
    if (field == "time_ns") return row.cell("reading_time_s", seconds(sample.reading.time_ns));
    add(row, "reading_", field, value);
  });
  add(row, "", "", controls);
  each_parameter(tuning, [&](const auto& parameter, double value) {
    row.cell("tuning_" + std::string(parameter.key), to_file(parameter.range.unit, value));
  });
  row.cell("command", to_string(command));
  return row.take();
}

}  // namespace

std::string trace_csv_header() {
  return row_of(TraceSample{}, 0, true);
}

std::string trace_csv_line(const TraceSample& sample, std::int64_t first_ns) {
  return row_of(sample, first_ns, false);
}

TraceCsvFile::TraceCsvFile(const std::filesystem::path& file) : name_(file.string()), part_(file) {
  part_.prepare();
  errno = 0;
  stream_.open(part_.path(), std::ios::binary);
  if (!stream_) throw FileError(name_, 0, std::string("cannot be written (") + std::strerror(errno) + ")");
  stream_ << trace_csv_header() << '\n';
}

void TraceCsvFile::add(const TraceSample& sample) {
  if (!first_ns_) first_ns_ = sample.deadline_ns;
  stream_ << trace_csv_line(sample, *first_ns_) << '\n';
}

void TraceCsvFile::finish() {
  errno = 0;
  stream_.close();
  if (!stream_) throw FileError(name_, 0, std::string("could not be written (") + std::strerror(errno) + ")");
  part_.commit();
}

}  // namespace gearshift::haptics
