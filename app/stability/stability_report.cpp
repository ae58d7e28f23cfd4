#include "app/stability/stability_report.h"

#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/hold_words.h"
#include "app/limited_words.h"

namespace gearshift {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kExactLaw = "spectral radius of one cycle of lever, hand and wall < 1";

std::string law_words(const ContactLaw& wall) {
  if (wall.hold == ContactHold::observer)
    return fmt::format("{} with B of at least {:g} N s/m", hold_words(wall.hold), kObservedDamping);
  return fmt::format("{}, velocity over {} sample{}", hold_words(wall.hold), wall.window, wall.window == 1 ? "" : "s");
}

std::string passive_law(const ContactLaw& wall) {
  const bool closed = wall.hold == ContactHold::zero_order && wall.window == 1 && wall.delay == 0;
  return closed ? "(20) of the paper, K T/2 + B < b"
                : "(13) of the paper, T/2 Re{(1 - e^-jwT) E} / (1 - cos wT) < b at every w";
}

std::string up_to(double limit) {
  if (limit == 0.0) return "no K";
  return std::isinf(limit) ? "any K up to 1e9 N/m" : fmt::format("K up to {:.6g} N/m", limit);
}

Json finite_or_null(std::optional<double> value) {
  return !value || std::isinf(*value) ? Json(nullptr) : Json(*value);
}

std::string wall_words(double stiffness, double damping) {
  return fmt::format("K = {:g} N/m, B = {:g} N s/m", stiffness, damping);
}
std::string wall_words(const ContactLaw& wall) {
  return wall_words(wall.stiffness, wall.damping);
}

std::string hand_words(const JudgedHand& judged) {
  const HandImpedance& hand = judged.hand;
  return fmt::format("{:<6} {:g} kg, {:g} N s/m, {:g} N/m", judged.name, hand.mass, hand.damping, hand.stiffness);
}

std::string hand_table(const StabilityQuestion& question, const StabilityAnswer& answer) {
  std::string table =
      fmt::format("{:<36} {:>22}   spectral radius at {:g} N/m\n", "hand", "stable", question.wall.stiffness);
  for (std::size_t i = 0; i < answer.hands.size(); ++i) {
    const HandVerdict& verdict = answer.hands[i];
    table += fmt::format("{:<36} {:>22}   {:.6f} {}\n", hand_words(question.hands[i]), up_to(verdict.limit),
                         verdict.radius, verdict.radius < 1.0 ? "stable" : "UNSTABLE");
  }
  return table;
}

std::string verdict_words(const StabilityQuestion& question, const StabilityAnswer& answer) {
  const std::string& hand = question.hands[answer.deciding].name;
  const std::string bound = answer.limit > 0.0 ? up_to(answer.limit) + " is stable" : "not even a soft wall is stable";
  return fmt::format("{}: {}, the hand \"{}\" decides.\n", answer.may_use ? "Yes" : "No", bound, hand);
}

std::string passive_words(const ContactLaw& wall, const StabilityAnswer& answer) {
  if (!answer.passive_limit) return "not known of the observed hold, which contains a model of the device\n";
  return fmt::format("{}: {}, {}\n", passive_law(wall), *answer.passive ? "kept" : "not kept",
                     up_to(*answer.passive_limit));
}

bool is_clipped(const ContactLaw& wall, const TrainerAnswer& trainer) {
  return trainer.stiffness != wall.stiffness || trainer.damping != wall.damping;
}

std::string trainer_words(const ContactLaw& wall, const TrainerAnswer& trainer) {
  if (!trainer.problem.empty()) return fmt::format("The trainer does not run there: {}.\n", trainer.problem);
  const AdmittedTuning& admitted = trainer.admitted;
  std::string text = fmt::format("The trainer would use {}, {}{}\n",
                                 wall_words(admitted.tuning.wall_stiffness, admitted.tuning.wall_damping),
                                 hold_words(admitted.hold), admitted.limited.empty() ? "." : ":");
  if (is_clipped(wall, trainer))
    text += fmt::format("  asked for {}, the most that it takes\n", wall_words(trainer.stiffness, trainer.damping));
  for (const Limited& limited : admitted.limited) text += fmt::format("  {}\n", limited_words(limited));
  return text;
}

Json limited_json(const Limited& limited) {
  const auto value = [&](double number) {
    return limited.what == "hold" ? Json(hold_name(static_cast<ContactHold>(number))) : Json(number);
  };
  return {{"law", limited.law},
          {"what", limited.what},
          {"wanted", value(limited.wanted)},
          {"used", value(limited.used)},
          {"hand", limited.hand}};
}

// Nothing but nulls where the trainer does not run.
Json trainer_json(const TrainerAnswer& trainer) {
  const HapticTuning& tuning = trainer.admitted.tuning;
  const auto known = [&](const auto& value) { return trainer.problem.empty() ? Json(value) : Json(nullptr); };
  Json limited = Json::array();
  for (const Limited& one : trainer.admitted.limited) limited.push_back(limited_json(one));
  return {{"asked_wall_stiffness_n_per_m", known(trainer.stiffness)},
          {"asked_wall_damping_n_s_per_m", known(trainer.damping)},
          {"admitted_wall_stiffness_n_per_m", known(tuning.wall_stiffness)},
          {"admitted_wall_damping_n_s_per_m", known(tuning.wall_damping)},
          {"admitted_hold", known(hold_name(trainer.admitted.hold))},
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

std::string device_words(const StabilityQuestion& question) {
  return fmt::format("{}: m = {:g} kg, b = {:g} N s/m, k = {:g} N/m", question.device, question.handle.mass,
                     question.handle.damping, question.handle.stiffness);
}

std::string loop_words(const StabilityQuestion& question) {
  const ContactLaw& wall = question.wall;
  const std::string delay =
      wall.delay == 0 ? "no delay" : fmt::format("{} sample{} of delay", wall.delay, wall.delay == 1 ? "" : "s");
  return fmt::format("{:g} Hz (T = {:g} ms), {}, {}", question.rate, 1e3 * question.period(), delay, law_words(wall));
}

std::string stability_text(const StabilityQuestion& question, const StabilityAnswer& answer,
                           const TrainerAnswer& trainer) {
  const ContactLaw& wall = question.wall;
  std::string text = fmt::format("device   {}\n", device_words(question));
  text += fmt::format("loop     {}\n", loop_words(question));
  text += fmt::format("wall     {}\n\n", wall_words(wall));
  text += hand_table(question, answer);
  text += fmt::format("\nMay a wall of {} be used?\n{}", wall_words(wall), verdict_words(question, answer));
  text += fmt::format("  exact    {}: {:.6f}, {}\n", kExactLaw, answer.radius, up_to(answer.limit));
  text += "  passive  " + passive_words(wall, answer);
  text += "Passivity is sufficient for stability with every passive hand, not necessary: the exact limit decides.\n";
  return text + trainer_words(wall, trainer);
}

std::string stability_json(const StabilityQuestion& question, const StabilityAnswer& answer,
                           const TrainerAnswer& trainer) {
  const ContactLaw& wall = question.wall;
  Json json{{"device", question.device},
            {"mass_kg", question.handle.mass},
            {"damping_n_s_per_m", question.handle.damping},
            {"stiffness_n_per_m", question.handle.stiffness},
            {"rate_hz", question.rate},
            {"period_s", question.period()},
            {"delay_samples", wall.delay},
            {"window_samples", wall.window},
            {"hold", hold_name(wall.hold)},
            {"wall_stiffness_n_per_m", wall.stiffness},
            {"wall_damping_n_s_per_m", wall.damping},
            {"may_use", answer.may_use},
            {"stable", answer.stable},
            {"passive", answer.passive ? Json(*answer.passive) : Json(nullptr)},
            {"k_max_n_per_m", finite_or_null(answer.limit)},
            {"passive_k_max_n_per_m", finite_or_null(answer.passive_limit)},
            {"spectral_radius", finite_or_null(answer.radius)},
            {"deciding_hand", question.hands[answer.deciding].name},
            {"law", kExactLaw},
            {"passive_law", passive_law(wall)}};
  json.update(trainer_json(trainer));
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

}  // namespace gearshift
