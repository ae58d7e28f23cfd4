// Checks laws that must hold for any bytes given as a report descriptor. broken_by() returns the name of the first
// violated law, or an empty string.
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

namespace gearshift::test {

class HidLaws {
 public:
  // The test fills its reports by repeating the bytes of `salt`.
  explicit HidLaws(std::span<const std::uint8_t> salt) : salt_(salt) {}

  std::string broken_by(std::span<const std::uint8_t> bytes) {
    haptics::ReportDescriptor descriptor;
    try {
      descriptor = haptics::parse_report_descriptor(bytes);
    } catch (const haptics::HidError& error) {  // the only exception type allowed
      const std::string sentence = error.what();
      expect(
          sentence.starts_with("the report descriptor is invalid at byte ") && sentence.find('\n') == std::string::npos,
          "one sentence");
      return broken_;
    }
    check_fields(descriptor);
    if (const auto lever = haptics::find_lever_report(descriptor)) check_lever(descriptor, *lever);
    if (const auto pid = haptics::find_pid(descriptor)) check_pid(descriptor, *pid);
    return broken_;
  }

  int levers = 0, pid_devices = 0;  // number found

 private:
  void expect(bool law, const char* name) {
    if (!law && broken_.empty()) broken_ = name;
  }

  void check_fields(const haptics::ReportDescriptor& descriptor) {
    for (std::size_t i = 0; i < descriptor.collections.size(); ++i) {
      const int parent = descriptor.collections[i].parent;
      expect(parent >= -1 && parent < static_cast<int>(i), "a collection begins after the one that it is in");
    }
    std::array<std::array<int, 256>, 3> ends{};
    for (const haptics::HidField& field : descriptor.fields) {
      int& end = ends[static_cast<std::size_t>(field.kind)][field.report_id];
      expect(field.bits > 0 && field.count > 0, "a field is of something");
      expect(field.offset == end, "fields lie side by side");
      end += field.bits * field.count;
      expect(end <= 8 * 65535, "a report's length fits into 16 bits");
      expect(field.collection >= -1 && field.collection < static_cast<int>(descriptor.collections.size()),
             "a field's collection exists");
      expect(field.usages.size() <= 1024, "usages are bounded");
      if (field.report_id != 0) expect(descriptor.numbered, "IDs are numbers of reports");
    }
    for (const haptics::HidField& field : descriptor.fields) {
      const int end = ends[static_cast<std::size_t>(field.kind)][field.report_id];
      expect(descriptor.report_size(field.kind, field.report_id) == 1 + (static_cast<std::size_t>(end) + 7) / 8,
             "a report is as long as its fields");
    }
  }

  void check_field(const haptics::BitField& field, std::size_t size) {
    if (!field.exists()) return;
    expect(field.offset >= 0 && field.bits <= 32 && 8 + field.offset + field.bits <= static_cast<int>(8 * size),
           "no field lies outside its report");
    expect(field.min < field.max && field.zero >= field.min && field.zero <= field.max, "a field has a range");
    std::vector<std::uint8_t> report = salted(size);
    for (const std::int64_t value : {field.min, field.zero, field.max, field.min + (field.max - field.min) / 3}) {
      haptics::write_bits(report, field, value);
      expect(haptics::read_bits(report, field) == value, "what is written is read");
    }
    haptics::write_bits(report, field, field.max + 1);
    expect(haptics::read_bits(report, field) == field.max, "no more than the most is written");
  }

  std::vector<std::uint8_t> salted(std::size_t size) {
    std::vector<std::uint8_t> report(size);
    for (std::uint8_t& byte : report) byte = salt_.empty() ? 0 : salt_[next_++ % salt_.size()];
    return report;
  }

  void check_lever(const haptics::ReportDescriptor& descriptor, const haptics::LeverReport& lever) {
    ++levers;
    expect(lever.size == descriptor.report_size(haptics::ReportKind::input, lever.id) &&
               lever.size <= haptics::HidBytes::kMaxSize,
           "a lever's report is one of the device's");
    expect(lever.axes.size() >= 2 && lever.axes.size() <= haptics::kMaxAxes &&
               lever.buttons.size() <= haptics::kMaxButtons,
           "a lever has two axes and more");
    std::vector<std::uint8_t> report = salted(lever.size);
    report[0] = lever.id;
    for (const haptics::HidAxis& axis : lever.axes) {
      check_field(axis.field, lever.size);
      haptics::write_bits(report, axis.field, axis.field.zero);
    }
    for (const haptics::BitField& button : lever.buttons) check_field(button, lever.size);
    const auto counts = haptics::decode_lever(lever, report);
    expect(counts.has_value(), "a report of its ID and length is read");
    for (std::size_t i = 0; counts && i < lever.axes.size(); ++i) {
      expect(counts->axis[i] == lever.axes[i].field.zero, "an axis is read as it was written");
    }
    report.push_back(0);
    expect(haptics::decode_lever(lever, report) == counts, "a longer report is read alike");
    report.resize(1);
    expect(!haptics::decode_lever(lever, report), "a report that ends before X and Y is not read");
  }

  // `layout.size` is the size of the report according to the descriptor.
  void check_bytes(const haptics::HidBytes& bytes, const haptics::PidReport& layout) {
    if (bytes.size == 0) return;
    expect(bytes.size == layout.size && bytes.id() == layout.id, "an encoded report is as long as the device's");
  }

  void check_report(const haptics::ReportDescriptor& descriptor, const haptics::PidReport& report,
                    haptics::ReportKind kind, std::initializer_list<haptics::BitField> fields) {
    if (!report.exists()) return;
    expect(report.size == descriptor.report_size(kind, report.id) && report.size <= haptics::HidBytes::kMaxSize,
           "a PID report is one of the device's");
    for (const haptics::BitField& field : fields) check_field(field, report.size);
  }

  template <std::size_t N>
  void check_choice(const haptics::PidChoice<N>& choice, const haptics::PidReport& report) {
    for (std::size_t i = 0; i < N; ++i) {
      if (!choice.supports(i)) continue;
      check_field(choice.bit[i], report.size);
      if (choice.bit[i].exists()) continue;
      expect(choice.field.exists() && choice.number[i] >= choice.field.min && choice.number[i] <= choice.field.max,
             "a number fits its field");
      check_field(choice.field, report.size);
    }
  }

  void check_pid(const haptics::ReportDescriptor& descriptor, const haptics::PidLayout& pid) {
    ++pid_devices;
    check_outputs(descriptor, pid);
    check_features(descriptor, pid);
    check_encoding(pid);
    check_decoding(pid);
  }

  void check_outputs(const haptics::ReportDescriptor& descriptor, const haptics::PidLayout& pid) {
    const auto output = haptics::ReportKind::output;
    const haptics::PidSetEffect& effect = pid.set_effect;
    check_report(descriptor, effect, output,
                 {effect.block, effect.duration, effect.trigger_repeat, effect.sample_period, effect.gain,
                  effect.trigger_button, effect.direction_enable, effect.start_delay, effect.axis_enable[0],
                  effect.axis_enable[1], effect.direction[0], effect.direction[1]});
    check_choice(effect.type, effect);
    expect(effect.duration_unit > 0.0, "a count takes time");
    check_report(descriptor, pid.set_constant, output, {pid.set_constant.block, pid.set_constant.magnitude});
    const haptics::PidSetCondition& condition = pid.set_condition;
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

  void check_features(const haptics::ReportDescriptor& descriptor, const haptics::PidLayout& pid) {
    const auto feature = haptics::ReportKind::feature;
    check_report(descriptor, pid.create, feature, {pid.create.byte_count});
    check_choice(pid.create.type, pid.create);
    check_report(descriptor, pid.block_load, feature, {pid.block_load.block, pid.block_load.ram_available});
    check_choice(pid.block_load.status, pid.block_load);
    check_report(descriptor, pid.pool, feature,
                 {pid.pool.ram_size, pid.pool.simultaneous, pid.pool.device_managed, pid.pool.shared_parameters});
    const haptics::PidState& state = pid.state;
    check_report(descriptor, state, haptics::ReportKind::input,
                 {state.block, state.playing, state.actuators_enabled, state.safety_switch, state.actuator_power,
                  state.override_switch, state.paused});
  }

  void check_encoding(const haptics::PidLayout& pid) {
    const auto block = static_cast<int>(
        std::min<std::int64_t>((pid.is_pool_ours() ? pid.set_constant.place : pid.set_constant.block).max, 1000));
    for (const double magnitude : {-1.0, 0.0, 1.0}) {
      const haptics::HidBytes bytes = haptics::encode_constant(pid, block, magnitude);
      check_bytes(bytes, pid.set_constant);
      if (bytes.size == 0) continue;
      const haptics::BitField& field = pid.set_constant.magnitude;
      const haptics::BitField& target = pid.is_pool_ours() ? pid.set_constant.place : pid.set_constant.block;
      expect(haptics::read_bits(bytes.view(), target) == block, "the block is encoded");
      expect(haptics::read_bits(bytes.view(), field) == (magnitude < 0.0   ? field.min
                                                         : magnitude > 0.0 ? field.max
                                                                           : field.zero),
             "the magnitude is encoded");
    }
    for (std::size_t i = 0; i < haptics::kPidEffects; ++i) {
      const auto effect = static_cast<haptics::PidEffect>(i);
      for (int axis = -1; axis < 2; ++axis) {
        check_bytes(haptics::encode_set_effect(pid, {block, effect, axis < 0 ? haptics::kForever : 0.3, 0.5, axis}),
                    pid.set_effect);
        check_bytes(haptics::encode_condition(pid, block, axis, {0.1, 0.2, -0.3, 0.4}), pid.set_condition);
      }
      check_bytes(haptics::encode_create(pid, effect), pid.create);
    }
    for (std::size_t i = 0; i < haptics::kPidOperations; ++i) {
      check_bytes(haptics::encode_operation(pid, block, static_cast<haptics::PidOperation>(i), 1), pid.operate);
    }
    for (std::size_t i = 0; i < haptics::kPidControls; ++i) {
      const haptics::HidBytes bytes = haptics::encode_control(pid, static_cast<haptics::PidControl>(i));
      check_bytes(bytes, pid.device_control);
      expect((bytes.size == 0) == !pid.device_control.control.supports(i), "a supported control is encoded");
    }
    check_bytes(haptics::encode_gain(pid, 1.0), pid.gain);
    check_bytes(haptics::encode_block_free(pid, block), pid.block_free);
  }

  void check_decoding(const haptics::PidLayout& pid) {
    for (const std::size_t size :
         {pid.block_load.size, pid.pool.size, pid.state.size, std::size_t{0}, std::size_t{3}}) {
      std::vector<std::uint8_t> report = salted(size);
      for (const std::uint8_t id : {pid.block_load.id, pid.pool.id, pid.state.id}) {
        if (size > 0) report[0] = id;
        const auto holds = [&](const haptics::BitField& field) {
          return size > 0 && (!field.exists() || haptics::contains(report, field));
        };
        expect(!haptics::decode_block_load(pid, report) || holds(pid.block_load.block),
               "a read block load has a block");
        expect(!haptics::decode_state(pid, report) || holds(pid.state.actuators_enabled), "a read state has its bit");
      }
    }
    if (!pid.block_load.exists()) return;
    std::vector<std::uint8_t> report(pid.block_load.size);
    report[0] = pid.block_load.id;
    haptics::write_bits(report, pid.block_load.block, 7);
    const auto load = haptics::decode_block_load(pid, report);
    expect(load && load->block == std::max<std::int64_t>(haptics::read_bits(report, pid.block_load.block), 0),
           "the block is heard");
  }

  std::span<const std::uint8_t> salt_;
  std::size_t next_ = 0;
  std::string broken_;
};

}  // namespace gearshift::test
