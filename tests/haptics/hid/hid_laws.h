// What holds of any bytes that pass for a report descriptor. Empty: all of it; else the law that is broken.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

#include "haptics/hid/hid_bytes.h"
#include "haptics/hid/hid_error.h"
#include "haptics/hid/lever_report.h"
#include "haptics/hid/pid_layout.h"
#include "haptics/hid/pid_report.h"
#include "haptics/hid/report_descriptor.h"

namespace gearshift {

class HidLaws {
 public:
  // Reports are filled with the salt, again and again.
  explicit HidLaws(std::span<const std::uint8_t> salt) : salt_(salt) {}

  std::string broken_by(std::span<const std::uint8_t> bytes) {
    ReportDescriptor descriptor;
    try {
      descriptor = parse_report_descriptor(bytes);
    } catch (const HidError& error) {  // the only thing that it may throw
      const std::string sentence = error.what();
      hold(sentence.starts_with("report descriptor, byte ") && sentence.find('\n') == std::string::npos,
           "one sentence");
      return broken_;
    }
    check_fields(descriptor);
    if (const auto lever = find_lever_report(descriptor)) check_lever(descriptor, *lever);
    if (const auto pid = find_pid(descriptor)) check_pid(descriptor, *pid);
    return broken_;
  }

  int levers = 0, pid_devices = 0;  // seen

 private:
  void hold(bool law, const char* name) {
    if (!law && broken_.empty()) broken_ = name;
  }

  void check_fields(const ReportDescriptor& descriptor) {
    for (std::size_t i = 0; i < descriptor.collections.size(); ++i) {
      const int parent = descriptor.collections[i].parent;
      hold(parent >= -1 && parent < static_cast<int>(i), "a collection begins after the one that it is in");
    }
    std::array<std::array<int, 256>, 3> ends{};
    for (const HidField& field : descriptor.fields) {
      int& end = ends[static_cast<std::size_t>(field.kind)][field.report_id];
      hold(field.bits > 0 && field.count > 0, "a field is of something");
      hold(field.offset == end, "fields lie side by side");
      end += field.bits * field.count;
      hold(end <= 8 * 65535, "a report's length is told in 16 bits");
      hold(field.collection >= -1 && field.collection < static_cast<int>(descriptor.collections.size()),
           "a field's collection exists");
      hold(field.usages.size() <= 1024, "usages are bounded");
      if (field.report_id != 0) hold(descriptor.numbered, "IDs are numbers of reports");
    }
    for (const HidField& field : descriptor.fields) {
      const int end = ends[static_cast<std::size_t>(field.kind)][field.report_id];
      hold(descriptor.report_size(field.kind, field.report_id) == 1 + (static_cast<std::size_t>(end) + 7) / 8,
           "a report is as long as its fields");
    }
  }

  void check_field(const BitField& field, std::size_t size) {
    if (!field.exists()) return;
    hold(field.offset >= 0 && field.bits <= 32 && 8 + field.offset + field.bits <= static_cast<int>(8 * size),
         "no field lies outside its report");
    hold(field.min < field.max && field.zero >= field.min && field.zero <= field.max, "a field has a range");
    std::vector<std::uint8_t> report = salted(size);
    for (const std::int64_t value : {field.min, field.zero, field.max, field.min + (field.max - field.min) / 3}) {
      write_bits(report, field, value);
      hold(read_bits(report, field) == value, "what is written is read");
    }
    write_bits(report, field, field.max + 1);
    hold(read_bits(report, field) == field.max, "no more than the most is written");
  }

  std::vector<std::uint8_t> salted(std::size_t size) {
    std::vector<std::uint8_t> report(size);
    for (std::uint8_t& byte : report) byte = salt_.empty() ? 0 : salt_[next_++ % salt_.size()];
    return report;
  }

  void check_lever(const ReportDescriptor& descriptor, const LeverReport& lever) {
    ++levers;
    hold(lever.size == descriptor.report_size(ReportKind::input, lever.id) && lever.size <= HidBytes::kMost,
         "a lever's report is one of the device's");
    hold(lever.axes.size() >= 2 && lever.axes.size() <= kMostAxes && lever.buttons.size() <= kMostButtons,
         "a lever has two axes and more");
    std::vector<std::uint8_t> report = salted(lever.size);
    report[0] = lever.id;
    for (const HidAxis& axis : lever.axes) {
      check_field(axis.field, lever.size);
      write_bits(report, axis.field, axis.field.zero);
    }
    for (const BitField& button : lever.buttons) check_field(button, lever.size);
    const auto counts = decode_lever(lever, report);
    hold(counts.has_value(), "a report of its ID and length is read");
    for (std::size_t i = 0; counts && i < lever.axes.size(); ++i) {
      hold(counts->axis[i] == lever.axes[i].field.zero, "an axis is read as it was written");
    }
    report.push_back(0);
    hold(!decode_lever(lever, report), "a report of another length is not read");
  }

  // size: of the report in the descriptor.
  void check_bytes(const HidBytes& bytes, const PidReport& layout) {
    if (bytes.size == 0) return;
    hold(bytes.size == layout.size && bytes.id() == layout.id, "an encoded report is as long as the device's");
  }

  void check_report(const ReportDescriptor& descriptor, const PidReport& report, ReportKind kind,
                    std::initializer_list<BitField> fields) {
    if (!report.exists()) return;
    hold(report.size == descriptor.report_size(kind, report.id) && report.size <= HidBytes::kMost,
         "a PID report is one of the device's");
    for (const BitField& field : fields) check_field(field, report.size);
  }

  template <std::size_t N>
  void check_choice(const PidChoice<N>& choice, const PidReport& report) {
    for (std::size_t i = 0; i < N; ++i) {
      if (!choice.knows(i)) continue;
      check_field(choice.bit[i], report.size);
      if (choice.bit[i].exists()) continue;
      hold(choice.field.exists() && choice.number[i] >= choice.field.min && choice.number[i] <= choice.field.max,
           "a number fits its field");
      check_field(choice.field, report.size);
    }
  }

  void check_pid(const ReportDescriptor& descriptor, const PidLayout& pid) {
    ++pid_devices;
    check_outputs(descriptor, pid);
    check_features(descriptor, pid);
    check_told(pid);
    check_heard(pid);
  }

  void check_outputs(const ReportDescriptor& descriptor, const PidLayout& pid) {
    const auto output = ReportKind::output;
    const PidSetEffect& effect = pid.set_effect;
    check_report(descriptor, effect, output,
                 {effect.block, effect.duration, effect.trigger_repeat, effect.sample_period, effect.gain,
                  effect.trigger_button, effect.direction_enable, effect.start_delay, effect.axis_enable[0],
                  effect.axis_enable[1], effect.direction[0], effect.direction[1]});
    check_choice(effect.type, effect);
    hold(effect.duration_unit > 0.0, "a count takes time");
    check_report(descriptor, pid.set_constant, output, {pid.set_constant.block, pid.set_constant.magnitude});
    const PidSetCondition& condition = pid.set_condition;
    check_report(descriptor, condition, output,
                 {condition.block, condition.parameter_block, condition.centre, condition.positive_coefficient,
                  condition.negative_coefficient, condition.positive_saturation, condition.negative_saturation,
                  condition.dead_band});
    check_report(descriptor, pid.operate, output, {pid.operate.block, pid.operate.loops});
    check_choice(pid.operate.operation, pid.operate);
    check_report(descriptor, pid.device_control, output, {});
    check_choice(pid.device_control.control, pid.device_control);
    check_report(descriptor, pid.gain, output, {pid.gain.gain});
    check_report(descriptor, pid.block_free, output, {pid.block_free.block});
  }

  void check_features(const ReportDescriptor& descriptor, const PidLayout& pid) {
    const auto feature = ReportKind::feature;
    check_report(descriptor, pid.create, feature, {pid.create.byte_count});
    check_choice(pid.create.type, pid.create);
    check_report(descriptor, pid.block_load, feature, {pid.block_load.block, pid.block_load.ram_available});
    check_choice(pid.block_load.status, pid.block_load);
    check_report(descriptor, pid.pool, feature,
                 {pid.pool.ram_size, pid.pool.simultaneous, pid.pool.device_managed, pid.pool.shared_parameters});
    const PidState& state = pid.state;
    check_report(descriptor, state, ReportKind::input,
                 {state.block, state.playing, state.actuators_enabled, state.safety_switch, state.actuator_power,
                  state.override_switch, state.paused});
  }

  void check_told(const PidLayout& pid) {
    const auto block = static_cast<int>(std::min<std::int64_t>(pid.set_constant.block.max, 1000));
    for (const double magnitude : {-1.0, 0.0, 1.0}) {
      const HidBytes bytes = encode_constant(pid, block, magnitude);
      check_bytes(bytes, pid.set_constant);
      if (bytes.size == 0) continue;
      const BitField& field = pid.set_constant.magnitude;
      hold(read_bits(bytes.view(), pid.set_constant.block) == block, "the block is told");
      hold(read_bits(bytes.view(), field) == (magnitude < 0.0   ? field.min
                                              : magnitude > 0.0 ? field.max
                                                                : field.zero),
           "the magnitude is told");
    }
    for (std::size_t i = 0; i < kPidEffects; ++i) {
      const auto effect = static_cast<PidEffect>(i);
      for (int axis = -1; axis < 2; ++axis) {
        check_bytes(encode_set_effect(pid, {block, effect, axis < 0 ? kForever : 0.3, 0.5, axis}), pid.set_effect);
        check_bytes(encode_condition(pid, block, axis, {0.1, 0.2, -0.3, 0.4}), pid.set_condition);
      }
      check_bytes(encode_create(pid, effect), pid.create);
    }
    for (std::size_t i = 0; i < kPidOperations; ++i) {
      check_bytes(encode_operation(pid, block, static_cast<PidOperation>(i), 1), pid.operate);
    }
    for (std::size_t i = 0; i < kPidControls; ++i) {
      const HidBytes bytes = encode_control(pid, static_cast<PidControl>(i));
      check_bytes(bytes, pid.device_control);
      hold((bytes.size == 0) == !pid.device_control.control.knows(i), "a control that is known is told");
    }
    check_bytes(encode_gain(pid, 1.0), pid.gain);
    check_bytes(encode_block_free(pid, block), pid.block_free);
  }

  void check_heard(const PidLayout& pid) {
    for (const std::size_t size :
         {pid.block_load.size, pid.pool.size, pid.state.size, std::size_t{0}, std::size_t{3}}) {
      std::vector<std::uint8_t> report = salted(size);
      for (const std::uint8_t id : {pid.block_load.id, pid.pool.id, pid.state.id}) {
        if (size > 0) report[0] = id;
        hold(!decode_block_load(pid, report) || size == pid.block_load.size, "a block load of its length is read");
        hold(!decode_pool(pid, report) || size == pid.pool.size, "a pool of its length is read");
        hold(!decode_state(pid, report) || size == pid.state.size, "a state of its length is read");
      }
    }
    if (!pid.block_load.exists()) return;
    std::vector<std::uint8_t> report(pid.block_load.size);
    report[0] = pid.block_load.id;
    write_bits(report, pid.block_load.block, 7);
    const auto load = decode_block_load(pid, report);
    hold(load && load->block == std::max<std::int64_t>(read_bits(report, pid.block_load.block), 0),
         "the block is heard");
  }

  std::span<const std::uint8_t> salt_;
  std::size_t next_ = 0;
  std::string broken_;
};

}  // namespace gearshift
