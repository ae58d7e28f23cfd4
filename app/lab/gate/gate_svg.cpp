#include "app/lab/gate/gate_svg.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "app/base/colours.h"
#include "app/base/svg.h"
#include "app/lab/gate/slot_plot.h"
#include "app/lessons/report/gate_outline.h"
#include "haptics/gate/aisle.h"
#include "haptics/gate/lockout.h"

namespace gearshift::lab {
namespace {

// Sizes on the page, in millimetres of the real gate.
constexpr double kPixelsPerMillimetre = 7.0;
constexpr double kMargin = 6.0;
constexpr double kTitleHeight = 9.0;
constexpr double kScaleHeight = 6.0;
constexpr double kSideWidth = 70.0;  // plot and legend
constexpr double kSideGap = 11.0;
constexpr double kLegendLine = 5.0;
constexpr const char* kLongDash = "1.6 1.6";

void draw_buffers(base::Svg& svg, const haptics::Gate& gate) {
  for (const haptics::Buffer& b : haptics::buffers(gate)) {
    const base::Rect box{lessons::mm(std::min(b.wall, b.inner)), -lessons::mm(gate.half_aisle),
                         lessons::mm(std::abs(b.wall - b.inner)), lessons::mm(2.0 * gate.half_aisle)};
    svg.frame(box, "url(#buffer)", {base::kBufferColour, 0.25});
  }
}

// Position of a junction's name: in the middle of the junction, or beside its buffer.
struct NamePlace {
  double x = 0.0;  // [mm]
  const char* anchor = "middle";
};

NamePlace name_place(const haptics::Gate& gate, int column) {
  constexpr double kGap = 1.2;
  for (const haptics::Buffer& b : haptics::buffers(gate)) {
    if (haptics::nearest_column(gate, b.wall) != column) continue;
    return b.wall < b.inner ? NamePlace{lessons::mm(b.inner) + kGap, "start"}
                            : NamePlace{lessons::mm(b.inner) - kGap, "end"};
  }
  return {lessons::mm(haptics::column_of(gate, column).center)};
}

// A ring marks the neutral junction, to which the lever returns.
void draw_junctions(base::Svg& svg, const haptics::Gate& gate, const haptics::GateDescription& list) {
  const double size = std::min(3.4, 0.55 * lessons::mm(gate.half_aisle));
  for (std::size_t i = 0; i < list.junctions.size(); ++i) {
    const int column = static_cast<int>(i);
    const NamePlace place = name_place(gate, column);
    if (column == gate.neutral_column) svg.ring({place.x, 0.0}, 0.95 * size, {base::kGearColour, 0.35});
    svg.text({place.x, 0.35 * size}, {size, base::kInk, place.anchor}, list.junctions[i].name);
  }
}

// Lockouts at the same place are drawn as one bar. The legend lists each lockout.
void draw_lockouts(base::Svg& svg, const haptics::Gate& gate) {
  const base::Pen pen{base::kLockoutColour, 1.2, kLongDash};
  for (const haptics::Lockout& lockout : haptics::lockouts(gate)) {
    if (haptics::is_mechanism(gate)) {
      const haptics::Slot& place = haptics::slot_of(gate, lockout.slot);
      const double radius = lockout.is_leaving ? haptics::kHeldRadius : haptics::kClosedRadius;
      svg.ring(lessons::on_page(place.at), lessons::mm(radius * place.end), {base::kLockoutColour, 0.6, "1 1"});
    } else if (lockout.lateral) {
      svg.line(lessons::on_page({lockout.barrier, -gate.half_aisle}),
               lessons::on_page({lockout.barrier, gate.half_aisle}), pen);
    } else {
      lessons::across_slot(svg, gate, haptics::slot_of(gate, lockout.slot), gate.half_aisle + gate.chamfer, pen);
    }
  }
}

class Legend {
 public:
  Legend(base::Svg& svg, glm::dvec2 at) : svg_(svg), at_(at) {}

  void line(const base::Pen& pen, std::string_view label) {
    svg_.line(at_ + glm::dvec2(1.5, 0.0), at_ + glm::dvec2(6.5, 0.0), pen);
    entry(label);
  }
  void dot(std::string_view label) {
    svg_.dot(at_ + glm::dvec2(4.0, 0.0), 0.7, base::kGearColour);
    entry(label);
  }
  void ring(std::string_view label) {
    svg_.ring(at_ + glm::dvec2(4.0, 0.0), 1.6, {base::kGearColour, 0.35});
    entry(label);
  }
  void buffer(std::string_view label) {
    svg_.frame({at_.x + 1.5, at_.y - 1.5, 5.0, 3.0}, "url(#buffer)", {base::kBufferColour, 0.25});
    entry(label);
  }

 private:
  void entry(std::string_view label) {
    svg_.text(at_ + glm::dvec2(10.0, 0.9), {2.5, base::kInk}, label);
    at_.y += kLegendLine;
  }

  base::Svg& svg_;
  glm::dvec2 at_;
};

void draw_lockout_legend(Legend& legend, const haptics::Gate& gate) {
  for (const haptics::Lockout& lockout : haptics::lockouts(gate)) {
    const char* gear = haptics::gear_label(gate, haptics::locked_gear(gate, lockout));
    legend.line(
        {base::kLockoutColour, 1.2, kLongDash},
        fmt::format("{} of {}: {}", lockout.is_leaving ? "way out" : "lockout", gear, haptics::describe(lockout)));
  }
}

// Lists only the elements that this gate has.
void draw_legend(base::Svg& svg, const haptics::Gate& gate, glm::dvec2 at) {
  Legend legend(svg, at);
  if (haptics::is_mechanism(gate)) {
    legend.ring("the lever counts as in this place");
    legend.dot("the middle of a place");
    legend.line({base::kClosedColour, lessons::kStopWidth}, "closed side of a junction");
    return draw_lockout_legend(legend, gate);
  }
  legend.ring(feel_force(gate.select_feel, gate.select_max) == 0.0 ? "neutral" : "neutral: the lever returns here");
  legend.line({base::kGearColour, 0.3}, "the gear engages here");
  legend.line({base::kGearColour, 0.3, base::kShortDash}, "the gear releases here");
  legend.dot("the lever rests here in gear");
  legend.line({base::kClosedColour, lessons::kStopWidth}, "closed side of a junction");
  if (gate.buffer_count > 0) legend.buffer("buffer: deflects the lever into the slots");
  draw_lockout_legend(legend, gate);
}

double legend_height(const haptics::Gate& gate) {
  return kLegendLine * (5 + (gate.buffer_count > 0 ? 1 : 0) + gate.lockout_count);
}

void draw_scale(base::Svg& svg, glm::dvec2 at) {
  constexpr double kLength = 20.0;
  svg.line(at, at + glm::dvec2(kLength, 0.0), {base::kInk, 0.4});
  for (const double x : {0.0, 10.0, kLength}) {
    svg.line(at + glm::dvec2(x, -1.0), at + glm::dvec2(x, 1.0), {base::kInk, 0.4});
  }
  svg.text(at + glm::dvec2(kLength + 2.0, 0.9), {2.6, base::kInk}, "20 mm");
}

// The slot whose force is plotted: the first one, in a mechanism the first place with a detent.
const haptics::Slot& plotted_slot(const haptics::Gate& gate) {
  for (const haptics::Slot& slot : haptics::slots(gate))
    if (slot.feel.pieces > 0) return slot;
  return haptics::slot_of(gate, 0);
}

}  // namespace

std::string gate_svg(const haptics::Gate& gate, const haptics::GateDescription& description, std::string_view title) {
  const base::Rect plate = lessons::gate_plate(gate);
  const base::Rect plot{plate.right() + kSideGap, plate.y + 6.0, kSideWidth, 40.0};
  const glm::dvec2 legend{plot.x, plot.bottom() + 11.0};
  const double bottom = std::max(plate.bottom() + kScaleHeight, legend.y + legend_height(gate));
  const double top = plate.y - kTitleHeight - kMargin;
  const base::Rect page{plate.x - kMargin, top, plot.right() - plate.x + 2.0 * kMargin, bottom + kMargin - top};

  base::Svg svg(page, kPixelsPerMillimetre);
  svg.stripes("buffer", base::kBufferGround, base::kBufferColour);
  const double title_size = std::min(5.0, 1.4 * page.width / static_cast<double>(title.size() + 1));
  svg.text({plate.x, plate.y - 4.5}, {title_size, base::kInk, "start", true}, title);
  lessons::draw_gate_ground(svg, gate, description);
  draw_buffers(svg, gate);
  draw_lockouts(svg, gate);
  lessons::draw_gate_walls(svg, description);
  lessons::draw_gears(svg, gate);
  if (!haptics::is_mechanism(gate)) draw_junctions(svg, gate, description);
  draw_scale(svg, {plate.x, plate.bottom() + kScaleHeight});
  draw_slot_plot(svg, gate, plotted_slot(gate), plot);
  draw_legend(svg, gate, legend);
  return std::move(svg).finish();
}

}  // namespace gearshift::lab
