#include "haptics/hid/pid_layout.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "haptics/hid/hid_bytes.h"

namespace gearshift::haptics {
namespace {

constexpr std::uint16_t kOrdinal = 0x0a;

constexpr HidUsage pid_usage(std::uint16_t id) noexcept {
  return {0x0f, id};
}

// Usages of the Physical Interface page, in the order of the corresponding enumerators in pid_layout.h.
constexpr std::array<std::uint16_t, kPidEffects> kEffectUsages{0x26, 0x27, 0x30, 0x31, 0x32, 0x33,
                                                               0x34, 0x40, 0x41, 0x42, 0x43};
constexpr std::array<std::uint16_t, kPidControls> kControlUsages{0x97, 0x98, 0x99, 0x9a, 0x9b, 0x9c};
constexpr std::array<std::uint16_t, kPidOperations> kOperationUsages{0x79, 0x7a, 0x7b};
constexpr std::array<std::uint16_t, 3> kStatusUsages{0x8c, 0x8d, 0x8e};
constexpr std::uint16_t kBlock = 0x22;

struct FieldElement {
  const HidField* field = nullptr;
  int element = 0;

  BitField bits() const noexcept { return field == nullptr ? BitField{} : bit_field(*field, element); }
};

// All fields of one report: the fields of the given kind inside a collection with the given usage. The first such field
// determines the report ID; fields with another ID are left out. Empty if the report is longer than HidBytes::kMaxSize.
class ReportView {
 public:
  ReportView(const ReportDescriptor& descriptor, ReportKind kind, HidUsage collection) : descriptor_(descriptor) {
    for (const HidField& field : descriptor.fields) {
      if (field.kind != kind || !descriptor.is_within(field, collection)) continue;
      if (!fields_.empty() && fields_.front()->report_id != field.report_id) continue;
      fields_.push_back(&field);
    }
    if (fields_.empty()) return;
    report_.id = fields_.front()->report_id;
    report_.size = descriptor.report_size(kind, report_.id);
    if (report_.size <= HidBytes::kMaxSize) return;
    report_ = {};
    fields_.clear();
  }

  PidReport report() const { return report_; }

  FieldElement find(HidUsage usage) const {
    for (const HidField* field : fields_) {
      if (field->array && field->usages.size() != 1) continue;
      for (int i = 0; i < field->count && i < static_cast<int>(field->usages.size()); ++i) {
        if (field->usage(i) == usage) return {field, i};
      }
    }
    return {};
  }
  BitField value(std::uint16_t id) const { return find(pid_usage(id)).bits(); }

  // The fields of this view that are inside a collection with the given usage.
  ReportView within(HidUsage collection) const {
    ReportView result = *this;
    std::erase_if(result.fields_, [&](const HidField* field) { return !descriptor_.is_within(*field, collection); });
    return result;
  }

  // Finds one element for X and one for Y by their axis usages. An axis without such a usage is found by its ordinal.
  std::array<FieldElement, 2> of_axes() const {
    std::array<FieldElement, 2> result;
    for (std::uint16_t axis = 0; axis < 2; ++axis) {
      FieldElement& place = result[axis];
      place = find({kGenericDesktop, static_cast<std::uint16_t>(0x30 + axis)});
      if (place.field == nullptr) place = find({kOrdinal, static_cast<std::uint16_t>(1 + axis)});
    }
    return result;
  }

  template <std::size_t N>
  PidChoice<N> choice(const std::array<std::uint16_t, N>& ids) const {
    PidChoice<N> result;
    for (const HidField* field : fields_) {
      for (std::size_t i = 0; i < N; ++i) add_choice(result, i, *field, pid_usage(ids[i]));
    }
    return result;
  }

 private:
  template <std::size_t N>
  static void add_choice(PidChoice<N>& choice, std::size_t which, const HidField& field, HidUsage usage) {
    const auto found = std::find(field.usages.begin(), field.usages.end(), usage);
    if (choice.supported[which] || found == field.usages.end()) return;
    const auto index = static_cast<int>(found - field.usages.begin());
    // If a multi-bit field has more usages than elements, its value selects one of the usages, even if the field is not
    // flagged as an array.
    if (field.bits > 1 && (field.array || static_cast<int>(field.usages.size()) > field.count)) {
      const BitField bits = bit_field(field, 0);
      const std::int64_t number = field.logical_min + index;
      if (!bits.exists() || number < bits.min || number > bits.max) return;
      if (choice.field.exists() && choice.field.offset != bits.offset) return;
      choice.field = bits;
      choice.number[which] = number;
      choice.supported[which] = true;
    } else if (BitField bit = bit_field(field, index); bit.exists()) {
      bit.min = bit.zero = 0;
      bit.max = 1;
      choice.bit[which] = bit;
      choice.supported[which] = true;
    }
  }

  const ReportDescriptor& descriptor_;
  PidReport report_;
  std::vector<const HidField*> fields_;
};

std::array<BitField, 2> bits_of(const std::array<FieldElement, 2>& places) {
  return {places[0].bits(), places[1].bits()};
}

double power_of_ten(int exponent) {
  return std::pow(10.0, exponent);
}

// Physical size of one count; 1 if the field has no physical range.
double physical_per_count(const HidField& field) {
  const auto logical = static_cast<double>(field.logical_max - field.logical_min);
  const auto physical = static_cast<double>(field.physical_max - field.physical_min);
  return logical > 0.0 && physical > 0.0 ? physical / logical : 1.0;
}

// [s] per count. If the field has no unit of time, a count is a millisecond, as on all known devices.
double duration_unit(const FieldElement& place) {
  constexpr std::uint32_t dimensions = 0xfffffff0, time = 0x1000;  // unit code of seconds: HID 1.11 section 6.2.2.7
  if (place.field == nullptr || (place.field->unit & dimensions) != time) return 1e-3;
  return physical_per_count(*place.field) * power_of_ten(place.field->unit_exponent);
}

// [counts] per 360 degrees of direction. The logical range is one turn, unless the physical range gives the angle
// exactly, such as 0 to 35999 hundredths of a degree.
double full_turn(const FieldElement& place) {
  if (place.field == nullptr) return 0.0;
  const BitField range = place.bits();
  const auto counts = static_cast<double>(range.max - range.min);
  const double degrees = static_cast<double>(place.field->physical_max - place.field->physical_min) *
                         power_of_ten(place.field->unit_exponent);
  return degrees >= 359.0 && degrees <= 361.0 ? counts * 360.0 / degrees : counts;
}

template <typename Report>
Report begin(const ReportView& view) {
  Report report;
  static_cast<PidReport&>(report) = view.report();
  return report;
}

// The direction fields: one per axis inside the Direction collection. If there are none, the one field with the
// Direction usage.
std::array<FieldElement, 2> directions(const ReportView& view) {
  const std::array<FieldElement, 2> result = view.within(pid_usage(0x57)).of_axes();
  return result[0].field != nullptr ? result : std::array<FieldElement, 2>{view.find(pid_usage(0x57)), FieldElement{}};
}

PidSetEffect set_effect_of(const ReportDescriptor& descriptor) {
  const ReportView view(descriptor, ReportKind::output, pid_usage(0x21));
  auto report = begin<PidSetEffect>(view);
  report.block = view.value(kBlock);
  report.type = view.choice(kEffectUsages);
  const FieldElement duration = view.find(pid_usage(0x50));
  report.duration = duration.bits();
  report.duration_unit = duration_unit(duration);
  report.sample_period = view.value(0x51);
  report.gain = view.value(0x52);
  report.trigger_button = view.value(0x53);
  report.trigger_repeat = view.value(0x54);
  report.axis_enable = bits_of(view.within(pid_usage(0x55)).of_axes());
  report.direction_enable = view.value(0x56);
  const std::array<FieldElement, 2> direction = directions(view);
  report.direction = bits_of(direction);
  report.full_turn = full_turn(direction[0]);
  report.place = bits_of(view.within(pid_usage(0x58)).of_axes());
  report.start_delay = view.value(0xa7);
  return report;
}

PidSetConstant set_constant_of(const ReportDescriptor& descriptor) {
  const ReportView view(descriptor, ReportKind::output, pid_usage(0x73));
  auto report = begin<PidSetConstant>(view);
  report.block = view.value(kBlock);
  if (!report.block.exists()) report.place = view.value(0x23);
  report.magnitude = view.value(0x70);
  return report;
}

PidSetCondition set_condition_of(const ReportDescriptor& descriptor) {
  const ReportView view(descriptor, ReportKind::output, pid_usage(0x5f));
  auto report = begin<PidSetCondition>(view);
  report.block = view.value(kBlock);
  report.parameter_block = view.value(0x23);
  report.centre = view.value(0x60);
  report.positive_coefficient = view.value(0x61);
  report.negative_coefficient = view.value(0x62);
  report.positive_saturation = view.value(0x63);
  report.negative_saturation = view.value(0x64);
  report.dead_band = view.value(0x65);
  return report;
}

PidOperate operate_of(const ReportDescriptor& descriptor) {
  const ReportView view(descriptor, ReportKind::output, pid_usage(0x77));
  auto report = begin<PidOperate>(view);
  report.block = view.value(kBlock);
  report.operation = view.choice(kOperationUsages);
  report.loops = view.value(0x7c);
  return report;
}

// Usage 0x95 is the Device Control report, 0x96 the choice in it; some devices have only one of the two.
PidDeviceControl device_control_of(const ReportDescriptor& descriptor) {
  for (const HidUsage usage : {pid_usage(0x96), pid_usage(0x95)}) {
    const ReportView view(descriptor, ReportKind::output, usage);
    auto report = begin<PidDeviceControl>(view);
    report.control = view.choice(kControlUsages);
    if (std::ranges::any_of(report.control.supported, [](bool supported) { return supported; })) return report;
  }
  return {};
}

PidGain gain_of(const ReportDescriptor& descriptor) {
  const ReportView view(descriptor, ReportKind::output, pid_usage(0x7d));
  auto report = begin<PidGain>(view);
  report.gain = view.value(0x7e);
  return report;
}

PidBlockFree block_free_of(const ReportDescriptor& descriptor) {
  const ReportView view(descriptor, ReportKind::output, pid_usage(0x90));
  auto report = begin<PidBlockFree>(view);
  report.block = view.value(kBlock);
  return report;
}

PidCreate create_of(const ReportDescriptor& descriptor) {
  const ReportView view(descriptor, ReportKind::feature, pid_usage(0xab));
  auto report = begin<PidCreate>(view);
  report.type = view.choice(kEffectUsages);
  report.byte_count = view.find({kGenericDesktop, 0x3b}).bits();
  return report;
}

PidBlockLoad block_load_of(const ReportDescriptor& descriptor) {
  const ReportView view(descriptor, ReportKind::feature, pid_usage(0x89));
  auto report = begin<PidBlockLoad>(view);
  report.block = view.value(kBlock);
  report.status = view.choice(kStatusUsages);
  report.ram_available = view.value(0xac);
  return report;
}

PidPool pool_of(const ReportDescriptor& descriptor) {
  const ReportView view(descriptor, ReportKind::feature, pid_usage(0x7f));
  auto report = begin<PidPool>(view);
  report.ram_size = view.value(0x80);
  report.simultaneous = view.value(0x83);
  report.device_managed = view.value(0xa9);
  report.shared_parameters = view.value(0xaa);
  return report;
}

PidState state_of(const ReportDescriptor& descriptor) {
  const ReportView view(descriptor, ReportKind::input, pid_usage(0x92));
  auto report = begin<PidState>(view);
  report.block = view.value(kBlock);
  report.playing = view.value(0x94);
  report.paused = view.value(0x9f);
  report.actuators_enabled = view.value(0xa0);
  report.safety_switch = view.value(0xa4);
  report.override_switch = view.value(0xa5);
  report.actuator_power = view.value(0xa6);
  return report;
}

// True if the device can make a constant force. A rumble-only gamepad also has a Set Effect report, but no effect
// blocks.
bool can_push(const PidLayout& pid) {
  const bool is_addressed = pid.set_constant.block.exists() || (pid.is_pool_ours() && pid.set_effect.place[0].exists());
  return pid.set_effect.exists() && pid.set_effect.block.exists() && is_addressed &&
         pid.set_constant.magnitude.exists() && pid.operate.exists() && pid.operate.block.exists() &&
         pid.operate.operation.supports(static_cast<std::size_t>(PidOperation::start));
}

}  // namespace

const char* to_string(PidEffect effect) noexcept {
  constexpr std::array<const char*, kPidEffects> names{"constant force", "ramp",        "square",        "sine",
                                                       "triangle",       "sawtooth up", "sawtooth down", "spring",
                                                       "damper",         "inertia",     "friction"};
  return names[static_cast<std::size_t>(effect)];
}

std::optional<PidLayout> find_pid(const ReportDescriptor& descriptor) {
  PidLayout pid;
  pid.set_effect = set_effect_of(descriptor);
  pid.set_constant = set_constant_of(descriptor);
  pid.set_condition = set_condition_of(descriptor);
  pid.operate = operate_of(descriptor);
  pid.device_control = device_control_of(descriptor);
  pid.gain = gain_of(descriptor);
  pid.block_free = block_free_of(descriptor);
  pid.create = create_of(descriptor);
  pid.block_load = block_load_of(descriptor);
  pid.pool = pool_of(descriptor);
  pid.state = state_of(descriptor);
  if (!can_push(pid)) return std::nullopt;
  return pid;
}

}  // namespace gearshift::haptics
