// The fields of all structs in a trace, listed once. Writing, reading, comparing, hashing and naming all use these
// lists.
//
//   each_field(value, visit)   calls visit("name", member) for every member, in file order
//
// Each list uses a structured binding, so that it no longer compiles when its struct gains or loses a member. A struct
// with a table of parameters has that table as its list. If a name, a type or the order changes, trace_format.h no longer
// compiles.
#pragma once

#include <concepts>
#include <type_traits>

#include <glm/vec2.hpp>

#include "haptics/loop/haptic_loop.h"

namespace gearshift::haptics {

template <class T, class S>
concept FieldsOf = std::same_as<std::remove_const_t<T>, S>;

template <class T>
concept LeafField = std::is_arithmetic_v<T> || std::is_enum_v<T>;

// A struct whose members are all described in a table (haptics/files/parameter.h) has the fields of that table.
template <class S>
requires DescribesAll<std::remove_const_t<S>>
constexpr void each_field(S& parameters, auto&& visit) {
  each_parameter(parameters, [&](const auto& parameter, auto& value) { visit(parameter.name, value); });
}

constexpr void each_field(FieldsOf<glm::dvec2> auto& v, auto&& visit) {
  visit("x", v.x);
  visit("y", v.y);
}

constexpr void each_field(FieldsOf<DeviceSpec> auto& spec, auto&& visit) {
  auto& [max_force, continuous_force, workspace, yoke_radius, position_step, delay, axis_x, axis_y,
         device_wall_stiffness, device_wall_damping, measures, simulated] = spec;
  visit("max_force", max_force);
  visit("continuous_force", continuous_force);
  visit("workspace", workspace);
  visit("yoke_radius", yoke_radius);
  visit("position_step", position_step);
  visit("delay", delay);
  visit("axis_x", axis_x);
  visit("axis_y", axis_y);
  visit("device_wall_stiffness", device_wall_stiffness);
  visit("device_wall_damping", device_wall_damping);
  visit("measures_hand_force", measures);
  visit("simulated", simulated);
}

// The first parameter of [loop], the other sections, and the rest of [loop]: the hash of a drive covers this order.
constexpr void each_field(FieldsOf<HapticConfig> auto& config, auto&& visit) {
  const auto visit_loop = [&](bool first) {
    each_parameter(config, [&](const auto& parameter, auto& value) {
      if ((&parameter == kParameters<HapticConfig>) == first) visit(parameter.name, value);
    });
  };
  visit_loop(true);
  each_section(config, [&](const char* section, auto& part) {
    if constexpr (!FieldsOf<std::remove_reference_t<decltype(part)>, HapticConfig>) visit(section, part);
  });
  visit_loop(false);
}

constexpr void each_field(FieldsOf<LeverReading> auto& reading, auto&& visit) {
  auto& [sequence, time_ns, position, hand_force, actuator_force, pressed_down, lifted, stop] = reading;
  visit("sequence", sequence);
  visit("time_ns", time_ns);
  visit("position", position);
  visit("hand_force", hand_force);
  visit("actuator_force", actuator_force);
  visit("pressed_down", pressed_down);
  visit("lifted", lifted);
  visit("stop", stop);
}

constexpr void each_field(FieldsOf<Pedals> auto& pedals, auto&& visit) {
  auto& [throttle, brake, clutch, hand_brake] = pedals;
  visit("throttle", throttle);
  visit("brake", brake);
  visit("clutch", clutch);
  visit("hand_brake", hand_brake);
}

// Pedals have the names of columns that older tables have, without a prefix of their own.
constexpr void each_field(FieldsOf<DriverControls> auto& controls, auto&& visit) {
  auto& [pedals, ignition, starter, slope, guided_gear, guidance] = controls;
  each_field(pedals, visit);
  visit("ignition", ignition);
  visit("starter", starter);
  visit("slope", slope);
  visit("guided_gear", guided_gear);
  visit("guidance", guidance);
}

constexpr void each_field(FieldsOf<HapticSnapshot> auto& snapshot, auto&& visit) {
  auto& [cycle, time_ns, lever, velocity, proxy, wall_force, feel_force, load_force, commanded, f_h, f_a, f_j,
         wall_stiffness, road_speed, slot, gear, guard, fault, flags] = snapshot;
  visit("cycle", cycle);
  visit("time_ns", time_ns);
  visit("lever", lever);
  visit("velocity", velocity);
  visit("proxy", proxy);
  visit("wall_force", wall_force);
  visit("feel_force", feel_force);
  visit("load_force", load_force);
  visit("commanded", commanded);
  visit("f_h", f_h);
  visit("f_a", f_a);
  visit("f_j", f_j);
  visit("wall_stiffness", wall_stiffness);
  visit("road_speed", road_speed);
  visit("slot", slot);
  visit("gear", gear);
  visit("guard", guard);
  visit("fault", fault);
  visit("flags", flags);
}

// `out` must be the last field, because the outputs must be the last bytes of an encoded sample.
constexpr void each_field(FieldsOf<TraceSample> auto& sample, auto&& visit) {
  auto& [deadline_ns, skipped, reading, controls, tuning, command, out] = sample;
  visit("deadline_ns", deadline_ns);
  visit("skipped", skipped);
  visit("reading", reading);
  visit("controls", controls);
  visit("tuning", tuning);
  visit("command", command);
  visit("out", out);
}

// Largest valid value of each enumeration.
constexpr LoopCommand last_value(LoopCommand) {
  return LoopCommand::stop;
}
constexpr GuardState last_value(GuardState) {
  return GuardState::released;
}
constexpr GuardFault last_value(GuardFault) {
  return GuardFault::chatter;
}

}  // namespace gearshift::haptics
