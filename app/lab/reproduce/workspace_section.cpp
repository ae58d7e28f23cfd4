#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "app/base/colours.h"
#include "app/lab/reproduce/section.h"
#include "app/lab/reproduce/study_files.h"
#include "haptics/joystick/kinematics.h"

namespace gearshift::lab {
namespace {

constexpr int kLines = 8;          // number of grid steps of each joint, from stop to stop
constexpr int kStepsPerSide = 40;  // number of steps from the centre to each end of a curve

// The paper's eq (2) as printed, with sin(theta) in y where eq (1) has cos(theta). Used only to show the error of the
// printed equation.
glm::dvec3 printed_tip(const haptics::YokeGeometry& yoke, haptics::JointAngles q) {
  const double st = std::sin(q.theta), sp = std::sin(q.phi), cp = std::cos(q.phi);
  return yoke.radius / std::sqrt(1.0 - sp * sp * st * st) * glm::dvec3(cp * st, -sp * st, cp * std::cos(q.theta));
}

void add_row(CsvFile& csv, const haptics::YokeGeometry& yoke, haptics::JointAngles q) {
  const glm::dvec3 tip = 1e3 * haptics::tip_position(yoke, q), small = 1e3 * haptics::tip_position_small_angle(yoke, q);
  csv.row({q.theta / kDegree, q.phi / kDegree, tip.x, tip.y, tip.z, small.x, small.y});
}

// Writes lines along which one joint is fixed and the other joint moves from stop to stop.
void write_grid(const Study& study) {
  const haptics::YokeGeometry& yoke = study.preset.lever.yoke;
  CsvFile csv(study, "workspace", "theta_deg,phi_deg,x_mm,y_mm,z_mm,small_angle_x_mm,small_angle_y_mm");
  for (const bool theta_held : {true, false}) {
    for (int i = 0; i <= kLines; ++i) {
      const double held = 2.0 * i / kLines - 1.0;
      for (int j = -kStepsPerSide; j <= kStepsPerSide; ++j) {
        const double moved = static_cast<double>(j) / kStepsPerSide;
        add_row(csv, yoke,
                {yoke.theta_limit * (theta_held ? held : moved), yoke.phi_limit * (theta_held ? moved : held)});
      }
      csv.line("");
    }
  }
  csv.finish();
}

void draw_workspace(const Study& study) {
  write_grid(study);
  draw(study, {"workspace", 1100, 470,
               fmt::format(R"gp(set multiplot layout 1,2 margins 0.07, 0.98, 0.13, 0.9 spacing 0.09
set size ratio -1
set key horizontal center tmargin
set xlabel "theta, about Y [deg]"
set ylabel "phi, about X [deg]"
set offsets 4, 4, 4, 4
plot "workspace.csv" using "theta_deg":"phi_deg" with lines linecolor "{blue}" title "action space of the joints"
set xlabel "select x [mm]"
set ylabel "shift y [mm]"
set offsets 6, 6, 6, 6
plot "workspace.csv" using "small_angle_x_mm":"small_angle_y_mm" \
    with lines linecolor "{red}" dashtype 3 title "small angles, (3)", \
  "workspace.csv" using "x_mm":"y_mm" with lines linecolor "{blue}" title "workspace, (2)"
unset multiplot
)gp",
                           fmt::arg("blue", base::kGearColour), fmt::arg("red", base::kLockoutColour))});
}

struct SmallAngleError {
  double component = 0.0, plane = 0.0, space = 0.0;  // [m]
};

// Error of the paper's small-angle formula, eq (3), with both joints at the given angle.
SmallAngleError small_angle_error(const haptics::YokeGeometry& yoke, double angle) {
  const glm::dvec3 error =
      haptics::tip_position_small_angle(yoke, {angle, angle}) - haptics::tip_position(yoke, {angle, angle});
  return {std::abs(error.x), std::hypot(error.x, error.y), glm::length(error)};
}

double printed_radius_error(const haptics::YokeGeometry& yoke, haptics::JointAngles q) {
  return glm::length(printed_tip(yoke, q)) - yoke.radius;
}

void draw_plane_errors(const Study& study) {
  const haptics::YokeGeometry& yoke = study.preset.lever.yoke;
  const double max_angle = std::min(yoke.theta_limit, yoke.phi_limit);
  CsvFile csv(study, "workspace_errors",
              "angle_deg,component_mm,plane_mm,space_mm,radius_theta_0_mm,radius_theta_half_mm,radius_theta_limit_mm");
  for (int i = 0; i <= kStepsPerSide; ++i) {
    const double angle = max_angle * i / kStepsPerSide;
    const SmallAngleError error = small_angle_error(yoke, angle);
    const auto radius = [&](double theta) { return 1e3 * printed_radius_error(yoke, {theta, angle}); };
    csv.row({angle / kDegree, 1e3 * error.component, 1e3 * error.plane, 1e3 * error.space, radius(0.0),
             radius(0.5 * yoke.theta_limit), radius(yoke.theta_limit)});
  }
  csv.finish();
  draw(study, {"workspace_errors", 1100, 460,
               fmt::format(R"gp(set multiplot layout 1,2 margins 0.07, 0.98, 0.13, 0.9 spacing 0.09
set key left top Left reverse
set xlabel "theta = phi [deg]"
set ylabel "error of (3) [mm]"
plot "workspace_errors.csv" using "angle_deg":"component_mm" \
    with lines linewidth 1.6 linecolor "{blue}" title "per component", \
  "workspace_errors.csv" using "angle_deg":"plane_mm" \
    with lines linewidth 1.6 linecolor "{orange}" title "in the plane", \
  "workspace_errors.csv" using "angle_deg":"space_mm" with lines linewidth 1.6 linecolor "{red}" title "in space"
set key left bottom Left reverse
set xlabel "phi [deg]"
set ylabel "radius from (2) as printed, minus rho [mm]"
plot "workspace_errors.csv" using "angle_deg":"radius_theta_0_mm" \
    with lines linewidth 1.6 linecolor "{red}" title "theta = 0", \
  "workspace_errors.csv" using "angle_deg":"radius_theta_half_mm" \
    with lines linewidth 1.6 linecolor "{orange}" title "theta = {half:g} deg", \
  "workspace_errors.csv" using "angle_deg":"radius_theta_limit_mm" \
    with lines linewidth 1.6 linecolor "{blue}" title "theta = {limit:g} deg"
unset multiplot
)gp",
                           fmt::arg("blue", base::kGearColour), fmt::arg("red", base::kLockoutColour),
                           fmt::arg("orange", base::kBufferColour), fmt::arg("half", 0.5 * yoke.theta_limit / kDegree),
                           fmt::arg("limit", yoke.theta_limit / kDegree))});
}

// Largest errors of the tip position by the paper's eq (2), over a fine grid of poses. `rho` is the radius of the
// sphere on which the tip moves.
struct GridSurvey {
  double printed_radius = 0.0;  // [m] distance from the sphere of radius rho, by the paper's eq (2) as printed
  double radius = 0.0;          // [m] distance from the sphere of radius rho, by the corrected eq (2)
  double round_trip = 0.0;      // [rad] difference between the joint angles and those recomputed from the tip
};

GridSurvey survey(const haptics::YokeGeometry& yoke) {
  GridSurvey worst;
  for (int i = -kStepsPerSide; i <= kStepsPerSide; ++i) {
    for (int j = -kStepsPerSide; j <= kStepsPerSide; ++j) {
      const haptics::JointAngles q{yoke.theta_limit * i / kStepsPerSide, yoke.phi_limit * j / kStepsPerSide};
      const glm::dvec3 tip = haptics::tip_position(yoke, q);
      const haptics::JointAngles back = haptics::joint_angles(tip);
      worst.printed_radius = std::max(worst.printed_radius, std::abs(printed_radius_error(yoke, q)));
      worst.radius = std::max(worst.radius, std::abs(glm::length(tip) - yoke.radius));
      worst.round_trip = std::max({worst.round_trip, std::abs(back.theta - q.theta), std::abs(back.phi - q.phi)});
    }
  }
  return worst;
}

Finding small_plane_angles(const haptics::YokeGeometry& yoke) {
  const auto at = [&](double degrees) {
    const SmallAngleError error = small_angle_error(yoke, degrees * kDegree);
    return std::array{1e3 * error.component, 1e3 * error.plane, 1e3 * error.space};
  };
  const auto [c10, p10, s10] = at(10.0);
  const auto [c20, p20, s20] = at(20.0);
  const auto [c35, p35, s35] = at(35.0);
  return {
      "(3): for small angles p = rho (theta, -phi, 1)",
      fmt::format("with both joints at 10, 20 and 35 deg, (3) is off by {:.2f}, {:.1f} and {:.1f} mm per component",
                  c10, c20, c35),
      fmt::format("{:.2f}, {:.1f} and {:.0f} mm in the plane; {:.1f}, {:.0f} and {:.0f} mm in space; the exact form "
                  "is used throughout",
                  p10, p20, p35, s10, s20, s35)};
}

Finding misprint(const GridSurvey& worst) {
  return {"(2): p_y = -rho sin(phi) sin(theta) / sqrt D", "-rho sin(phi) cos(theta) / sqrt D, as in (1)",
          fmt::format("a misprint; the radius is off by up to {:.1f} mm as printed, and by {:.1g} mm when corrected",
                      1e3 * worst.printed_radius, 1e3 * worst.radius)};
}

Finding ranges(const haptics::YokeGeometry& yoke) {
  const glm::dvec2 reach = 1e3 * haptics::workspace_half_extent(yoke);
  const glm::dvec3 corner = 1e3 * haptics::tip_position(yoke, {yoke.theta_limit, -yoke.phi_limit});
  return {"Section 2.1: phi in [-35, 35] deg, theta in [-40, 40] deg; rho about 120 mm",
          fmt::format(
              "phi up to {:g} deg, theta up to {:g} deg, rho {:g} mm; the tip reaches {:.1f} mm in x and {:.1f} mm in "
              "y, and ({:.1f}, {:.1f}) mm in the corners",
              yoke.phi_limit / kDegree, yoke.theta_limit / kDegree, 1e3 * yoke.radius, reach.x, reach.y, corner.x,
              corner.y),
          fmt::format("phi {}, theta {}, rho {}", relative(yoke.phi_limit, 35.0 * kDegree),
                      relative(yoke.theta_limit, 40.0 * kDegree), relative(yoke.radius, 0.12))};
}

Finding inverse(const GridSurvey& worst) {
  return {
      "Section 2.1: the intersection of the trajectories T_x and T_y determines where the yoke points; the paper gives "
      "no inverse",
      "theta = atan2(p_x, p_z), phi = atan2(-p_y, p_z)",
      fmt::format("inverse of the forward map: within {:.0e} rad in the whole workspace", worst.round_trip)};
}

}  // namespace

Section workspace_section(const Study& study) {
  const haptics::YokeGeometry& yoke = study.preset.lever.yoke;
  draw_workspace(study);
  draw_plane_errors(study);
  const GridSurvey worst = survey(yoke);
  return {
      "workspace",
      "Fig. 1, 2: action space and workspace",
      "Both joints of the preset's yoke move from stop to stop. The tip position follows from (2) with a corrected y "
      "component. The gate lies in the plane (x, y), where the workspace is not a rectangle, because a point away from "
      "the axes needs larger angles of both joints. D = 1 - sin^2(phi) sin^2(theta).",
      {small_plane_angles(yoke), misprint(worst), ranges(yoke), inverse(worst)},
      {{"workspace",
        "Left: the action space, a grid of joint angles. Right: the tip in the gate's plane, by the exact form and by "
        "the "
        "small-angle form (3)."},
       {"workspace_errors",
        "Left: the error of (3) with both joints at the same angle. Right: (2) as printed does not stay on the "
        "sphere."}}};
}

}  // namespace gearshift::lab
