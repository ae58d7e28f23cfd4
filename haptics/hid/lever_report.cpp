#include "haptics/hid/lever_report.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "haptics/hid/hid_bytes.h"

namespace gearshift::haptics {
namespace {

constexpr std::uint16_t kSimulation = 0x02, kButton = 0x09;
constexpr std::size_t kIdBits = 8;

// Reads and writes the bytes that contain a field (at most 32 bits) as one number. `shift` is the field's position in
// this number.
struct Window {
  explicit Window(const BitField& field) noexcept
      : byte((kIdBits + static_cast<std::size_t>(field.offset)) / 8),
        shift(static_cast<int>((kIdBits + static_cast<std::size_t>(field.offset)) % 8)),
        bytes(static_cast<std::size_t>(shift + field.bits + 7) / 8),
        mask((std::uint64_t{1} << field.bits) - 1) {}

  std::uint64_t load(std::span<const std::uint8_t> report) const noexcept {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < bytes; ++i) value |= std::uint64_t{report[byte + i]} << (8 * i);
    return value;
  }
  void store(std::span<std::uint8_t> report, std::uint64_t value) const noexcept {
    for (std::size_t i = 0; i < bytes; ++i) report[byte + i] = static_cast<std::uint8_t>(value >> (8 * i));
  }

  std::size_t byte;
  int shift;
  std::size_t bytes;
  std::uint64_t mask;
};

// Limits the logical range to the values that the field's bits can hold. If the logical range is missing or inverted,
// the full range of the bits is used.
void limit_range(BitField& field) noexcept {
  const bool is_signed = field.min < 0;
  const std::int64_t min = is_signed ? -(std::int64_t{1} << (field.bits - 1)) : 0;
  const std::int64_t max = min + (std::int64_t{1} << field.bits) - 1;
  field.min = std::max(field.min, min);
  field.max = std::min(field.max, max);
  if (field.min < field.max) return;
  field.min = 0;
  field.max = (std::int64_t{1} << field.bits) - 1;
}

std::int64_t zero_of(const HidField& field, const BitField& range) noexcept {
  if (range.min < 0) return std::clamp(std::int64_t{0}, range.min, range.max);
  if (field.physical_min >= 0 || field.physical_max <= 0) return range.min;
  const double fraction =
      -static_cast<double>(field.physical_min) / static_cast<double>(field.physical_max - field.physical_min);
  return range.min + std::llround(fraction * static_cast<double>(range.max - range.min));
}

bool is_stick(const ReportDescriptor& descriptor, const HidField& field) {
  constexpr std::uint16_t joystick = 0x04, game_pad = 0x05, multi_axis = 0x08;
  return descriptor.is_within(field, {kGenericDesktop, joystick}) ||
         descriptor.is_within(field, {kGenericDesktop, game_pad}) ||
         descriptor.is_within(field, {kGenericDesktop, multi_axis});
}

bool is_axis(HidUsage usage, int bits) {
  if (usage.page == kGenericDesktop) return usage.id >= 0x30 && usage.id <= 0x38;
  return usage.page == kSimulation && usage.id >= 0xb0 && bits > 1;
}

// Number of elements that have a usage of their own; elements beyond the last usage are not used.
int usage_count(const HidField& field) {
  return std::min(field.count, static_cast<int>(field.usages.size()));
}

void add_axes(LeverReport& report, const HidField& field) {
  if (field.relative) return;
  for (int i = 0; i < usage_count(field); ++i) {
    const HidUsage usage = field.usage(i);
    const auto is_same_axis = [&](const HidAxis& axis) { return axis.usage == usage; };
    const BitField bits = bit_field(field, i);
    if (!bits.exists() || !is_axis(usage, bits.bits) || std::ranges::any_of(report.axes, is_same_axis)) continue;
    report.axes.push_back({usage, bits});
  }
}

void add_buttons(LeverReport& report, const HidField& field) {
  for (int i = 0; i < usage_count(field); ++i) {
    const HidUsage usage = field.usage(i);
    if (usage.page != kButton || usage.id == 0 || usage.id > kMaxButtons || field.bits != 1) continue;
    if (report.buttons.size() < usage.id) report.buttons.resize(usage.id);
    BitField& button = report.buttons[usage.id - 1U];
    if (!button.exists()) button = bit_field(field, i);
  }
}

bool has_axis(const LeverReport& report, HidUsage usage) {
  return std::ranges::any_of(report.axes, [&](const HidAxis& axis) { return axis.usage == usage; });
}

// Reduces the axes to kMaxAxes, but always keeps X and Y.
void drop_axes(LeverReport& report) {
  for (std::size_t i = report.axes.size(); i-- > 0 && report.axes.size() > kMaxAxes;) {
    const HidUsage usage = report.axes[i].usage;
    if (usage != kUsageX && usage != kUsageY) report.axes.erase(report.axes.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

LeverReport report_of(const ReportDescriptor& descriptor, std::uint8_t id) {
  LeverReport report;
  report.id = id;
  report.size = descriptor.report_size(ReportKind::input, id);
  for (const HidField& field : descriptor.fields) {
    if (field.kind != ReportKind::input || field.report_id != id || field.constant || field.array) continue;
    if (!is_stick(descriptor, field)) continue;
    add_axes(report, field);
    add_buttons(report, field);
  }
  drop_axes(report);
  return report;
}

}  // namespace

bool contains(std::span<const std::uint8_t> report, const BitField& field) noexcept {
  const auto offset = static_cast<std::size_t>(field.offset), bits = static_cast<std::size_t>(field.bits);
  return field.exists() && kIdBits + offset + bits <= 8 * report.size();
}

std::int64_t read_bits(std::span<const std::uint8_t> report, const BitField& field) noexcept {
  if (!contains(report, field)) return 0;
  const Window window(field);
  const auto value = static_cast<std::int64_t>(window.load(report) >> window.shift & window.mask);
  const std::int64_t sign = std::int64_t{1} << (field.bits - 1);
  return field.min < 0 && value >= sign ? value - 2 * sign : value;
}

void write_bits(std::span<std::uint8_t> report, const BitField& field, std::int64_t value) noexcept {
  if (!contains(report, field)) return;
  const Window window(field);
  const std::uint64_t bits = static_cast<std::uint64_t>(std::clamp(value, field.min, field.max)) & window.mask;
  const std::uint64_t others = window.load(report) & ~(window.mask << window.shift);
  window.store(report, others | bits << window.shift);
}

BitField bit_field(const HidField& field, int element) noexcept {
  constexpr int kMaxBits = 32;
  BitField result;
  if (field.bits > kMaxBits || element >= field.count) return result;
  result.offset = field.offset + element * field.bits;
  result.bits = field.bits;
  result.min = field.logical_min;
  result.max = field.logical_max;
  limit_range(result);
  result.zero = zero_of(field, result);
  return result;
}

std::optional<LeverReport> find_lever_report(const ReportDescriptor& descriptor) {
  std::array<bool, 256> seen{};
  for (const HidField& field : descriptor.fields) {
    if (field.kind != ReportKind::input || seen[field.report_id]) continue;
    seen[field.report_id] = true;
    LeverReport report = report_of(descriptor, field.report_id);
    if (report.size <= HidBytes::kMaxSize && has_axis(report, kUsageX) && has_axis(report, kUsageY)) return report;
  }
  return std::nullopt;
}

std::optional<LeverCounts> decode_lever(const LeverReport& layout, std::span<const std::uint8_t> report) noexcept {
  if (report.empty() || report[0] != layout.id) return std::nullopt;
  const auto is_missing = [&](const HidAxis& axis) {
    return (axis.usage == kUsageX || axis.usage == kUsageY) && !contains(report, axis.field);
  };
  if (std::ranges::any_of(layout.axes, is_missing)) return std::nullopt;
  LeverCounts counts;
  for (std::size_t i = 0; i < std::min(layout.axes.size(), kMaxAxes); ++i) {
    counts.axis[i] = read_bits(report, layout.axes[i].field);
  }
  for (std::size_t i = 0; i < std::min(layout.buttons.size(), kMaxButtons); ++i) {
    if (read_bits(report, layout.buttons[i]) != 0) counts.buttons |= std::uint64_t{1} << i;
  }
  return counts;
}

}  // namespace gearshift::haptics
