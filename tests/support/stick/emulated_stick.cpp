#include "tests/support/stick/emulated_stick.h"

#include <cstdio>
#include <utility>

#include "tests/support/stick/stick_plug.h"
#include "tests/support/stick/stick_state.h"

namespace gearshift::test {
namespace {

using Answer = std::optional<std::vector<std::uint8_t>>;

// HID 1.11 section 7.2: class requests of the interface.
constexpr std::uint8_t kToDevice = 0x21, kToHost = 0xA1;
constexpr std::uint8_t kGetReport = 1, kGetIdle = 2, kSetReport = 9, kSetIdle = 10;
constexpr int kInputReport = 1, kOutputReport = 2, kFeatureReport = 3;

}  // namespace

std::string message_line(const StickMessage& message) {
  static constexpr const char* kKinds[] = {"set", "get", "out"};
  std::string line = kKinds[static_cast<std::size_t>(message.kind)];
  char text[4];
  for (std::uint8_t byte : message.bytes) {
    std::snprintf(text, sizeof text, " %02x", byte);
    line += text;
  }
  return line;
}

EmulatedStick::EmulatedStick(const EmulatedStickConfig& config, haptics::HandDriver& hand)
    : state_(std::make_unique<State>(config, hand, faults, held_buttons)) {}

EmulatedStick::~EmulatedStick() = default;

// --- USB requests ---

std::vector<std::uint8_t> EmulatedStick::device_descriptor() const {
  return make_device_descriptor(state_->family);
}

std::vector<std::uint8_t> EmulatedStick::configuration_descriptor() const {
  return make_configuration_descriptor(state_->family, state_->descriptor.size(), state_->config.input_interval);
}

const std::vector<std::uint8_t>& EmulatedStick::report_descriptor() const {
  return state_->descriptor;
}

std::vector<std::uint8_t> EmulatedStick::string_descriptor(int index) const {
  return make_string_descriptor(state_->family, index);
}

Answer EmulatedStick::control(const UsbSetup& setup, std::span<const std::uint8_t> data) {
  state_->on_bus_reset();
  const bool of_class = (setup.request_type & 0x60) == 0x20;
  Answer answer = of_class ? class_request(setup, data) : standard_request(setup);
  if (answer && answer->size() > setup.length) answer->resize(setup.length);
  return answer;
}

// Standard requests of USB 2.0 section 9.4, and the HID descriptors of HID 1.11 section 7.1.1.
Answer EmulatedStick::standard_request(const UsbSetup& setup) {
  switch (setup.request) {
    case 0:
      return std::vector<std::uint8_t>{0, 0};  // GET_STATUS
    case 1:                                    // CLEAR_FEATURE
    case 3:                                    // SET_FEATURE
    case 11:
      return std::vector<std::uint8_t>{};  // SET_INTERFACE
    case 6:
      return descriptor(setup.value >> 8, setup.value & 0xFF);
    case 8:
      return std::vector<std::uint8_t>{state_->configuration};
    case 9:
      state_->configuration = static_cast<std::uint8_t>(setup.value);
      return std::vector<std::uint8_t>{};
    case 10:
      return std::vector<std::uint8_t>{0};  // GET_INTERFACE
    default:
      return std::nullopt;
  }
}

Answer EmulatedStick::descriptor(int type, int index) const {
  const std::vector<std::uint8_t> configuration = configuration_descriptor();
  switch (type) {
    case 1:
      return device_descriptor();
    case 2:
      return configuration;
    case 3: {
      std::vector<std::uint8_t> text = string_descriptor(index);
      return text.empty() ? std::nullopt : std::optional(std::move(text));
    }
    case 0x21:
      return std::vector<std::uint8_t>(configuration.begin() + 18, configuration.begin() + 27);
    case 0x22:
      return report_descriptor();
    default:
      return std::nullopt;
  }
}

// Class requests of HID 1.11 section 7.2.
Answer EmulatedStick::class_request(const UsbSetup& setup, std::span<const std::uint8_t> data) {
  const int kind = setup.value >> 8;
  const auto id = static_cast<std::uint8_t>(setup.value);
  if (setup.request_type == kToHost && setup.request == kGetReport) return get_report(kind, id);
  if (setup.request_type == kToHost && setup.request == kGetIdle) return std::vector<std::uint8_t>{state_->idle};
  if (setup.request_type != kToDevice) return std::nullopt;
  bool accepted = false;
  if (setup.request == kSetIdle) {
    state_->idle = static_cast<std::uint8_t>(kind);
    accepted = true;
  } else if (setup.request == kSetReport && kind == kFeatureReport) {
    accepted = set_feature(data);
  } else if (setup.request == kSetReport && kind == kOutputReport) {
    accepted = accept_output(data);
  }
  return accepted ? std::optional(std::vector<std::uint8_t>{}) : std::nullopt;
}

Answer EmulatedStick::get_report(int kind, std::uint8_t id) {
  State& state = *state_;
  if (kind == kFeatureReport) {
    state.apply_all_outputs();
    std::optional<StickReport> report = state.firmware.take_feature(id);
    if (report) log_message(StickMessage::Kind::get_feature, *report);
    return report;
  }
  if (kind != kInputReport || faults.silent) return std::nullopt;
  if (id == state.family.lever.id) {
    state.fetched_ns = state.now_ns;
    return state.with_faults(state.lever_report());
  }
  if (state.family.state.size > 0 && id == state.family.state.id) return state.firmware.state();
  return std::nullopt;
}

bool EmulatedStick::set_feature(std::span<const std::uint8_t> report) {
  log_message(StickMessage::Kind::set_feature, report);
  state_->apply_all_outputs();
  using Status = StickFirmware::BlockStatus;
  state_->firmware.refusal = faults.refuses_effects ? std::optional(Status::error)
                             : faults.pool_full     ? std::optional(Status::full)
                                                    : std::nullopt;
  return state_->firmware.set_feature(report);
}

bool EmulatedStick::output(std::span<const std::uint8_t> report) {
  state_->on_bus_reset();
  return state_->family.endpoint_out != 0 && accept_output(report);
}

bool EmulatedStick::accept_output(std::span<const std::uint8_t> report) {
  log_message(StickMessage::Kind::output, report);
  return !faults.stalls_outputs && state_->accept_output(report);
}

std::optional<std::vector<std::uint8_t>> EmulatedStick::input() {
  State& state = *state_;
  state.on_bus_reset();
  if (faults.silent) return std::nullopt;
  if (Answer report = state.firmware.take_state()) return report;
  if (!state.pending_report) return std::nullopt;
  state.fetched_ns = state.now_ns;
  state.sent = std::move(*state.pending_report);
  state.pending_report.reset();
  return state.sent;
}

void EmulatedStick::log_message(StickMessage::Kind kind, std::span<const std::uint8_t> bytes) {
  if (logs) log.push_back({kind, state_->now_ns, {bytes.begin(), bytes.end()}});
}

void EmulatedStick::advance(std::int64_t now_ns) {
  state_->advance(now_ns);
}

void EmulatedStick::unplug() {
  state_->unplugged = true;
  if (!state_->config.own_power) state_->power_off();
}

// --- True state ---

glm::dvec2 EmulatedStick::force() const {
  return state_->force;
}

glm::dvec2 EmulatedStick::position() const {
  return state_->lever.true_position();
}

glm::dvec2 EmulatedStick::velocity() const {
  return state_->lever.true_velocity();
}

std::int64_t EmulatedStick::time_ns() const {
  return state_->plant_ns;
}

void EmulatedStick::place(glm::dvec2 position) {
  state_->lever.place(position);
}

bool EmulatedStick::actuators_on() const {
  return state_->firmware.actuators();
}

int EmulatedStick::playing() const {
  return state_->firmware.playing();
}

std::int64_t EmulatedStick::fetched_ns() const {
  return state_->fetched_ns;
}

}  // namespace gearshift::test
