// One description for each parameter of a struct. File reader and writer, range checks, sliders, traces and documents
// derive from it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

namespace gearshift::haptics {

// Allowed values, both ends included.
struct Range {
  double min, max;
};

// Speeds are in km/h and revolutions per minute in files and on the screen, in m/s and rad/s in the code.
inline constexpr double kKmhPerMps = 3.6;
inline constexpr double kTurnPerMinute = std::numbers::pi / 30.0;  // [rad/s]

// Converts a file's value to the struct's: value in the struct = value in the file * multiply / divide.
struct FileUnit {
  double multiply = 1.0;
  double divide = 1.0;
};
// The units of files that are not SI units.
namespace file_unit {
inline constexpr FileUnit kDegrees{std::numbers::pi / 180.0};
inline constexpr FileUnit kMillimetres{1e-3};
inline constexpr FileUnit kKmPerHour{1.0, kKmhPerMps};
inline constexpr FileUnit kRpm{kTurnPerMinute};
inline constexpr FileUnit kPerKrpm{1.0, 1000.0 * kRpm.multiply};
inline constexpr FileUnit kPerKrpmSquared{1.0, kPerKrpm.divide* kPerKrpm.divide};
}  // namespace file_unit

// How a file writes a number: the allowed values, both ends included, and their unit.
struct FileRange {
  double min, max;
  FileUnit unit{};
};

// How the screen shows a number: factor x the file's value, with this unit.
struct Display {
  const char* unit = "";
  int decimals = 0;
  double factor = 1.0;
  bool logarithmic = false;  // slider
};

// A parameter of the struct S. Enums: its members of enumeration types. Each needs functions file_key(E), to_string(E)
// and last_value(E).
template <class S, class... Enums>
struct Parameter {
  std::variant<double S::*, int S::*, std::uint64_t S::*, bool S::*, std::optional<double> S::*,
               std::optional<bool> S::*, Enums S::*...>
      member;
  const char* name;                 // in traces: "wall_stiffness"
  const char* key;                  // in files, with the file's unit: "wall_stiffness_n_per_m"
  FileRange range;                  // of numbers
  const char* description;          // one sentence
  const char* label = "";           // on the screen: "Wall stiffness"; empty: not shown
  const char* too_low = "";         // effect of a value that is too low
  const char* too_high = "";        // effect of a value that is too high
  Display display{};                // of numbers
  double S::*max_member = nullptr;  // if set, the value must not exceed this member either
};

// The parameters of the struct S, in the order of its members: an array of Parameter<S>, defined beside the struct.
template <class S>
inline constexpr int kParameters = 0;

// Number of members of an aggregate: the largest number of initialisers that it accepts.
struct AnyValue {
  template <class T>
  operator T() const;
};
template <class S, class... Values>
constexpr std::size_t member_count() {
  if constexpr (requires { S{Values{}..., AnyValue{}}; })
    return member_count<S, Values..., AnyValue>();
  else
    return sizeof...(Values);
}

constexpr bool is_same_member(auto a, auto b) {
  if constexpr (std::is_same_v<decltype(a), decltype(b)>) return a == b;
  return false;
}

// True if every member of S either has one description or is one of `others`, which are no parameters, and if no name
// or key occurs twice. If S has such members, assert this below its table.
template <class S, class... Others>
consteval bool describes_all(Others S::*... others) {
  constexpr const auto& table = kParameters<S>;
  if (member_count<S>() != std::size(table) + sizeof...(others)) return false;
  for (auto a = std::begin(table); a != std::end(table); ++a) {
    for (auto b = std::begin(table); b != a; ++b) {
      if (a->member == b->member || std::string_view(a->name) == b->name) return false;
      if (std::string_view(a->key) == b->key) return false;
    }
    const auto is_other = [&]([[maybe_unused]] auto member) {
      return (is_same_member(member, others) || ... || false);
    };
    if (std::visit(is_other, a->member)) return false;
  }
  [[maybe_unused]] const auto is_listed_once = [&]([[maybe_unused]] auto other) {
    return (0 + ... + int{is_same_member(other, others)}) == 1;
  };
  return (is_listed_once(others) && ... && true);
}

// Every member of S is a parameter.
template <class S>
concept DescribesAll = std::is_array_v<decltype(kParameters<S>)> && describes_all<S>();

// The description of a member, such as &HapticTuning::wall_stiffness.
template <class S, class Value>
constexpr const auto& parameter_of(Value S::*member) {
  for (const auto& parameter : kParameters<S>) {
    const auto* described = std::get_if<Value S::*>(&parameter.member);
    if (described != nullptr && *described == member) return parameter;
  }
  throw std::logic_error("the member has no description");
}

// The parameter's value in an object. Value must be the member's type.
template <class Value, class S, class... Enums>
constexpr const Value& value_in(const S& object, const Parameter<S, Enums...>& parameter) {
  return object.*std::get<Value S::*>(parameter.member);
}

// Calls visit(parameter, value) for each parameter, with the struct's member as value.
template <class S>
constexpr void each_parameter(S& object, auto&& visit) {
  constexpr const auto& table = kParameters<std::remove_const_t<S>>;
  [&]<std::size_t... i>(std::index_sequence<i...>) {
    (visit(table[i], object.*std::get<table[i].member.index()>(table[i].member)), ...);
  }
  (std::make_index_sequence<std::size(table)>());
}

}  // namespace gearshift::haptics
