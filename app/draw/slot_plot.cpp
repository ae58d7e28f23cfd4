#include "app/draw/slot_plot.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "app/draw/gate_colours.h"

namespace gearshift {
namespace {

constexpr double kStep = 0.1e-3;      // [m] of the drawn curve
constexpr double kForceTick = 4.0;    // [N]
constexpr double kDepthTick = 0.010;  // [m]

class SlotPlot {
 public:
  SlotPlot(Svg& svg, const Gate& gate, const Slot& slot, const Rect& box)
      : svg_(svg), gate_(gate), slot_(slot), box_(box), mouth_(gate.half_aisle + gate.chamfer) {
    double largest = kForceTick;
    for (int i = 0; i <= steps(); ++i) largest = std::max(largest, std::abs(feel_force(slot.feel, i * kStep)));
    limit_ = std::ceil(1.05 * largest / kForceTick) * kForceTick;
  }

  void zones() {
    svg_.rect(box_, kFreeColour);
    svg_.rect(band(0.0, gate_.half_aisle), kAisleShade);
    svg_.rect(band(gate_.half_aisle, mouth_), kMouthShade);
    const Type name{2.1, kSoftInk, "middle"};
    svg_.text({x(gate_.half_aisle / 2.0), box_.y + 3.2}, name, "aisle");
    if (gate_.chamfer > 0.0) svg_.text({x((gate_.half_aisle + mouth_) / 2.0), box_.y + 3.2}, name, "mouth");
  }

  void axes() {
    const int force_ticks = static_cast<int>(std::lround(limit_ / kForceTick));
    for (int i = -force_ticks; i <= force_ticks; ++i) {
      const bool zero = i == 0;
      const double force = i * kForceTick;
      svg_.line({box_.x, y(force)}, {box_.right(), y(force)}, {zero ? kSoftInk : kGridInk, zero ? 0.3 : 0.15});
      svg_.text({box_.x - 1.2, y(force) + 0.8}, {2.2, kSoftInk, "end"}, fmt::format("{:.0f}", force));
    }
    for (int i = 0; i * kDepthTick <= slot_.end + 1e-9; ++i) {
      const double depth = i * kDepthTick;
      svg_.line({x(depth), box_.bottom()}, {x(depth), box_.bottom() + 1.0}, {kSoftInk, 0.2});
      svg_.text({x(depth), box_.bottom() + 3.6}, {2.2, kSoftInk, "middle"}, fmt::format("{:.0f}", depth * 1e3));
    }
    // Before the crest the upper half is empty, whatever the layout: the words find room there.
    svg_.text({x(mouth_) + 1.2, y(0.0) - 1.4}, {2.1, kSoftInk}, "pulls into gear");
    svg_.text({x(mouth_) + 1.2, box_.bottom() - 1.6}, {2.1, kSoftInk}, "pushes back");
  }

  void stations() {
    const auto mark = [&](double depth, const char* dash) {
      svg_.line({x(depth), box_.y + 1.0}, {x(depth), box_.bottom() - 1.0}, {kGearColour, 0.25, dash});
    };
    mark(slot_.engage_depth, "none");
    mark(slot_.release_depth, kShortDash);
  }

  void curve() {
    std::vector<glm::dvec2> points;
    for (int i = 0; i <= steps(); ++i) {
      const double depth = std::min(slot_.end, i * kStep);
      points.emplace_back(x(depth), y(feel_force(slot_.feel, depth)));
    }
    svg_.polyline(points, {kInk, 0.6});
    svg_.line({box_.right(), box_.y}, {box_.right(), box_.bottom()}, {kInk, 1.1});  // the end stop
    svg_.dot({x(slot_.rest), y(0.0)}, 0.8, kGearColour);
  }

 private:
  int steps() const { return static_cast<int>(std::ceil(slot_.end / kStep)); }
  double x(double depth) const { return box_.x + box_.width * depth / slot_.end; }
  double y(double force) const { return box_.y + box_.height * (0.5 - 0.5 * force / limit_); }
  Rect band(double from, double to) const { return {x(from), box_.y, x(to) - x(from), box_.height}; }

  Svg& svg_;
  const Gate& gate_;
  const Slot& slot_;
  Rect box_;
  double mouth_;               // [m] depth where the slot proper begins
  double limit_ = kForceTick;  // [N] at the top of the plot
};

}  // namespace

void draw_slot_plot(Svg& svg, const Gate& gate, const Slot& slot, const Rect& box) {
  svg.text({box.x, box.y - 3.0}, {2.9, kInk, "start", true}, "Force along a slot [N] over depth [mm]");
  SlotPlot plot(svg, gate, slot, box);
  plot.zones();
  plot.axes();
  plot.stations();
  plot.curve();
}

}  // namespace gearshift
