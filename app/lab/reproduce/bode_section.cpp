#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "app/base/colours.h"
#include "app/lab/identify/identify.h"
#include "app/lab/reproduce/section.h"
#include "app/lab/reproduce/study_files.h"

namespace gearshift::lab {
namespace {

double decibels(double gain) {
  return 20.0 * std::log10(gain);
}
AxisIdentification identify(const Study& study, haptics::LeverAxis axis) {
  return identify_axis(study.preset, axis, [&](double) { report_progress(study, "frequency sweep"); });
}

void draw_with_paper(const Study& study, AxisIdentification axis, const haptics::AxisModel& paper,
                     std::string_view paper_label) {
  axis.nominal = paper;
  draw_bode(study.folder, axis, paper_label, [&] { report_progress(study, "frequency sweep"); });
}

double third_of_peak(const Study& study) {
  return study.preset.lever.actuator.peak_force * haptics::SweepConfig{}.force_fraction;
}
double stop_on_x_arc(const Study& study) {
  return study.preset.lever.yoke.radius * study.preset.lever.yoke.theta_limit;
}

// Plots the lever's motion with our force amplitude and with the paper's amplitude, one third of the peak force. With
// the paper's amplitude the lever hits its stop, so that curve is computed from the fitted model.
void draw_amplitudes(const Study& study, const AxisIdentification& x, const haptics::FrequencyResponse& literal) {
  const double third = third_of_peak(study);
  CsvFile csv(study, "bode_amplitude", "frequency_hz,used_n,used_mm,third_n,third_mm,third_hit_the_stop_1");
  for (std::size_t i = 0; i < std::min(x.response.points.size(), literal.points.size()); ++i) {
    const haptics::FrequencyPoint& point = x.response.points[i];
    const double gain = std::abs(haptics::compliance(x.fit.model, point.frequency));
    csv.row({point.frequency, point.amplitude, 1e3 * point.amplitude * gain, third, 1e3 * third * gain,
             literal.points[i].end == haptics::PointEnd::hit_stop ? 1.0 : 0.0});
  }
  csv.finish();
  draw(study, {"bode_amplitude", 1100, 460,
               fmt::format(R"gp(set multiplot layout 1,2 margins 0.07, 0.98, 0.13, 0.84 spacing 0.09
set logscale xy
set xlabel "frequency [Hz]"
set key horizontal center tmargin maxrows 2
set ylabel "amplitude of the force [N]"
set yrange [0.5:50]
plot "bode_amplitude.csv" using "frequency_hz":"third_n" \
    with lines dashtype 3 linewidth 1.4 linecolor "{red}" title "the paper: one third of the peak force", \
  "bode_amplitude.csv" using "frequency_hz":"used_n" \
    with linespoints pointtype 7 pointsize 0.5 linewidth 1.4 linecolor "{blue}" title "used here"
set ylabel "amplitude of the motion [mm]"
set yrange [0.1:2000]
plot "bode_amplitude.csv" using "frequency_hz":"third_mm" \
    with lines dashtype 3 linewidth 1.4 linecolor "{red}" title "with one third of the peak force", \
  "bode_amplitude.csv" using "frequency_hz":($6 == 1 ? $5 : NaN) \
    with points pointtype 2 linecolor "{red}" title "hits the stop", \
  "bode_amplitude.csv" using "frequency_hz":"used_mm" \
    with linespoints pointtype 7 pointsize 0.5 linewidth 1.4 linecolor "{blue}" title "used here", \
  {stop} with lines linewidth 1.4 linecolor "{ink}" title "the stop"
unset multiplot
)gp",
                           fmt::arg("red", base::kLockoutColour), fmt::arg("blue", base::kGearColour),
                           fmt::arg("ink", base::kInk), fmt::arg("stop", 1e3 * stop_on_x_arc(study)))});
}

Finding model_finding(const char* paper_text, const haptics::AxisFit& fit, const haptics::AxisModel& paper) {
  const haptics::AxisModel &m = fit.model, &d = fit.deviation;
  return {paper_text,
          fmt::format("m {:.4g} kg ± {:.1g} %, b {:.4g} N s/m ± {:.1g} %, k {:.4g} N/m ± {:.1g} %", m.mass,
                      100.0 * d.mass / m.mass, m.damping, 100.0 * d.damping / m.damping, m.stiffness,
                      100.0 * d.stiffness / m.stiffness),
          fmt::format("m {}, b {}, k {}", relative(m.mass, paper.mass), relative(m.damping, paper.damping),
                      relative(m.stiffness, paper.stiffness))};
}

std::string describe_bandwidth(const haptics::AxisModel& axis) {
  if (haptics::bandwidth(axis) == 0.0) return "none, because the axis has no spring";
  return fmt::format("{:.2f} Hz (at 100 Hz, {:.0f} dB below)", haptics::bandwidth(axis),
                     decibels(std::abs(haptics::compliance(axis, 0.0) / haptics::compliance(axis, 100.0))));
}

Finding bandwidth_finding(const haptics::AxisModel& x, const haptics::AxisModel& y) {
  return {
      "Section 2.4: the output is at 3 dB at about 100 Hz, the bandwidth",
      fmt::format("frequency at which the gain is 3 dB below the gain at rest: X {}; Y {}", describe_bandwidth(x),
                  describe_bandwidth(y)),
      fmt::format("100 Hz does not follow from (11) and (12), whose bandwidths are {:.2f} and {:.2f} Hz, because both "
                  "axes are over-damped (damping ratios {:.2f} and {:.2f}), so the claim cannot be verified",
                  haptics::bandwidth(haptics::kPaperAxisX), haptics::bandwidth(haptics::kPaperAxisY),
                  haptics::damping_ratio(haptics::kPaperAxisX), haptics::damping_ratio(haptics::kPaperAxisY))};
}

Finding amplitude_finding(const Study& study, const AxisIdentification& x, const haptics::FrequencyResponse& literal) {
  const auto hits =
      std::count_if(literal.points.begin(), literal.points.end(),
                    [](const haptics::FrequencyPoint& point) { return point.end == haptics::PointEnd::hit_stop; });
  double highest = 0.0;
  for (const haptics::FrequencyPoint& point : literal.points) {
    if (point.end == haptics::PointEnd::hit_stop) highest = std::max(highest, point.frequency);
  }
  const double third = third_of_peak(study);
  return {
      "Section 2.4: the amplitude is one third of the maximum output torque",
      fmt::format("{:.1f} N drives the X axis to its stop at {} of {} test points, up to {:.1f} Hz; at 1 Hz the "
                  "lever would need {:.0f} mm, but the stop is at {:.0f} mm of arc",
                  third, hits, literal.points.size(), highest,
                  1e3 * third * std::abs(haptics::compliance(x.fit.model, 1.0)), 1e3 * stop_on_x_arc(study)),
      "impossible at low frequencies, so the amplitude is one third of the maximum or 60 % of the stroke, whichever "
      "is smaller"};
}

// Describes the gain in encoder counts per newton; 0 dB is one count per newton.
std::string describe_counts(const haptics::AxisModel& x, double step, double moved) {
  if (step == 0.0) return "cannot be compared, because the preset's lever has no encoder";
  const auto crossing = [&](double level) {
    return haptics::frequency_at_gain(x, step * std::pow(10.0, level / 20.0));
  };
  return fmt::format(
      "{:.0f} encoder counts. In counts per newton, the gain is +3, 0 and -3 dB at {:.0f}, {:.0f} and {:.0f} Hz. The "
      "paper does not say what its 3 dB refer to; they may refer to the encoder's resolution",
      moved / step, crossing(3.0), crossing(0.0), crossing(-3.0));
}

Finding end_finding(const Study& study, const haptics::AxisModel& x) {
  const double gain = std::abs(haptics::compliance(x, haptics::SweepConfig{}.highest));
  const double moved = third_of_peak(study) * gain, rest = std::abs(haptics::compliance(x, 0.0));
  return {"Section 2.4: the output reached 3 dB at about 65 Hz",
          fmt::format("at 65 Hz, the gain of X is {:.1f} dB below its gain at rest; one third of the peak force moves "
                      "the lever by {:.2f} mm",
                      decibels(rest / gain), 1e3 * moved),
          describe_counts(x, study.device.position_step, moved)};
}

}  // namespace

Section bode_section(const Study& study) {
  const AxisIdentification x = identify(study, haptics::LeverAxis::x), y = identify(study, haptics::LeverAxis::y);
  haptics::SweepConfig paper_amplitude = preset_sweep(study.preset);
  paper_amplitude.literal = true;
  const haptics::FrequencyResponse literal = sweep_lever(study.preset, haptics::LeverAxis::x, paper_amplitude);
  draw_with_paper(study, x, haptics::kPaperAxisX, "the paper's (11)");
  draw_with_paper(study, y, haptics::kPaperAxisY, "the paper's (12)");
  draw_amplitudes(study, x, literal);
  return {"bode",
          "Fig. 4: identification of both axes",
          fmt::format(
              "The preset's lever, without a hand, is driven along one axis at a time by {} sinusoids from {:.1f} to "
              "{:.0f} Hz, sampled at {:g} Hz through its encoder. Gain and phase are fitted by least squares over "
              "whole periods, and m, b and k of (8) by weighted least squares over all points.",
              x.response.points.size(), x.response.points.back().frequency, x.response.points.front().frequency,
              study.preset.haptics.rate),
          {bandwidth_finding(x.fit.model, y.fit.model),
           model_finding("(11): 0.095 s^2 + 3.0 s + 14.8", x.fit, haptics::kPaperAxisX),
           model_finding("(12): 0.086 s^2 + 2.9 s + 15.7", y.fit, haptics::kPaperAxisY),
           amplitude_finding(study, x, literal), end_finding(study, x.fit.model)},
          {{"bode_x", "Fig. 4 (a): the X axis. Test points (*), the fitted curve, and the paper's curve behind it."},
           {"bode_y", "Fig. 4 (b): the Y axis."},
           {"bode_amplitude",
            "Force and resulting motion of the X axis, which show why the sweep uses less than one third of the "
            "maximum force at low frequencies."}}};
}

}  // namespace gearshift::lab
