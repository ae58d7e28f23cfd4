#include "app/draw/gate_svg.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "app/draw/gate_colours.h"
#include "app/draw/gate_outline.h"
#include "app/draw/lockout_words.h"
#include "app/draw/slot_plot.h"
#include "app/draw/svg.h"

namespace gearshift {
namespace {

// Sizes on the page. [mm] of the gate
constexpr double kPixelsPerMillimetre = 7.0;
constexpr double kMargin = 6.0;
constexpr double kTitleHeight = 9.0;
constexpr double kScaleHeight = 6.0;
constexpr double kSideWidth = 70.0;  // plot and legend
constexpr double kSideGap = 11.0;
constexpr double kLegendLine = 5.0;
constexpr const char* kLongDash = "1.6 1.6";

void draw_buffers(Svg& svg, const Gate& gate) {
  for (const Buffer& b : buffers(gate)) {
    const Rect box{mm(std::min(b.wall, b.inner)), -mm(gate.half_aisle), mm(std::abs(b.wall - b.inner)),
                   mm(2.0 * gate.half_aisle)};
    svg.frame(box, "url(#buffer)", {kBufferColour, 0.25});
  }
}

// A junction's name stands in its middle, or just inside its buffer.
struct NamePlace {
  double x = 0.0;  // [mm]
  const char* anchor = "middle";
};

NamePlace name_place(const Gate& gate, int column) {
  constexpr double kGap = 1.2;
  for (const Buffer& b : buffers(gate)) {
    if (nearest_column(gate, b.wall) != column) continue;
    return b.wall < b.inner ? NamePlace{mm(b.inner) + kGap, "start"} : NamePlace{mm(b.inner) - kGap, "end"};
  }
  return {mm(column_of(gate, column).center)};
}

// The neutral junction has a ring: the lever returns there.
void draw_junctions(Svg& svg, const Gate& gate, const GateDescription& list) {
  const double size = std::min(3.4, 0.55 * mm(gate.half_aisle));
  for (std::size_t i = 0; i < list.junctions.size(); ++i) {
    const int column = static_cast<int>(i);
    const NamePlace place = name_place(gate, column);
    if (column == gate.neutral_column) svg.ring({place.x, 0.0}, 0.95 * size, {kGearColour, 0.35});
    svg.text({place.x, 0.35 * size}, {size, kInk, place.anchor}, list.junctions[i].name);
  }
}

// Several lockouts at one place share one bar; the legend says what they are.
void draw_lockouts(Svg& svg, const Gate& gate) {
  const Pen pen{kLockoutColour, 1.2, kLongDash};
  for (const Lockout& lockout : lockouts(gate)) {
    if (lockout.lateral) {
      svg.line(on_page({lockout.barrier, -gate.half_aisle}), on_page({lockout.barrier, gate.half_aisle}), pen);
    } else {
      across_slot(svg, gate, slot_of(gate, lockout.slot), gate.half_aisle + gate.chamfer, pen);
    }
  }
}

class Legend {
 public:
  Legend(Svg& svg, glm::dvec2 at) : svg_(svg), at_(at) {}

  void line(const Pen& pen, std::string_view words) {
    svg_.line(at_ + glm::dvec2(1.5, 0.0), at_ + glm::dvec2(6.5, 0.0), pen);
    entry(words);
  }
  void dot(std::string_view words) {
    svg_.dot(at_ + glm::dvec2(4.0, 0.0), 0.7, kGearColour);
    entry(words);
  }
  void ring(std::string_view words) {
    svg_.ring(at_ + glm::dvec2(4.0, 0.0), 1.6, {kGearColour, 0.35});
    entry(words);
  }
  void buffer(std::string_view words) {
    svg_.frame({at_.x + 1.5, at_.y - 1.5, 5.0, 3.0}, "url(#buffer)", {kBufferColour, 0.25});
    entry(words);
  }

 private:
  void entry(std::string_view words) {
    svg_.text(at_ + glm::dvec2(10.0, 0.9), {2.5, kInk}, words);
    at_.y += kLegendLine;
  }

  Svg& svg_;
  glm::dvec2 at_;
};

// What occurs in this gate, and nothing else.
void draw_legend(Svg& svg, const Gate& gate, glm::dvec2 at) {
  Legend legend(svg, at);
  legend.ring("neutral: the lever returns here");
  legend.line({kGearColour, 0.3}, "the gear counts from here");
  legend.line({kGearColour, 0.3, kShortDash}, "and is released here");
  legend.dot("the engaged lever rests here");
  legend.line({kClosedColour, kStopWidth}, "closed side of a junction");
  if (gate.buffer_count > 0) legend.buffer("buffer: turns the lever into the slots");
  for (const Lockout& lockout : lockouts(gate)) {
    const char* gear = gear_name(slot_of(gate, lockout.slot).gear);
    legend.line({kLockoutColour, 1.2, kLongDash}, fmt::format("lockout of {}: {}", gear, lockout_words(lockout)));
  }
}

double legend_height(const Gate& gate) {
  return kLegendLine * (5 + (gate.buffer_count > 0 ? 1 : 0) + gate.lockout_count);
}

void draw_scale(Svg& svg, glm::dvec2 at) {
  constexpr double kLength = 20.0;
  svg.line(at, at + glm::dvec2(kLength, 0.0), {kInk, 0.4});
  for (const double x : {0.0, 10.0, kLength}) {
    svg.line(at + glm::dvec2(x, -1.0), at + glm::dvec2(x, 1.0), {kInk, 0.4});
  }
  svg.text(at + glm::dvec2(kLength + 2.0, 0.9), {2.6, kInk}, "20 mm");
}

}  // namespace

std::string gate_svg(const Gate& gate, const GateDescription& description, std::string_view title) {
  const Rect plate = gate_plate(gate);
  const Rect plot{plate.right() + kSideGap, plate.y + 6.0, kSideWidth, 40.0};
  const glm::dvec2 legend{plot.x, plot.bottom() + 11.0};
  const double bottom = std::max(plate.bottom() + kScaleHeight, legend.y + legend_height(gate));
  const double top = plate.y - kTitleHeight - kMargin;
  const Rect page{plate.x - kMargin, top, plot.right() - plate.x + 2.0 * kMargin, bottom + kMargin - top};

  Svg svg(page, kPixelsPerMillimetre);
  svg.stripes("buffer", kBufferGround, kBufferColour);
  const double title_size = std::min(5.0, 1.4 * page.width / static_cast<double>(title.size() + 1));
  svg.text({plate.x, plate.y - 4.5}, {title_size, kInk, "start", true}, title);
  draw_gate_ground(svg, gate, description);
  draw_buffers(svg, gate);
  draw_lockouts(svg, gate);
  draw_gate_walls(svg, description);
  draw_gears(svg, gate);
  draw_junctions(svg, gate, description);
  draw_scale(svg, {plate.x, plate.bottom() + kScaleHeight});
  draw_slot_plot(svg, gate, slot_of(gate, 0), plot);
  draw_legend(svg, gate, legend);
  return std::move(svg).finish();
}

}  // namespace gearshift
