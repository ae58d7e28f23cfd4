#include "app/lab/gate/slot_plot.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "app/base/colours.h"

namespace gearshift::lab {
namespace {

constexpr double kStep = 0.1e-3;      // [m] step of the plotted curve
constexpr double kForceTick = 4.0;    // [N]
constexpr double kDepthTick = 0.010;  // [m]

class SlotPlot {
 public:
  SlotPlot(base::Svg& svg, const haptics::Gate& gate, const haptics::Slot& slot, const base::Rect& box)
      : svg_(svg), gate_(gate), slot_(slot), box_(box), mouth_(gate.half_aisle + gate.chamfer) {
    double largest = kForceTick;
    for (int i = 0; i <= steps(); ++i) largest = std::max(largest, std::abs(haptics::feel_force(slot.feel, i * kStep)));
    limit_ = std::ceil(1.05 * largest / kForceTick) * kForceTick;
  }

  void zones() {
    svg_.rect(box_, base::kFreeColour);
    svg_.rect(band(0.0, gate_.half_aisle), base::kAisleShade);
    svg_.rect(band(gate_.half_aisle, mouth_), base::kMouthShade);
    const base::Type name{2.1, base::kSoftInk, "middle"};
    svg_.text({x(gate_.half_aisle / 2.0), box_.y + 3.2}, name, "aisle");
    if (gate_.chamfer > 0.0) svg_.text({x((gate_.half_aisle + mouth_) / 2.0), box_.y + 3.2}, name, "mouth");
  }

  void axes() {
    const int force_ticks = static_cast<int>(std::lround(limit_ / kForceTick));
    for (int i = -force_ticks; i <= force_ticks; ++i) {
      const bool zero = i == 0;
      const double force = i * kForceTick;
      svg_.line({box_.x, y(force)}, {box_.right(), y(force)},
                {zero ? base::kSoftInk : base::kGridInk, zero ? 0.3 : 0.15});
      svg_.text({box_.x - 1.2, y(force) + 0.8}, {2.2, base::kSoftInk, "end"}, fmt::format("{:.0f}", force));
    }
    for (int i = 0; i * kDepthTick <= slot_.end + 1e-9; ++i) {
      const double depth = i * kDepthTick;
      svg_.line({x(depth), box_.bottom()}, {x(depth), box_.bottom() + 1.0}, {base::kSoftInk, 0.2});
      svg_.text({x(depth), box_.bottom() + 3.6}, {2.2, base::kSoftInk, "middle"}, fmt::format("{:.0f}", depth * 1e3));
    }
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
    std::vector<glm::dvec2> points;
    for (int i = 0; i <= steps(); ++i) {
      const double depth = std::min(slot_.end, i * kStep);
      points.emplace_back(x(depth), y(haptics::feel_force(slot_.feel, depth)));
    }
    svg_.polyline(points, {base::kInk, 0.6});
    svg_.line({box_.right(), box_.y}, {box_.right(), box_.bottom()}, {base::kInk, 1.1});  // the end stop
    svg_.dot({x(slot_.rest), y(0.0)}, 0.8, base::kGearColour);
  }

 private:
  int steps() const { return static_cast<int>(std::ceil(slot_.end / kStep)); }
  double x(double depth) const { return box_.x + box_.width * depth / slot_.end; }
  double y(double force) const { return box_.y + box_.height * (0.5 - 0.5 * force / limit_); }
  base::Rect band(double from, double to) const { return {x(from), box_.y, x(to) - x(from), box_.height}; }

  base::Svg& svg_;
  const haptics::Gate& gate_;
  const haptics::Slot& slot_;
  base::Rect box_;
  double mouth_;               // [m] depth at which the mouth ends and the straight slot begins
  double limit_ = kForceTick;  // [N] force at the top of the plot
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
