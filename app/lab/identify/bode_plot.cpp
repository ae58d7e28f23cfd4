#include <cmath>
#include <numbers>
#include <string>

#include <fmt/core.h>

#include "app/base/colours.h"
#include "app/lab/identify/identify.h"
#include "app/lab/plot/gnuplot.h"
#include "haptics/files/atomic_file.h"

namespace gearshift::lab {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

const char* end_name(haptics::PointEnd end) {
  switch (end) {
    case haptics::PointEnd::measured:
      return "measured";
    case haptics::PointEnd::never_settled:
      return "never settled";
    case haptics::PointEnd::hit_stop:
      return "hit the stop";
  }
  return "?";
}

void write_points(const std::filesystem::path& file, const AxisIdentification& axis) {
  std::string text =
      "frequency_hz,amplitude_n,bounded_by_stroke,gain_m_per_n,gain_uncertainty_m_per_n,phase_deg,"
      "phase_uncertainty_deg,fitted_gain_m_per_n,fitted_phase_deg,end\n";
  for (const haptics::FrequencyPoint& point : axis.response.points) {
    const auto fitted = haptics::compliance(axis.fit.model, point.frequency);
    const double gain = std::abs(point.response);
    text += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", point.frequency, point.amplitude, point.bounded_by_stroke,
                        gain, gain * point.deviation, std::arg(point.response) / kDegree, point.deviation / kDegree,
                        std::abs(fitted), std::arg(fitted) / kDegree, end_name(point.end));
  }
  haptics::write_text_file(file, text);
}

// gnuplot commands for the layout of Fig. 4 in Lin and Young's paper: gain above, phase below, test points as *, and
// the fitted curve.
std::string bode_commands(const AxisIdentification& axis, std::string_view nominal) {
  const haptics::AxisModel& model = axis.fit.model;
  const double edge = haptics::bandwidth(model);
  return fmt::format(
      R"gp(set datafile separator comma
m = {m}; b = {b}; k = {k}; edge = {edge}
w(f) = 2 * pi * f
gain(f) = -10 * log10((k - m * w(f)**2)**2 + (b * w(f))**2)
phase(f) = -atan2(b * w(f), k - m * w(f)**2) * 180 / pi
m0 = {m0}; b0 = {b0}; k0 = {k0}
gain0(f) = -10 * log10((k0 - m0 * w(f)**2)**2 + (b0 * w(f))**2)
phase0(f) = -atan2(b0 * w(f), k0 - m0 * w(f)**2) * 180 / pi
set logscale x
set xrange [0.1:100]
set samples 500
set grid linetype 1 linecolor "{grid}"
set multiplot layout 2,1 margins 0.09, 0.97, 0.09, 0.91 spacing 0.03
set label "G_{axis}(s) = 1 / ({m:.4f} s^2 + {b:.3f} s + {k:.2f})" at screen 0.09,0.955 left font ",13"
set key at screen 0.97,0.965 right top horizontal
set format x ""
set ylabel "gain [dB re 1 m/N]"
set arrow 1 from edge,graph 0 to edge,graph 1 nohead dashtype 2 linecolor "{soft}"
set arrow 2 from 0.1,gain(edge) to edge,gain(edge) nohead dashtype 2 linecolor "{soft}"
set label 2 sprintf("3 dB below the static gain: %.2f Hz", edge) at edge,graph 0.10 offset 1,0 textcolor "{soft}"
plot gain0(x) with lines linewidth 4 linecolor "{pale}" title "{nominal}", \
  gain(x) with lines linewidth 1.5 linecolor "{blue}" title "fitted", \
  "bode_{axis}.csv" using "frequency_hz":(20 * log10(column("gain_m_per_n"))) with points pointtype 3 pointsize 1.2 \
    linecolor "{red}" title "test points"
unset label
unset arrow 2
unset key
set format x "%g"
set xlabel "frequency [Hz]"
set ylabel "phase [deg]"
set yrange [-190:10]
set ytics 45
plot phase0(x) with lines linewidth 4 linecolor "{pale}", phase(x) with lines linewidth 1.5 linecolor "{blue}", \
  "bode_{axis}.csv" using "frequency_hz":(column("phase_deg") > 10 ? column("phase_deg") - 360 : column("phase_deg")) \
    with points pointtype 3 pointsize 1.2 linecolor "{red}"
unset multiplot
)gp",
      fmt::arg("m", model.mass), fmt::arg("b", model.damping), fmt::arg("k", model.stiffness), fmt::arg("edge", edge),
      fmt::arg("axis", to_string(axis.response.axis)), fmt::arg("grid", base::kAisleShade),
      fmt::arg("soft", base::kSoftInk), fmt::arg("blue", base::kGearColour), fmt::arg("red", base::kLockoutColour),
      fmt::arg("m0", axis.nominal.mass), fmt::arg("b0", axis.nominal.damping), fmt::arg("k0", axis.nominal.stiffness),
      fmt::arg("pale", base::kGridInk), fmt::arg("nominal", nominal));
}

}  // namespace

void draw_bode(const std::filesystem::path& folder, const AxisIdentification& axis, std::string_view nominal,
               const std::function<void()>& waiting) {
  const std::string name = fmt::format("bode_{}", to_string(axis.response.axis));
  write_points(folder / (name + ".csv"), axis);
  draw_figure(folder, {name, 900, 720, bode_commands(axis, nominal)}, waiting);
}

}  // namespace gearshift::lab
