#include "haptics/loop/trace_csv.h"

#include <cerrno>
#include <charconv>
#include <cstring>
#include <string_view>
#include <type_traits>
#include <utility>

#include "haptics/files/file_error.h"
#include "haptics/loop/trace_format.h"

namespace gearshift::haptics {
namespace {

constexpr double kMm = 1e3;  // [mm/m]
constexpr int kDigits = 12;  // significant digits; the trace itself is lossless

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

  void pair(const std::string& name, const std::string& unit, glm::dvec2 v, double scale) {
    cell(name + "_x_" + unit, scale * v.x);
    cell(name + "_y_" + unit, scale * v.y);
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

void add_motion(Row& row, const HapticSnapshot& out) {
  row.pair("lever", "mm", out.lever, kMm);
  row.pair("proxy", "mm", out.proxy, kMm);
  row.pair("velocity", "mm_per_s", out.velocity, kMm);
}

void add_forces(Row& row, const HapticSnapshot& out) {
  row.pair("wall_force", "n", out.wall_force, 1.0);
  row.pair("feel_force", "n", out.feel_force, 1.0);
  row.pair("load_force", "n", out.load_force, 1.0);
  row.pair("commanded", "n", out.commanded, 1.0);
  row.pair("f_h", "n", out.f_h, 1.0);
  row.pair("f_a", "n", out.f_a, 1.0);
  row.pair("f_j", "n", out.f_j, 1.0);
}

void add_state(Row& row, const HapticSnapshot& out) {
  const auto flag = [&](const char* name, std::uint32_t bit) { row.cell(name, (out.flags & bit) != 0); };
  row.cell("gear", out.gear);
  row.cell("slot", out.slot);
  row.cell("road_speed_m_per_s", out.road_speed);
  row.cell("guard", to_string(out.guard));
  row.cell("fault", to_string(out.fault));
  flag("contact", kFlagContact);
  flag("saturated", kFlagSaturated);
  flag("over_push", kFlagOverPush);
  flag("push_estimated", kFlagPushEstimated);
  flag("ghost", kFlagGhost);
  flag("fresh", kFlagFresh);
}

void add_inputs(Row& row, const TraceSample& sample) {
  row.cell("skipped_cycles", sample.skipped);
  row.cell("reading_sequence", sample.reading.sequence);
  row.pair("reading", "mm", sample.reading.position, kMm);
  row.pair("hand_force", "n", sample.reading.hand_force, 1.0);
  row.pair("actuator_force", "n", sample.reading.actuator_force, 1.0);
  row.cell("pressed_down", sample.reading.pressed_down);
  row.cell("lifted", sample.reading.lifted);
  row.cell("throttle", sample.controls.pedals.throttle);
  row.cell("brake", sample.controls.pedals.brake);
  row.cell("clutch", sample.controls.pedals.clutch);
  row.cell("hand_brake", sample.controls.pedals.hand_brake);
  row.cell("ignition", sample.controls.ignition);
  row.cell("starter", sample.controls.starter);
  row.cell("slope_rad", sample.controls.slope);
  row.cell("guided_gear", sample.controls.guided_gear);
  row.cell("guidance", sample.controls.guidance);
  each_parameter(sample.tuning, [&](const auto& parameter, double value) { row.cell(parameter.key, value); });
  row.cell("command", to_string(sample.command));
}

std::string row_of(const TraceSample& sample, std::int64_t first_ns, bool names) {
  Row row(names);
  row.cell("cycle", sample.out.cycle);
  row.cell("time_s", 1e-9 * static_cast<double>(nanoseconds_between(first_ns, sample.deadline_ns)));
  add_motion(row, sample.out);
  add_forces(row, sample.out);
  add_state(row, sample.out);
  add_inputs(row, sample);
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
