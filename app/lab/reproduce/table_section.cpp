#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "app/lab/identify/identify.h"
#include "app/lab/identify/table_2.h"
#include "app/lab/reproduce/section.h"
#include "app/lab/reproduce/study_files.h"
#include "haptics/joystick/kinematics.h"

namespace gearshift::lab {
namespace {

// Measurements of one axis. Its motor is commanded far above its maximum force until the lever is at the stop and the
// motor has overheated.
struct DrivenAxis {
  double angle = 0.0;       // [rad] angle of the stop, as measured by the encoder
  double peak = 0.0;        // [N] largest motor force along the arc
  double continuous = 0.0;  // [N] motor force at the end
};

DrivenAxis drive_to_stop(const Study& study, glm::dvec2 direction) {
  haptics::SimulatedLeverConfig config = study.preset.lever;
  config.hand = haptics::kBareHand;
  haptics::IdleHand idle_hand;
  haptics::SimulatedLever lever(config, haptics::period_ns(study.preset.haptics), idle_hand);
  const double duration = 2.0 * config.actuator.overload_time + 1.0;
  const auto cycles = static_cast<std::int64_t>(duration / haptics::period_s(study.preset.haptics));
  DrivenAxis driven;
  for (std::int64_t i = 0; i <= cycles; ++i) {
    const haptics::LeverReading reading = lever.read(i * haptics::period_ns(study.preset.haptics));
    const haptics::JointAngles q = haptics::joint_angles_from_plane(config.yoke, reading.position);
    const haptics::JointTorques torque = haptics::joint_torques_from_plane(config.yoke, q, reading.actuator_force);
    driven.angle = direction.x > 0.0 ? q.theta : -q.phi;
    driven.continuous = (direction.x > 0.0 ? torque.theta : -torque.phi) / config.yoke.radius;
    driven.peak = std::max(driven.peak, driven.continuous);
    lever.write(1e3 * direction);
  }
  return driven;
}

struct DeviceMeasured {
  DrivenAxis select, shift;
  double counts_per_deg = 0.0;
  double bandwidth_x = 0.0, bandwidth_y = 0.0;  // [Hz]
};

DeviceMeasured measure(const Study& study) {
  report_progress(study, "to the stops");
  const AxisIdentification x = identify_axis(study.preset, haptics::LeverAxis::x),
                           y = identify_axis(study.preset, haptics::LeverAxis::y);
  return {drive_to_stop(study, {1.0, 0.0}), drive_to_stop(study, {0.0, 1.0}),
          haptics::device_row(study.device).counts_per_deg, haptics::bandwidth(x.fit.model),
          haptics::bandwidth(y.fit.model)};
}

double both_sides_deg(const DrivenAxis& axis) {
  return 2.0 * axis.angle * 180.0 / std::numbers::pi;
}

Table table_2(const Study& study, const DeviceMeasured& measured) {
  const double step = study.device.position_step;
  return {
      "table_2",
      "Table 2 with a column for the simulated device; a dash marks what only real hardware has.",
      {{"Item", "Developed (printed)", "SideWinder (printed)", "Immersion Engine 2000 (printed)", "Here, measured"},
       {"Range about X", kPrintedRangeX.developed, kPrintedRangeX.sidewinder, kPrintedRangeX.immersion,
        fmt::format("{:.1f} deg (moves the tip along shift)", both_sides_deg(measured.shift))},
       {"Range about Y", kPrintedRangeY.developed, kPrintedRangeY.sidewinder, kPrintedRangeY.immersion,
        fmt::format("{:.1f} deg (moves the tip along select)", both_sides_deg(measured.select))},
       {"Height (L3)", "29 cm", "18 ~ 30 cm", "28 cm", "-"},
       {"Handle (L3-L1)", "16 cm", "13 ~ 20 cm", "18.5 cm", "-"},
       {"Swing (R)", "22 cm", "10 ~ 16 cm", "18 cm",
        fmt::format("{:.1f} cm along select, {:.1f} cm along shift (arcs of the tip)",
                    200.0 * study.preset.lever.yoke.radius * measured.select.angle,
                    200.0 * study.preset.lever.yoke.radius * measured.shift.angle)},
       {"Output torque", kPrintedTorque.developed, kPrintedTorque.sidewinder, kPrintedTorque.immersion,
        fmt::format("{:.2f} N continuous at the tip, {:.1f} N peak", measured.select.continuous, measured.select.peak)},
       {"Precision [counts/deg]", kPrintedPrecision.developed, kPrintedPrecision.sidewinder,
        kPrintedPrecision.immersion, fmt::format("{:.3f}, {:.1f} um at the tip", measured.counts_per_deg, 1e6 * step)},
       {"Bandwidth", kPrintedBandwidth.developed, kPrintedBandwidth.sidewinder, kPrintedBandwidth.immersion,
        fmt::format("{:.2f} Hz in X, {:.2f} Hz in Y (3 dB below the gain at rest)", measured.bandwidth_x,
                    measured.bandwidth_y)},
       {"Interface", "PCI", "USB, game port", "PCI", "-"},
       {"Control", "PC", "µ-processor", "PC", "PC"},
       {"Price", "2000 US", "100 US", "5000 US", "-"}}};
}

void write_table(const Study& study, const Table& table) {
  CsvFile csv(study, table.name, "item,developed_printed,sidewinder_printed,immersion_printed,here_measured");
  for (std::size_t i = 1; i < table.rows.size(); ++i)
    csv.line(fmt::format("\"{}\"", fmt::join(table.rows[i], "\",\"")));
  csv.finish();
}

Finding force_finding(const Study& study, const DeviceMeasured& measured) {
  const double radius = study.preset.lever.yoke.radius;
  return {
      "Table 2: output torque 10.83 Nm",
      fmt::format("{:.2f} N continuous at the tip ({:.2f} N m divided by {:g} m); {:.1f} N peak",
                  measured.select.continuous, measured.select.continuous * radius, radius, measured.select.peak),
      fmt::format("{}, but a force in N, not a torque; a wall of {:g} N/m saturates {:.1f} mm deep, or {:.1f} mm deep "
                  "with the peak force",
                  relative(measured.select.continuous, 10.83), study.admitted.tuning.wall_stiffness,
                  1e3 * measured.select.continuous / study.admitted.tuning.wall_stiffness,
                  1e3 * measured.select.peak / study.admitted.tuning.wall_stiffness)};
}

Finding precision_finding(const Study& study, const DeviceMeasured& measured) {
  const double step = study.device.position_step, encoder = 4.0 * 2500.0 / 360.0;
  return {"Table 2: precision 2250/80 counts/deg",
          fmt::format("{:.3f} counts/deg; one count is {:.1f} um at the tip and {:.2f} N at {:g} N/m",
                      measured.counts_per_deg, 1e6 * step, study.admitted.tuning.wall_stiffness * step,
                      study.admitted.tuning.wall_stiffness),
          fmt::format("{}; section 2.2's encoder of 2500 lines would give {:.2f} counts/deg, {}",
                      relative(measured.counts_per_deg, 2250.0 / 80.0), encoder, relative(encoder, 2250.0 / 80.0))};
}

Finding bandwidth_finding(const DeviceMeasured& measured) {
  return {"Table 2: bandwidth 100 Hz",
          fmt::format("{:.2f} Hz in X, {:.2f} Hz in Y (3 dB below the gain at rest)", measured.bandwidth_x,
                      measured.bandwidth_y),
          "not confirmed (see Fig. 4); 100 Hz may be the bandwidth of drive and motor without the lever"};
}

Finding range_finding(const DeviceMeasured& measured) {
  const double about_x = both_sides_deg(measured.shift), about_y = both_sides_deg(measured.select);
  return {"Table 2: range 70 ~ 80 deg about X, 80 ~ 90 deg about Y",
          fmt::format("driven to the stops: {:.1f} deg and {:.1f} deg", about_x, about_y),
          fmt::format("{} and {} compared with section 2.1's 70 and 80 deg, the lower ends of Table 2's ranges",
                      relative(about_x, 70.0), relative(about_y, 80.0))};
}

}  // namespace

Section table_section(const Study& study) {
  const DeviceMeasured measured = measure(study);
  Table table = table_2(study, measured);
  write_table(study, table);
  return {
      "table",
      "Table 2: comparison with other devices",
      "Range and forces are measured on the preset's lever while each motor is commanded to give more force than it "
      "can produce, "
      "until the lever is at the stop and the motor overheats. The bandwidth follows from the identified m, b and k.",
      {force_finding(study, measured), precision_finding(study, measured), bandwidth_finding(measured),
       range_finding(measured)},
      {},
      std::move(table)};
}

}  // namespace gearshift::lab
