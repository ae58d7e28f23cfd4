#include <fstream>

#include <fmt/core.h>

#include "app/plot/gnuplot.h"
#include "app/tour/tour.h"
#include "haptics/files/file_error.h"
#include "haptics/gate/gate_compiler.h"

namespace gearshift {
namespace {

constexpr const char* kWalls = "gate_walls.dat";

void write_walls(const std::filesystem::path& file, const Gate& gate) {
  std::ofstream out(file);
  out << "# x_mm,y_mm; a blank line between walls\n";
  for (const WallInfo& wall : describe_gate(gate).walls) {
    out << fmt::format("{},{}\n{},{}\n\n", 1e3 * wall.from.x, 1e3 * wall.from.y, 1e3 * wall.to.x,
                       1e3 * wall.to.y);
  }
  if (!out.flush()) throw FileError(file.string(), 0, "cannot be written");
}

std::string gear_labels(const Gate& gate) {
  std::string labels;
  for (int i = 0; i < gate.slot_count; ++i) {
    const Slot& slot = gate.slot[static_cast<std::size_t>(i)];
    const glm::dvec2 rest = rest_position(gate, slot.gear);
    labels += fmt::format("set label \"{}\" at {},{} center font \",16\" textcolor \"#1f5fa8\"\n",
                          gear_name(slot.gear), 1e3 * rest.x,
                          1e3 * (rest.y + static_cast<int>(slot.side) * (slot.end - slot.rest + 0.004)));
  }
  return labels;
}

std::string trajectory_commands(const TourSetup& setup) {
  return fmt::format(R"gp(set datafile separator comma
set xlabel "select x [mm]"
set ylabel "shift y [mm]"
set size ratio -1
set offsets 2, 2, 6, 6
set key horizontal center tmargin
set grid linecolor "#e4e8ec"
{}plot "{}" using 1:2 with lines linewidth 5 linecolor "#c9d1d9" title "walls", \
  "tour.csv" using "lever_x_mm":"lever_y_mm" with lines linewidth 1.2 linecolor "#c5303b" title "hand's lever point", \
  "tour.csv" using "proxy_x_mm":"proxy_y_mm" with lines linewidth 1.2 linecolor "#1f5fa8" title "drawn lever (proxy)"
)gp",
                     gear_labels(setup.gate), kWalls);
}

// A dashed line with the gear's name in every panel where it was engaged.
std::string gear_marks(const TourResult& result, bool named) {
  std::string marks = "unset arrow\nunset label\n";
  for (const GearTime& gear : result.engaged) {
    marks += fmt::format(
        "set arrow from {0},graph 0 to {0},graph 1 nohead dashtype 2 linecolor \"#9aa5b1\" back\n",
        gear.time);
    if (named)
      marks += fmt::format("set label \"{}\" at {},graph 1.06 center textcolor \"#1f5fa8\"\n",
                           gear_name(gear.gear), gear.time);
  }
  return marks;
}

std::string force_commands(const TourResult& result) {
  return fmt::format(R"gp(set datafile separator comma
set multiplot layout 3,1 margins 0.08, 0.86, 0.07, 0.95 spacing 0.04
set grid linecolor "#e4e8ec"
set key outside right top Left reverse
set xrange [0:{:.2f}]
set format x ""
{}set ylabel "position [mm]"
plot "tour.csv" using "time_s":"lever_x_mm" with lines linewidth 1.3 linecolor "#c5303b" title "select x", \
  "tour.csv" using "time_s":"lever_y_mm" with lines linewidth 1.3 linecolor "#1f5fa8" title "shift y"
{}set ylabel "hand f_h [N]"
plot "tour.csv" using "time_s":"f_h_x_n" with lines linewidth 1 linecolor "#c5303b" title "select x", \
  "tour.csv" using "time_s":"f_h_y_n" with lines linewidth 1 linecolor "#1f5fa8" title "shift y"
set format x "%g"
set xlabel "time [s]"
set ylabel "commanded [N]"
plot "tour.csv" using "time_s":"commanded_x_n" with lines linewidth 1 linecolor "#c5303b" title "select x", \
  "tour.csv" using "time_s":"commanded_y_n" with lines linewidth 1 linecolor "#1f5fa8" title "shift y"
unset multiplot
)gp",
                     result.duration, gear_marks(result, true), gear_marks(result, false));
}

}  // namespace

void draw_tour(const TourSetup& setup, const TourResult& result) {
  write_walls(setup.folder / kWalls, setup.gate);
  draw_figure(setup.folder, {"trajectory", 900, 820, trajectory_commands(setup)});
  draw_figure(setup.folder, {"force", 1100, 900, force_commands(result)});
}

}  // namespace gearshift
