#include <string>
#include <vector>

#include <fmt/format.h>

#include "app/lab/reproduce/section.h"
#include "app/lab/reproduce/study_files.h"
#include "app/lab/tour/tour.h"

namespace gearshift::lab {
namespace {

TourSetup tour_setup(const Study& study) {
  TourSetup setup;
  setup.layout = study.layout;
  setup.gate = study.gate;
  setup.lever = study.preset.lever;
  setup.lever.hand = haptics::leading_hand(study.preset.lever.hand);
  setup.haptics = study.preset.haptics;
  setup.folder = study.folder;
  return setup;
}

Finding order_finding(const TourResult& tour) {
  std::vector<std::string> gears;
  for (const GearTime& one : tour.engaged)
    gears.push_back(fmt::format("{} at {:.1f} s", haptics::gear_name(one.gear), one.time));
  return {"Section 4: the lever moves from neutral through the five forward gears, and finally into reverse",
          gears.empty() ? "no gear was engaged" : fmt::format("{}", fmt::join(gears, ", ")),
          tour.complete() ? "none; every gear was engaged in this order, and no other gear"
                          : "the simulated hand did not engage every gear in order"};
}

Finding confined_finding(const TourResult& tour) {
  return {"Section 4: the lever was confined to move within the aisles",
          fmt::format("at most {:.2f} mm beyond a wall, in contact in {:.0f} % of the cycles", 1e3 * tour.deepest,
                      100.0 * tour.contact_fraction()),
          "the displayed lever (the proxy) never leaves the free space"};
}

Finding force_finding(const TourResult& tour) {
  return {"Fig. 9 (b): the force response, which reflects how the joystick hit the wall",
          fmt::format("the hand pushes with up to {:.1f} N", tour.strongest),
          "Fig. 9 is missing from our copy of the paper, and the text gives no numbers"};
}

std::string format_hand(const Study& study, const haptics::HandImpedance& hand) {
  const bool is_preset_hand = hand.stiffness == study.preset.lever.hand.stiffness;
  return fmt::format("{} hand of {:g} kg, {:g} N s/m, {:g} N/m", is_preset_hand ? "The preset's" : "A", hand.mass,
                     hand.damping, hand.stiffness);
}

}  // namespace

Section tour_section(const Study& study) {
  const TourSetup setup = tour_setup(study);
  const TourProgress progress = [&](std::string_view what, double) { report_progress(study, what); };
  const TourResult tour = drive_tour(setup, progress);
  draw_tour(setup, tour, progress);
  return {
      "tour",
      "Fig. 9: the tour through the six gears",
      fmt::format("{} moves the preset's lever in minimum-jerk strokes through every gear of the gate, in {:.2f} s at "
                  "{:g} Hz with the preset's tuning. gearshift replay can replay tour.trace bit for bit.",
                  format_hand(study, setup.lever.hand), tour.duration, study.preset.haptics.rate),
      {order_finding(tour), confined_finding(tour), force_finding(tour)},
      {{"trajectory", "Fig. 9 (a): paths of the real lever and of the displayed lever.", "tour"},
       {"force", "Fig. 9 (b): position, the hand's force as measured, and the motors' commanded force.", "tour"}}};
}

}  // namespace gearshift::lab
