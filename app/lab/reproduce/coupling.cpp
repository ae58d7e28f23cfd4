#include "app/lab/reproduce/coupling.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "app/base/colours.h"
#include "app/lab/reproduce/element_trial.h"
#include "app/lab/reproduce/study_files.h"
#include "app/lab/reproduce/virtual_element.h"

namespace gearshift::lab {
namespace {

using glm::dvec2;

struct Crosstalk {
  double angle = 0.0;   // [deg] constant lever angle in Y; the stroke in X has the same angle
  double motion = 0.0;  // [%] ratio of the motion in Y to the motion in X
  double force = 0.0;   // [%] ratio of the force in Y to the force in X
};

// Pushes the lever along x with springs on both axes and measures the effect on y.
Crosstalk couple_axes(const Study& study, double degrees, bool joints) {
  // [1] Stiffness of the springs as a fraction of the paper's limit, eq (14). With it the motors can hold the largest
  // angle.
  constexpr double kCouplingFraction = 0.4;
  constexpr double kMove = 0.5;  // [s] duration of each movement
  Trial trial = free_trial(study, kPaperRate);
  const haptics::SimulatedLeverConfig& lever = trial.lever;
  const double spring_x = kCouplingFraction * element_limits(lever.axis_x, 1.0 / kPaperRate).spring;
  const double spring_y = kCouplingFraction * element_limits(lever.axis_y, 1.0 / kPaperRate).spring;
  trial.start = haptics::plane_position(lever.yoke, {0.0, -degrees * kDegree});
  const double push = spring_x * lever.yoke.radius * std::sin(degrees * kDegree);
  const double upright = lever.axis_y.stiffness * lever.yoke.radius * degrees * kDegree / std::cos(degrees * kDegree);
  trial.hand = [=](double time, dvec2) {
    const double forward_part = haptics::minimum_jerk({0.0, 0.0}, {1.0, 0.0}, time, kMove).position.x;
    const double return_part = haptics::minimum_jerk({0.0, 0.0}, {1.0, 0.0}, time - kMove, kMove).position.x;
    haptics::HandTarget target;
    target.push = {push * (forward_part - return_part), upright};  // `upright` balances the handle's own spring in Y
    return target;
  };
  trial.lever.hand = haptics::kBareHand;
  trial.duration = 2.0 * kMove;
  VirtualElement load({0.0, 0.0, spring_x}, {0.0, 0.0, spring_y}, trial.start,
                      joints ? std::optional(lever.yoke) : std::nullopt);
  trial.load = &load;

  double x = 0.0, y = 0.0, fx = 0.0, fy = 0.0;
  for (const TrialSample& sample : run_trial(trial).samples) {
    x = std::max(x, std::abs(sample.position.x));
    y = std::max(y, std::abs(sample.position.y - trial.start.y));
    fx = std::max(fx, std::abs(sample.motor.x));
    fy = std::max(fy, std::abs(sample.motor.y));
  }
  return {degrees, 100.0 * y / x, 100.0 * fy / fx};
}

std::string coupling_panel(const char* quantity, const char* label) {
  return fmt::format(R"gp(set ylabel "{label}"
plot "coupling.csv" using "angle_deg":"joints_{what}_percent" \
    with linespoints pointtype 7 linecolor "{red}" title "each joint separately, as in the paper", \
  "" using "angle_deg":"plane_{what}_percent" \
    with linespoints pointtype 7 linecolor "{blue}" title "in the plane, with exact kinematics"
)gp",
                     fmt::arg("label", label), fmt::arg("what", quantity), fmt::arg("red", base::kLockoutColour),
                     fmt::arg("blue", base::kGearColour));
}

void draw_coupling(const Study& study) {
  draw(study,
       {"coupling", 1100, 430,
        fmt::format("set multiplot layout 1,2 margins 0.08, 0.98, 0.14, 0.94 spacing 0.1\nset key top left\n"
                    "set xlabel \"angle of the other axis, and stroke [deg]\"\nset yrange [0:*]\n{}{}unset multiplot\n",
                    coupling_panel("motion", "motion of Y / motion of X [%]"),
                    coupling_panel("force", "force on Y / force on X [%]"))});
}

}  // namespace

void add_coupling(const Study& study, Section& section) {
  report_progress(study, "elements: coupling");
  CsvFile csv(study, "coupling",
              "angle_deg,joints_motion_percent,joints_force_percent,plane_motion_percent,plane_force_percent");
  std::string joints, plane;
  for (const double angle : {5.0, 10.0, 15.0, 20.0, 25.0, 30.0}) {
    const Crosstalk per_joint = couple_axes(study, angle, true), exact = couple_axes(study, angle, false);
    csv.row({angle, per_joint.motion, per_joint.force, exact.motion, exact.force});
    if (angle != 5.0 && angle != 10.0 && angle != 20.0 && angle != 30.0) continue;
    joints += fmt::format("{}{:.2g} % of the motion and {:.2g} % of the force at {:g} deg", joints.empty() ? "" : "; ",
                          per_joint.motion, per_joint.force, angle);
    plane +=
        fmt::format("{}{:.2g} and {:.2g} % at {:g} deg", plane.empty() ? "" : "; ", exact.motion, exact.force, angle);
  }
  csv.finish();
  draw_coupling(study);
  section.findings.push_back({"Section 3: \"only insignificant coupling effects between the two joints\"",
                              "springs on each joint separately, pushed along X, measured in Y: " + joints,
                              "springs in the gate plane with the exact kinematics: " + plane});
  section.pictures.push_back({"coupling",
                              "Motion and force in Y while the lever is pushed along X. Both axes have springs; Y is "
                              "held at an angle equal to "
                              "the stroke in X. The coupling comes from the kinematics and is insignificant near the "
                              "middle, as the paper says."});
}

}  // namespace gearshift::lab
