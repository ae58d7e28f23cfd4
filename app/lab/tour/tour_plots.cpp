#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "app/base/colours.h"
#include "app/lab/plot/gnuplot.h"
#include "app/lab/tour/tour.h"
#include "haptics/files/atomic_file.h"
#include "haptics/gate/gate_description.h"

namespace gearshift::lab {
namespace {

constexpr const char* kWalls = "gate_walls.dat";
constexpr const char* kTable = "tour.csv";
// The lever and the select axis are red; the displayed lever (proxy) and the shift axis are blue.
constexpr const char* kRed = base::kLockoutColour;
constexpr const char* kBlue = base::kGearColour;

void write_walls(const std::filesystem::path& file, const haptics::Gate& gate) {
  std::string text = "# x_mm,y_mm; a blank line between walls\n";
  for (const haptics::WallInfo& wall : haptics::describe_gate(gate).walls) {
    text += fmt::format("{},{}\n{},{}\n\n", 1e3 * wall.from.x, 1e3 * wall.from.y, 1e3 * wall.to.x, 1e3 * wall.to.y);
  }
  haptics::write_text_file(file, text);
}

std::string gear_labels(const haptics::Gate& gate) {
  std::string labels;
  for (int i = 0; i < gate.slot_count; ++i) {
    const haptics::Slot& slot = gate.slot[static_cast<std::size_t>(i)];
    const glm::dvec2 rest = haptics::rest_position(gate, slot.gear);
    labels += fmt::format(
        "set label \"{}\" at {},{} center font \",16\" textcolor \"{}\"\n", haptics::gear_label(gate, slot.gear),
        1e3 * rest.x, 1e3 * (rest.y + static_cast<int>(slot.side) * (slot.end - slot.rest + 0.004)), base::kGearColour);
  }
  return labels;
}

// Formats a gnuplot data source for two columns of tour.csv. The program `cut` extracts the columns, because gnuplot
// would otherwise waste time converting all cells of the file.
class Curves {
 public:
  explicit Curves(const std::filesystem::path& folder) {
    std::ifstream in(folder / kTable);
    std::string line, name;
    std::getline(in, line);
    for (std::istringstream header(line); std::getline(header, name, ',');) names_.push_back(name);
  }

  std::string operator()(std::string_view x, std::string_view y) const {
    return fmt::format(R"("< cut -d, -f{},{} {}" using "{}":"{}" with lines)", column(x), column(y), kTable, x, y);
  }

 private:
  std::ptrdiff_t column(std::string_view name) const {
    return std::find(names_.begin(), names_.end(), name) - names_.begin() + 1;
  }

  std::vector<std::string> names_;
};

std::string trajectory_commands(const TourSetup& setup, const Curves& curve) {
  return fmt::format(
      R"gp(set datafile separator comma
set xlabel "select x [mm]"
set ylabel "shift y [mm]"
set size ratio -1
set offsets 2, 2, 6, 6
set key horizontal center tmargin
set grid linecolor "{grid}"
{labels}plot "{walls}" using 1:2 with lines linewidth 5 linecolor "{wall}" title "walls", \
  {hand} linewidth 1.2 linecolor "{red}" title "real lever", \
  {drawn} linewidth 1.2 linecolor "{blue}" title "displayed lever (proxy)"
)gp",
      fmt::arg("grid", base::kAisleShade), fmt::arg("labels", gear_labels(setup.gate)), fmt::arg("walls", kWalls),
      fmt::arg("wall", base::kGridInk), fmt::arg("red", kRed), fmt::arg("blue", kBlue),
      fmt::arg("hand", curve("lever_x_mm", "lever_y_mm")), fmt::arg("drawn", curve("proxy_x_mm", "proxy_y_mm")));
}

// Draws a dashed line at each time at which a gear engaged. `has_labels`: also draws the gear's name above the line.
std::string gear_marks(const haptics::Gate& gate, const TourResult& result, bool has_labels) {
  std::string marks = "unset arrow\nunset label\n";
  for (const GearTime& gear : result.engaged) {
    marks += fmt::format("set arrow from {0},graph 0 to {0},graph 1 nohead dashtype 2 linecolor \"{1}\" back\n",
                         gear.time, base::kSoftInk);
    if (has_labels)
      marks += fmt::format("set label \"{}\" at {},graph 1.06 center textcolor \"{}\"\n",
                           haptics::gear_label(gate, gear.gear), gear.time, base::kGearColour);
  }
  return marks;
}

// A panel of force.png that plots both axes of a quantity over time. The invisible points give the panel a height,
// because gnuplot prints a warning if all values are 0.
std::string panel(const Curves& curve, const char* label, const char* x, const char* y, double width) {
  return fmt::format(R"gp(set ylabel "{}"
plot sample [-1:1] "+" using (0):1 with points pointsize 0 notitle, \
  {} linewidth {} linecolor "{}" title "select x", \
  {} linewidth {} linecolor "{}" title "shift y"
)gp",
                     label, curve("time_s", x), width, kRed, curve("time_s", y), width, kBlue);
}

std::string force_commands(const haptics::Gate& gate, const TourResult& result, const Curves& curve) {
  return fmt::format(R"gp(set datafile separator comma
set multiplot layout 3,1 margins 0.08, 0.86, 0.07, 0.95 spacing 0.04
set grid linecolor "{}"
set key outside right top Left reverse
set xrange [0:{:.2f}]
set format x ""
{}{}{}{}set format x "%g"
set xlabel "time [s]"
{}unset multiplot
)gp",
                     base::kAisleShade, result.duration, gear_marks(gate, result, true),
                     panel(curve, "position [mm]", "lever_x_mm", "lever_y_mm", 1.3), gear_marks(gate, result, false),
                     panel(curve, "hand f_h [N]", "f_h_x_n", "f_h_y_n", 1.0),
                     panel(curve, "commanded [N]", "commanded_x_n", "commanded_y_n", 1.0));
}

}  // namespace

void draw_tour(const TourSetup& setup, const TourResult& result, const TourProgress& progress) {
  write_walls(setup.folder / kWalls, setup.gate);
  const Curves curve(setup.folder);
  draw_figure(setup.folder, {"trajectory", 900, 820, trajectory_commands(setup, curve)},
              [&] { progress("figures", 0.0); });
  draw_figure(setup.folder, {"force", 1100, 900, force_commands(setup.gate, result, curve)},
              [&] { progress("figures", 0.5); });
}

}  // namespace gearshift::lab
