#include "app/lab/stability/stability_report.h"

#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "haptics/contact/virtual_coupling.h"
#include "haptics/loop/haptic_config.h"

namespace gearshift::lab {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kExactLaw = "spectral radius of one cycle of lever, hand and wall below 1";

std::string format_law(const haptics::ContactLaw& wall) {
  if (wall.hold == haptics::ContactHold::observer) return haptics::to_string(wall.hold);
  return fmt::format("{}, velocity over {} sample{}", haptics::to_string(wall.hold), wall.window,
                     wall.window == 1 ? "" : "s");
}

std::string passive_law(const haptics::ContactLaw& wall) {
  const bool closed = wall.hold == haptics::ContactHold::zero_order && wall.window == 1 && wall.delay == 0;
  return closed ? "(20) of the paper, K T/2 + B < b"
                : "(13) of the paper, T/2 Re{(1 - e^-jwT) E} / (1 - cos wT) < b at every frequency w (E: the "
                  "wall's response at w)";
}

std::string up_to(double limit) {
  if (limit == 0.0) return "no K";
  return std::isinf(limit) ? "any K up to 1e9 N/m" : fmt::format("K up to {:.6g} N/m", limit);
}

Json finite_or_null(std::optional<double> value) {
  return !value || std::isinf(*value) ? Json(nullptr) : Json(*value);
}

std::string format_wall(double stiffness, double damping) {
  return fmt::format("K = {:g} N/m, B = {:g} N s/m", stiffness, damping);
}
std::string format_wall(const haptics::ContactLaw& wall) {
  return format_wall(wall.stiffness, wall.damping);
}

std::string format_hand(const JudgedHand& judged) {
  const haptics::HandImpedance& hand = judged.hand;
  return fmt::format("{:<6} {:g} kg, {:g} N s/m, {:g} N/m", judged.name, hand.mass, hand.damping, hand.stiffness);
}

std::string hand_table(const StabilityQuestion& question, const StabilityAnswer& answer) {
  std::string table =
      fmt::format("{:<36} {:>22}   spectral radius at {:g} N/m\n", "hand", "stable", question.wall.stiffness);
  for (std::size_t i = 0; i < answer.hands.size(); ++i) {
    const HandVerdict& verdict = answer.hands[i];
    table += fmt::format("{:<36} {:>22}   {:.6f} {}\n", format_hand(question.hands[i]), up_to(verdict.limit),
                         verdict.radius, verdict.radius < 1.0 ? "stable" : "UNSTABLE");
  }
  return table;
}

std::string format_verdict(const StabilityQuestion& question, const StabilityAnswer& answer) {
  const std::string& hand = question.hands[answer.deciding].name;
  const std::string bound = answer.limit > 0.0 ? up_to(answer.limit) + " is stable" : "not even a soft wall is stable";
  return fmt::format("{}: {} (least stable hand: {}).\n", answer.may_use ? "Yes" : "No", bound, hand);
}

std::string format_passive_answer(const haptics::ContactLaw& wall, const StabilityAnswer& answer) {
  if (!answer.passive_limit) return "unknown for the observer hold, which contains a model of the device\n";
  return fmt::format("{}: {}, {}\n", passive_law(wall), *answer.passive ? "satisfied" : "violated",
                     up_to(*answer.passive_limit));
}

bool is_clipped(const haptics::ContactLaw& wall, const RuntimeAnswer& runtime) {
  return runtime.stiffness != wall.stiffness || runtime.damping != wall.damping;
}

std::string format_runtime_answer(const StabilityQuestion& question, const RuntimeAnswer& runtime) {
  const haptics::ContactLaw& wall = question.wall;
  if (!runtime.problem.empty())
    return fmt::format("The trainer does not run with these values, because {}.\n", runtime.problem);
  const haptics::AdmittedTuning& admitted = runtime.admitted;
  std::string text = fmt::format("The trainer would use {}, {}{}\n",
                                 format_wall(admitted.tuning.wall_stiffness, admitted.tuning.wall_damping),
                                 haptics::to_string(admitted.hold), admitted.limits.empty() ? "." : ":");
  if (is_clipped(wall, runtime))
    text += fmt::format("  (values out of range were lowered to {}, the largest that the trainer accepts)\n",
                        format_wall(runtime.stiffness, runtime.damping));
  for (const haptics::TuningLimit& limited : admitted.limits) text += fmt::format("  {}\n", haptics::describe(limited));
  return text +
         fmt::format("Its laws take {:.1f} um per encoder count (--encoder-step).\n", 1e6 * question.encoder_step);
}

Json limited_json(const haptics::TuningLimit& limited) {
  const auto value = [&](double number) {
    return limited.parameter == haptics::kHold ? Json(haptics::file_key(static_cast<haptics::ContactHold>(number)))
                                               : Json(number);
  };
  return {{"law", limited.law},
          {"what", haptics::to_string(limited.parameter)},
          {"wanted", value(limited.wanted)},
          {"used", value(limited.used)},
          {"hand", limited.hand}};
}

// If the trainer rejects the wanted wall, the values are null.
Json runtime_json(const RuntimeAnswer& runtime) {
  const haptics::HapticTuning& tuning = runtime.admitted.tuning;
  const auto known = [&](const auto& value) { return runtime.problem.empty() ? Json(value) : Json(nullptr); };
  Json limited = Json::array();
  for (const haptics::TuningLimit& one : runtime.admitted.limits) limited.push_back(limited_json(one));
  return {{"asked_wall_stiffness_n_per_m", known(runtime.stiffness)},
          {"asked_wall_damping_n_s_per_m", known(runtime.damping)},
          {"admitted_wall_stiffness_n_per_m", known(tuning.wall_stiffness)},
          {"admitted_wall_damping_n_s_per_m", known(tuning.wall_damping)},
          {"admitted_hold", known(haptics::file_key(runtime.admitted.hold))},
          {"limited", known(limited)}};
}

Json hand_json(const JudgedHand& judged, const HandVerdict& verdict, std::optional<double> passive_limit) {
  return {{"name", judged.name},
          {"mass_kg", judged.hand.mass},
          {"damping_n_s_per_m", judged.hand.damping},
          {"stiffness_n_per_m", judged.hand.stiffness},
          {"k_max_n_per_m", finite_or_null(verdict.limit)},
          {"passive_k_max_n_per_m", finite_or_null(passive_limit)},
          {"spectral_radius", finite_or_null(verdict.radius)},
          {"stable", verdict.radius < 1.0}};
}

}  // namespace

std::string describe_device(const StabilityQuestion& question) {
  return fmt::format("{}: m = {:g} kg, b = {:g} N s/m, k = {:g} N/m", question.device, question.handle.mass,
                     question.handle.damping, question.handle.stiffness);
}

std::string describe_loop(const StabilityQuestion& question) {
  const haptics::ContactLaw& wall = question.wall;
  const std::string delay =
      wall.delay == 0 ? "no delay" : fmt::format("{} sample{} of delay", wall.delay, wall.delay == 1 ? "" : "s");
  return fmt::format("{:g} Hz (T = {:g} ms), {}, {}", question.rate, 1e3 * question.period(), delay, format_law(wall));
}

std::string stability_text(const StabilityQuestion& question, const StabilityAnswer& answer,
                           const RuntimeAnswer& runtime) {
  const haptics::ContactLaw& wall = question.wall;
  std::string text = fmt::format("device   {}\n", describe_device(question));
  text += fmt::format("loop     {}\n", describe_loop(question));
  text += fmt::format("wall     {}\n\n", format_wall(wall));
  text += hand_table(question, answer);
  text += fmt::format("\nMay a wall of {} be used?\n{}", format_wall(wall), format_verdict(question, answer));
  text += fmt::format("  exact    {}: {:.6f}, {}\n", kExactLaw, answer.radius, up_to(answer.limit));
  text += "  passive  " + format_passive_answer(wall, answer);
  text +=
      "Passivity is sufficient but not necessary for stability with every passive hand, so the exact limit decides.\n";
  return text + format_runtime_answer(question, runtime);
}

std::string stability_json(const StabilityQuestion& question, const StabilityAnswer& answer,
                           const RuntimeAnswer& runtime) {
  const haptics::ContactLaw& wall = question.wall;
  Json json{{"device", question.device},
            {"mass_kg", question.handle.mass},
            {"damping_n_s_per_m", question.handle.damping},
            {"stiffness_n_per_m", question.handle.stiffness},
            {"rate_hz", question.rate},
            {"period_s", question.period()},
            {"delay_samples", wall.delay},
            {"window_samples", wall.window},
            {"hold", haptics::file_key(wall.hold)},
            {"wall_stiffness_n_per_m", wall.stiffness},
            {"wall_damping_n_s_per_m", wall.damping},
            {"encoder_step_m", question.encoder_step},
            {"may_use", answer.may_use},
            {"stable", answer.stable},
            {"passive", answer.passive ? Json(*answer.passive) : Json(nullptr)},
            {"k_max_n_per_m", finite_or_null(answer.limit)},
            {"passive_k_max_n_per_m", finite_or_null(answer.passive_limit)},
            {"spectral_radius", finite_or_null(answer.radius)},
            {"deciding_hand", question.hands[answer.deciding].name},
            {"law", kExactLaw},
            {"passive_law", passive_law(wall)}};
  json.update(runtime_json(runtime));
  for (std::size_t i = 0; i < answer.hands.size(); ++i) {
    json["hands"].push_back(hand_json(question.hands[i], answer.hands[i], answer.passive_limit));
  }
  return json.dump(2) + "\n";
}

std::string stability_csv(const StabilityQuestion& question, const StabilityMap& map) {
  std::string csv = "b_n_s_per_m";
  for (const JudgedHand& judged : question.hands) csv += "," + judged.name + "_k_max_n_per_m";
  csv += map.passive.empty() ? "\n" : ",passive_k_max_n_per_m\n";
  for (std::size_t i = 0; i < map.damping.size(); ++i) {
    csv += fmt::format("{}", map.damping[i]);
    for (const std::vector<double>& limits : map.limits) csv += fmt::format(",{}", limits[i]);
    csv += map.passive.empty() ? "\n" : fmt::format(",{}\n", map.passive[i]);
  }
  return csv;
}

}  // namespace gearshift::lab
