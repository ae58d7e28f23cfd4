#include "app/lab/gate/slot_plot.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "app/base/chart.h"
#include "app/base/colours.h"

namespace gearshift::lab {
namespace {

constexpr double kStep = 0.1e-3;     // [m] step of the plotted curve
constexpr double kForceTick = 4.0;   // [N]
constexpr double kDepthTick = 10.0;  // [mm]

// Force [N] against depth [mm].
std::vector<glm::dvec2> force_curve(const haptics::Slot& slot) {
  std::vector<glm::dvec2> points;
  for (double depth = 0.0; depth < slot.end + kStep; depth += kStep) {
    const double inside = std::min(slot.end, depth);
    points.emplace_back(1e3 * inside, haptics::feel_force(slot.feel, inside));
  }
  return points;
}

class SlotPlot {
 public:
  SlotPlot(base::Svg& svg, const haptics::Gate& gate, const haptics::Slot& slot, const base::Rect& box)
      : svg_(svg),
        gate_(gate),
        slot_(slot),
        box_(box),
        mouth_(gate.half_aisle + gate.chamfer),
        curve_(force_curve(slot)),
        chart_(svg, box, {0.0, 1e3 * slot.end}, {-limit(), limit()}, 2.2) {}

  void zones() {
    svg_.rect(box_, base::kFreeColour);
    svg_.rect(band(0.0, gate_.half_aisle), base::kAisleShade);
    svg_.rect(band(gate_.half_aisle, mouth_), base::kMouthShade);
    if (haptics::is_mechanism(gate_)) return;
    const base::Type name{2.1, base::kSoftInk, "middle"};
    svg_.text({x(gate_.half_aisle / 2.0), box_.y + 3.2}, name, "aisle");
    if (gate_.chamfer > 0.0) svg_.text({x((gate_.half_aisle + mouth_) / 2.0), box_.y + 3.2}, name, "mouth");
  }

  void axes() {
    chart_.x_grid(kDepthTick);
    chart_.y_grid(kForceTick);
    // The curve does not cross the first label: in every layout, it runs below this label up to its crest.
    svg_.text({x(mouth_) + 1.2, y(0.0) - 1.4}, {2.1, base::kSoftInk}, "pulls into gear");
    svg_.text({x(mouth_) + 1.2, box_.bottom() - 1.6}, {2.1, base::kSoftInk}, "pushes back");
  }

  void stations() {
    const auto mark = [&](double depth, const char* dash) {
      svg_.line({x(depth), box_.y + 1.0}, {x(depth), box_.bottom() - 1.0}, {base::kGearColour, 0.25, dash});
    };
    mark(slot_.engage_depth, "none");
    mark(slot_.release_depth, base::kShortDash);
  }

  void curve() {
    chart_.curve(curve_, {base::kInk, 0.6});
    svg_.line({box_.right(), box_.y}, {box_.right(), box_.bottom()}, {base::kInk, 1.1});  // the end stop
    svg_.dot({x(slot_.rest), y(0.0)}, 0.8, base::kGearColour);
  }

 private:
  double limit() const {
    double largest = kForceTick;
    for (const glm::dvec2 point : curve_) largest = std::max(largest, std::abs(point.y));
    return std::ceil(1.05 * largest / kForceTick) * kForceTick;
  }
  double x(double depth) const { return chart_.at(1e3 * depth, 0.0).x; }
  double y(double force) const { return chart_.at(0.0, force).y; }
  base::Rect band(double from, double to) const { return {x(from), box_.y, x(to) - x(from), box_.height}; }

  base::Svg& svg_;
  const haptics::Gate& gate_;
  const haptics::Slot& slot_;
  base::Rect box_;
  double mouth_;                   // [m] depth at which the mouth ends and the straight slot begins
  std::vector<glm::dvec2> curve_;  // [mm, N]
  base::Chart chart_;
};

}  // namespace

void draw_slot_plot(base::Svg& svg, const haptics::Gate& gate, const haptics::Slot& slot, const base::Rect& box) {
  svg.text({box.x, box.y - 3.0}, {2.9, base::kInk, "start", true}, "Force along a slot [N] against depth [mm]");
  SlotPlot plot(svg, gate, slot, box);
  plot.zones();
  plot.axes();
  plot.stations();
  plot.curve();
}

}  // namespace gearshift::lab
