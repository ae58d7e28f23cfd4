#include "app/report/timeline_svg.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "app/draw/gate_colours.h"
#include "app/replay/shift_times.h"
#include "app/report/chart.h"
#include "app/report/words.h"

namespace gearshift {
namespace {

// Sizes on the page. [px]
constexpr double kWidth = 960.0;
constexpr double kTop = 30.0;  // legend
constexpr double kLabels = 130.0;
constexpr double kNumbers = 96.0;  // of the bars' lengths, to the right of the axis
constexpr double kBar = 15.0, kBarGap = 4.0;
constexpr double kLine = 17.0;  // of a fault's sentence
constexpr double kShiftGap = 18.0;
constexpr double kAxis = 40.0;

constexpr double kLongest = 8.0;  // [s] of the axis: who waits with the clutch down shall not squeeze the others
constexpr const char* kClutchColour = "#8d99a6";

double height_of(const ChosenShift& chosen) {
  return 2.0 * kBar + kBarGap + kLine * static_cast<double>(chosen.faults.size()) + kShiftGap;
}

double axis_length(std::span<const ChosenShift> shifts) {
  double longest = 0.5;
  for (const ChosenShift& chosen : shifts) longest = std::max(longest, shift_times(chosen.shift).end);
  return std::min(kLongest, 1.04 * longest);
}

class Timeline {
 public:
  Timeline(Svg& svg, const Rect& box, double seconds)
      : svg_(svg), box_(box), seconds_(seconds), chart_(svg, box, {0.0, seconds}, {0.0, 1.0}) {}

  void axis() {
    chart_.x_grid(grid_step(seconds_, 10));
    chart_.x_name("s since the shift began");
  }

  void legend() {
    double x = box_.x;
    const auto entry = [&](const char* colour, std::string_view words, double width) {
      svg_.rect({x, 8.0, 14.0, 10.0}, colour, 2.0);
      svg_.text({x + 20.0, 17.0}, {12.0, kInk}, words);
      x += width;
    };
    entry(kClutchColour, "clutch down", 120.0);
    entry(kGearColour, "lever under way", 145.0);
    entry(kLockoutColour, "lever under way, clutch not down", 245.0);
  }

  void shift(const ChosenShift& chosen, double top) {
    const ShiftTimes times = shift_times(chosen.shift);
    svg_.text({0.0, top + 13.0}, {15.0, kInk, "start", true}, gear_change(chosen.shift));
    svg_.text({0.0, top + 31.0}, {12.0, kSoftInk},
              fmt::format("run {}, shift {}", chosen.run, chosen.shift.number + 1));
    clutch(times, chosen.shift, top);
    lever(times, chosen.shift, top + kBar + kBarGap);
    faults(chosen, top);
  }

 private:
  double x(double time) const { return chart_.at(std::clamp(time, 0.0, seconds_), 0.0).x; }
  void bar(double from, double to, double top, const char* colour) {
    svg_.rect({x(from), top, std::max(1.5, x(to) - x(from)), kBar}, colour, 2.0);
  }
  void number(double top, double seconds, std::string_view what) {
    svg_.text({box_.right() + 8.0, top + 12.0}, {12.0, kInk}, fmt::format("{:.2f} s {}", seconds, what));
  }

  void clutch(const ShiftTimes& times, const ShiftRecord& shift, double top) {
    if (!times.clutch_down) {
      svg_.text({x(0.0) + 4.0, top + 12.0}, {12.0, kSoftInk}, "clutch not used");
      return;
    }
    bar(*times.clutch_down, *times.clutch_up, top, kClutchColour);
    number(top, shift.clutch_time, "clutch");
  }

  void lever(const ShiftTimes& times, const ShiftRecord& shift, double top) {
    const double left = *times.lever_left, in = times.gear_in.value_or(times.end);
    bar(left, in, top, kGearColour);
    const double down = times.clutch_down.value_or(in), up = times.clutch_up.value_or(in);
    if (down > left) bar(left, std::min(down, in), top, kLockoutColour);
    if (up < in) bar(std::max(up, left), in, top, kLockoutColour);
    if (times.gear_in) {
      number(top, shift.lever_time, "lever");
    } else {
      svg_.text({box_.right() + 8.0, top + 12.0}, {12.0, kInk}, "no gear");
    }
  }

  void faults(const ChosenShift& chosen, double top) {
    double line = top + 2.0 * kBar + kBarGap + kLine - 3.0;
    for (const DriveFault& fault : chosen.faults) {
      const double at = x(fault.time - chosen.shift.begin);
      svg_.line({at, top - 3.0}, {at, top + 2.0 * kBar + kBarGap + 3.0}, {kLockoutColour, 1.5});
      svg_.text({x(0.0), line}, {12.0, kLockoutColour}, fault_sentence(fault));
      line += kLine;
    }
  }

  Svg& svg_;
  Rect box_;
  double seconds_;
  Chart chart_;
};

}  // namespace

std::string timeline_svg(std::span<const ChosenShift> shifts) {
  double height = 0.0;
  for (const ChosenShift& chosen : shifts) height += height_of(chosen);
  Svg svg({0.0, 0.0, kWidth, kTop + height + kAxis}, 1.0);
  Timeline timeline(svg, {kLabels, kTop, kWidth - kLabels - kNumbers, height}, axis_length(shifts));
  timeline.legend();
  timeline.axis();
  double top = kTop + 0.5 * kShiftGap;
  for (const ChosenShift& chosen : shifts) {
    timeline.shift(chosen, top);
    top += height_of(chosen);
  }
  return std::move(svg).finish();
}

}  // namespace gearshift
