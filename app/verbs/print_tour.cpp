#include "app/verbs/print_tour.h"

#include "app/base/console.h"
#include "app/verbs/print_json.h"
#include "haptics/loop/haptic_config.h"

namespace gearshift::verbs {

void print_tour(const lab::TourSetup& setup, const lab::TourResult& result) {
  for (const haptics::TuningLimit& limited : result.limits) {
    base::print_message("{}", haptics::describe(limited));
  }
  base::print_out("{}: {:.2f} s at {:g} Hz\n", setup.layout.name, result.duration, setup.haptics.rate);
  for (const lab::GearTime& gear : result.engaged)
    base::print_out("  {:>2} engaged at {:6.3f} s\n", haptics::gear_label(setup.gate, gear.gear), gear.time);
  if (result.softest < result.admitted) {
    base::print_message("the lever chattered on a wall, so the wall was softened from {:g} to {:g} N/m",
                        result.admitted, result.softest);
  }
  if (result.lost.times > 0) {
    base::print_message("the force guard switched the forces off {}, first after {:.3f} s; fault: {}",
                        result.lost.times == 1 ? "once" : fmt::format("{} times", result.lost.times), result.lost.time,
                        haptics::to_string(result.lost.fault));
  }
  base::print_out(
      "in contact with a wall in {:.0f} % of the cycles, at most {:.2f} mm beyond a wall; strongest push: {:.1f} N; "
      "hash {:016x}\n",
      100.0 * result.contact_fraction(), 1e3 * result.deepest, result.strongest, result.hash);
}

void print_tour_json(const lab::TourSetup& setup, const lab::TourResult& result) {
  nlohmann::ordered_json json{{"gate", setup.layout.name},
                              {"rate_hz", setup.haptics.rate},
                              {"duration_s", result.duration},
                              {"complete", result.complete()}};
  json["engaged"] = json["limits"] = nlohmann::ordered_json::array();
  for (const lab::GearTime& gear : result.engaged)
    json["engaged"].push_back({{"gear", haptics::gear_name(gear.gear)}, {"time_s", gear.time}});
  for (const haptics::TuningLimit& limited : result.limits) json["limits"].push_back(haptics::describe(limited));
  json["wall_stiffness_n_per_m"] = {{"admitted", result.admitted}, {"softest", result.softest}};
  json["forces_lost"] = {{"times", result.lost.times}};
  if (result.lost.times > 0)
    json["forces_lost"].update({{"first_s", result.lost.time}, {"fault", haptics::to_string(result.lost.fault)}});
  json["in_contact"] = result.contact_fraction();
  json["deepest_m"] = result.deepest;
  json["strongest_push_n"] = result.strongest;
  json["hash"] = fmt::format("{:016x}", result.hash);
  json["folder"] = setup.folder.string();
  print_json(json);
}

}  // namespace gearshift::verbs
