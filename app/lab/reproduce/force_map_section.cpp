#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "app/base/colours.h"
#include "app/lab/reproduce/section.h"
#include "app/lab/reproduce/study_files.h"
#include "app/lab/tour/tour.h"
#include "haptics/joystick/kinematics.h"
#include "haptics/joystick/plane_pose.h"
#include "haptics/loop/shift_script.h"
#include "haptics/loop/simulated_run.h"

namespace gearshift::lab {
namespace {

constexpr int kSteps = 28;  // grid steps of the force map in each direction

struct MotorTorques {
  double rated = 0.0, peak = 0.0;  // [N m]
};

MotorTorques motor_torques(const haptics::SimulatedLeverConfig& lever) {
  return {lever.yoke.radius * lever.actuator.continuous_force, lever.yoke.radius * lever.actuator.peak_force};
}

double force_of(const haptics::YokeGeometry& yoke, haptics::JointAngles q, haptics::JointTorques torque) {
  return glm::length(haptics::tip_force(yoke, q, torque));
}

// Writes the force map of each motor separately. The total force is the vector sum of both.
void write_map(const Study& study) {
  const haptics::YokeGeometry& yoke = study.preset.lever.yoke;
  const auto [rated, peak] = motor_torques(study.preset.lever);
  CsvFile csv(study, "force_map", "x_mm,y_mm,select_rated_n,select_peak_n,shift_rated_n,shift_peak_n");
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; j <= kSteps; ++j) {
      const haptics::JointAngles q{yoke.theta_limit * (2.0 * i / kSteps - 1.0),
                                   yoke.phi_limit * (2.0 * j / kSteps - 1.0)};
      const glm::dvec3 tip = 1e3 * haptics::tip_position(yoke, q);
      csv.row({tip.x, tip.y, force_of(yoke, q, {rated, 0.0}), force_of(yoke, q, {peak, 0.0}),
               force_of(yoke, q, {0.0, rated}), force_of(yoke, q, {0.0, peak})});
    }
    csv.line("");
  }
  csv.finish();
}

std::string map_panel(const char* title, const char* column) {
  return fmt::format("set title \"{}\"\nsplot \"force_map.csv\" using \"x_mm\":\"y_mm\":\"{}\" with pm3d notitle\n",
                     title, column);
}

void draw_map(const Study& study) {
  write_map(study);
  const auto [rated, peak] = motor_torques(study.preset.lever);
  draw(
      study,
      {"force_map", 1050, 900,
       fmt::format(
           "set multiplot layout 2,2\nset view map\nset size ratio -1\nset palette defined (0 \"#f1f3f6\", 1 \"{}\")\n"
           "set xlabel \"select x [mm]\"\nset ylabel \"shift y [mm]\" offset -2\n"
           "set cblabel \"tip force [N]\" offset 1.5\n{}{}{}{}unset multiplot\n",
           base::kGearColour, map_panel(fmt::format("select motor, rated {:.2f} N m", rated).c_str(), "select_rated_n"),
           map_panel(fmt::format("shift motor, rated {:.2f} N m", rated).c_str(), "shift_rated_n"),
           map_panel(fmt::format("select motor, peak {:.2f} N m", peak).c_str(), "select_peak_n"),
           map_panel(fmt::format("shift motor, peak {:.2f} N m", peak).c_str(), "shift_peak_n"))});
}

// Relative error of the paper's small-angle approximation, eq (6): x component of the exact force, divided by that of
// eq (6), minus 1.
double small_angle_excess(const haptics::YokeGeometry& yoke, haptics::JointAngles q) {
  const haptics::JointTorques torque{1.0, 0.0};
  return haptics::tip_force(yoke, q, torque).x / haptics::tip_force_small_angle(yoke, torque).x - 1.0;
}

// The paper's eq (5) as printed, with sin(phi) instead of cos(phi). Used only to show the error of the printed
// equation.
double printed_x_force(const haptics::YokeGeometry& yoke, haptics::JointAngles q, double torque) {
  const double st = std::sin(q.theta), sp = std::sin(q.phi);
  return std::sqrt(1.0 - sp * sp * st * st) / yoke.radius * torque * std::cos(q.theta) / sp;
}

void draw_errors(const Study& study) {
  const haptics::YokeGeometry& yoke = study.preset.lever.yoke;
  const double rated = motor_torques(study.preset.lever).rated;
  const double max_angle = std::min(yoke.theta_limit, yoke.phi_limit);
  CsvFile csv(study, "force_errors",
              "angle_deg,both_percent,theta_only_percent,phi_only_percent,printed_x_n,corrected_x_n");
  for (int i = 1; i <= 70; ++i) {
    const double angle = max_angle * i / 70;
    const haptics::JointAngles pose{10.0 * kDegree, angle};
    csv.row({angle / kDegree, 100.0 * small_angle_excess(yoke, {angle, angle}),
             100.0 * small_angle_excess(yoke, {angle, 0.0}), 100.0 * small_angle_excess(yoke, {0.0, angle}),
             printed_x_force(yoke, pose, rated), haptics::tip_force(yoke, pose, {rated, 0.0}).x});
  }
  csv.finish();
  draw(study, {"force_errors", 1100, 460,
               fmt::format(R"gp(set multiplot layout 1,2 margins 0.07, 0.98, 0.13, 0.9 spacing 0.09
set key left bottom Left reverse
set xlabel "angle [deg]"
set ylabel "exact x force minus (6) [%]"
plot "force_errors.csv" using "angle_deg":"both_percent" \
    with lines linewidth 1.6 linecolor "{blue}" title "theta = phi = angle", \
  "force_errors.csv" using "angle_deg":"theta_only_percent" \
    with lines linewidth 1.6 linecolor "{red}" title "theta = angle, phi = 0", \
  "force_errors.csv" using "angle_deg":"phi_only_percent" \
    with lines linewidth 1.6 linecolor "{orange}" title "phi = angle, theta = 0"
set key right top Left reverse
set xlabel "phi [deg], theta = 10 deg"
set ylabel "x force at the rated torque [N]"
set yrange [0:100]
plot "force_errors.csv" using "angle_deg":"printed_x_n" \
    with lines linewidth 1.6 linecolor "{red}" title "(5) as printed", \
  "force_errors.csv" using "angle_deg":"corrected_x_n" with lines linewidth 1.6 linecolor "{blue}" title "(5) corrected"
unset multiplot
)gp",
                           fmt::arg("blue", base::kGearColour), fmt::arg("red", base::kLockoutColour),
                           fmt::arg("orange", base::kBufferColour))});
}

// Largest relative difference between the power at the tip and the power at the motors [1], over the workspace with
// both joints moving. The tip's velocity is a numeric derivative of the paper's eq (2), so this check does not depend
// on any force map.
double power_mismatch(const haptics::YokeGeometry& yoke) {
  constexpr double kStep = 1e-6;  // [rad]
  const haptics::JointTorques torque{1.0, -0.7}, rate{0.6, 0.8};
  double worst = 0.0;
  for (int i = -8; i <= 8; ++i) {
    for (int j = -8; j <= 8; ++j) {
      const haptics::JointAngles q{yoke.theta_limit * i / 8, yoke.phi_limit * j / 8};
      const auto tip = [&](double s) {
        return haptics::tip_position(yoke, {q.theta + s * rate.theta, q.phi + s * rate.phi});
      };
      const glm::dvec3 velocity = (tip(kStep) - tip(-kStep)) / (2.0 * kStep);
      const double motors = torque.theta * rate.theta + torque.phi * rate.phi;
      worst = std::max(worst, std::abs(glm::dot(haptics::tip_force(yoke, q, torque), velocity) / motors - 1.0));
    }
  }
  return worst;
}

struct ForceFlow {
  double hand = 0.0;      // [N] largest push
  double moved = 0.0;     // [N] largest force that the lever's motion requires
  double mismatch = 0.0;  // [N] root mean square of the paper's f_j, eq (4), minus the required force
};

// Computes the force that the handle's motion requires, m a + b v + k x along the arcs, with the handle's mass m,
// damping b and stiffness k. The acceleration comes from the true velocities of two samples.
class MotionForce {
 public:
  MotionForce(const haptics::DeviceSpec& device, const haptics::YokeGeometry& yoke, double period)
      : x_(device.axis_x), y_(device.axis_y), yoke_(yoke), period_(period) {}

  struct Pair {
    glm::dvec2 needed{0.0}, f_j{0.0};  // [N]
  };

  Pair of(const haptics::SimulatedLever& lever, glm::dvec2 f_j) {
    const haptics::JointAngles q = haptics::joint_angles_from_plane(yoke_, lever.true_position());
    const haptics::PlanePose pose = haptics::plane_pose(std::tan(q.theta), std::tan(q.phi));
    const glm::dvec2 arc = haptics::arc_position(yoke_, q),
                     velocity = haptics::arc_velocity(pose, lever.true_velocity());
    const glm::dvec2 acceleration = (velocity - last_velocity_) / period_;
    last_velocity_ = velocity;
    const glm::dvec2 mass{x_.mass, y_.mass}, damping{x_.damping, y_.damping}, stiffness{x_.stiffness, y_.stiffness};
    return {mass * acceleration + damping * velocity + stiffness * arc, haptics::arc_force(pose, f_j)};
  }

 private:
  haptics::AxisModel x_, y_;
  haptics::YokeGeometry yoke_;
  double period_;  // [s]
  glm::dvec2 last_velocity_{0.0};
};

// Simulates the tour's first shift, into first gear, with the trainer's haptic cycle.
ForceFlow drive_force_flow(const Study& study) {
  haptics::SimulatedRunConfig config{study.preset.haptics, study.preset.lever, study.gate,
                                     haptics::rest_position(study.gate, haptics::kNeutralGear)};
  config.lever.hand = haptics::leading_hand(study.preset.lever.hand);
  const std::array gears{haptics::tour_order(study.gate).front()};
  haptics::ScriptedHand hand(haptics::touring_hand(config.start),
                             haptics::shift_strokes(study.gate, config.start, gears),
                             haptics::period_s(config.haptics));
  haptics::SimulatedRun run(config, hand);
  MotionForce motion(study.device, config.lever.yoke, run.period());
  CsvFile csv(study, "force_flow", "time_s,f_h_x_n,f_h_y_n,f_a_x_n,f_a_y_n,f_j_x_n,f_j_y_n");
  ForceFlow flow;
  double squares = 0.0;
  while (run.time() < hand.duration()) {
    const double time = run.time();
    const haptics::HapticSnapshot& now = run.step();
    csv.row({time, now.f_h.x, now.f_h.y, now.f_a.x, now.f_a.y, now.f_j.x, now.f_j.y});
    const auto [needed, f_j] = motion.of(run.lever(), now.f_j);
    flow.hand = std::max(flow.hand, glm::length(now.f_h));
    flow.moved = std::max(flow.moved, glm::length(needed));
    squares += glm::dot(f_j - needed, f_j - needed);
  }
  csv.finish();
  flow.mismatch = std::sqrt(squares * run.period() / run.time());
  return flow;
}

std::string flow_panel(const char* axis, const char* label) {
  return fmt::format(R"gp(set ylabel "{1} [N]"
plot "force_flow.csv" using "time_s":"f_h_{0}_n" with lines linecolor "{2}" title "f_h, hand", \
  "force_flow.csv" using "time_s":"f_a_{0}_n" with lines linecolor "{3}" title "f_a, motors", \
  "force_flow.csv" using "time_s":"f_j_{0}_n" with lines linewidth 1.4 linecolor "{4}" title "f_j, moving the lever"
)gp",
                     axis, label, base::kLockoutColour, base::kGearColour, base::kInk);
}

void draw_force_flow(const Study& study) {
  draw(study, {"force_flow", 1000, 560,
               fmt::format("set multiplot layout 2,1 margins 0.08, 0.72, 0.1, 0.96 spacing 0.06\n"
                           "set key outside right top Left reverse\nset format x \"\"\n{}set format x \"%g\"\nset "
                           "xlabel \"time [s]\"\nunset key\n{}unset multiplot\n",
                           flow_panel("x", "select x"), flow_panel("y", "shift y"))});
}

Finding small_angles(const haptics::YokeGeometry& yoke) {
  const auto both = [&](double degrees) {
    return 100.0 * small_angle_excess(yoke, {degrees * kDegree, degrees * kDegree});
  };
  return {
      "(6): for small angles f_a = (tau_theta, -tau_phi) / rho",
      fmt::format("with both joints at 10, 20 and 35 deg, the true component differs by {:+.2f}, {:+.1f} and {:+.1f} %",
                  both(10.0), both(20.0), both(35.0)),
      fmt::format("the errors of the two joints cancel; 35 deg in theta alone gives {:+.0f} %, in phi alone {:+.0f} %",
                  100.0 * small_angle_excess(yoke, {35.0 * kDegree, 0.0}),
                  100.0 * small_angle_excess(yoke, {0.0, 35.0 * kDegree}))};
}

Finding misprint(const Study& study) {
  const haptics::YokeGeometry& yoke = study.preset.lever.yoke;
  const haptics::JointAngles pose{10.0 * kDegree, 10.0 * kDegree};
  const double rated = motor_torques(study.preset.lever).rated;
  const double printed = printed_x_force(yoke, pose, rated),
               true_force = haptics::tip_force(yoke, pose, {rated, 0.0}).x;
  return {"(5): f_ax = sqrt D / rho tau_theta cos(theta) / sin(phi), f_ay = sqrt D / rho tau_phi cos(phi) / cos(theta)",
          fmt::format("with cos(phi) in the denominator of x and a minus sign in y, f . dp = tau . dq holds to {:.0e}",
                      power_mismatch(yoke)),
          fmt::format("a misprint; with both joints at 10 deg and the rated torque, the printed form gives {:.1f} N "
                      "instead of {:.1f} N, and at phi = 0 it is infinite",
                      printed, true_force)};
}

Finding flow_finding(const Study& study, const ForceFlow& flow) {
  const double resolution = study.preset.lever.force_sensor.resolution_gw * haptics::kNewtonPerGramWeight;
  return {"(4): f_j = f_h - f_a, the combined force on the joystick",
          fmt::format("in a shift with pushes of up to {:.1f} N, f_j equals m a + b v + k x of the true motion (up to "
                      "{:.1f} N) within {:.2f} N rms",
                      flow.hand, flow.moved, flow.mismatch),
          fmt::format("the sensor rounds to {:.2f} N, which explains {:.2f} N rms on two axes", resolution,
                      resolution / std::sqrt(6.0))};
}

Finding motors(const Study& study) {
  const auto [rated, peak] = motor_torques(study.preset.lever);
  const double radius = study.preset.lever.yoke.radius;
  return {"Section 2.2: maximum output torque 3.8 \"N/m\"; Table 2: 10.83 \"Nm\"",
          fmt::format("{:.2f} N m give {:.1f} N at the tip for a short time; {:.2f} N m give {:.2f} N continuously",
                      peak, peak / radius, rated, rated / radius),
          fmt::format("peak torque {}; the correct units are N m and N. Neither force reaches the 60 N with which a "
                      "person can push",
                      relative(peak, 3.8))};
}

}  // namespace

Section force_map_section(const Study& study) {
  const haptics::YokeGeometry& yoke = study.preset.lever.yoke;
  draw_map(study);
  draw_errors(study);
  const ForceFlow flow = drive_force_flow(study);
  draw_force_flow(study);
  return {
      "force_map",
      "(4)-(6): forces of the motors at the tip",
      "The motors' torques give a force tangential to the sphere on which the tip moves; the map follows from "
      "virtual work. The last picture shows a shift into first gear, simulated with the same haptic cycle as in the "
      "trainer and with the preset's lever in a simulated hand.",
      {small_angles(yoke), misprint(study), flow_finding(study, flow), motors(study)},
      {{"force_map", "Force at the tip with one motor at its rated torque (top) or its peak torque (bottom)."},
       {"force_errors", "Left: error of the small-angle form (6). Right: (5) as printed and corrected."},
       {"force_flow", "The forces of eq (4) during a shift from neutral into first gear."}}};
}

}  // namespace gearshift::lab
