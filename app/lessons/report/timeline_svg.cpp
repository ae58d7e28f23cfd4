#include "app/lessons/report/timeline_svg.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "app/base/chart.h"
#include "app/base/colours.h"
#include "app/lessons/replay/shift_times.h"
#include "app/lessons/report/report_text.h"

namespace gearshift::lessons {
namespace {

// Sizes on the page. [px]
constexpr double kPageWidth = 960.0;
constexpr double kTop = 30.0;  // legend
constexpr double kLabels = 130.0;
constexpr double kNumbers = 96.0;  // space for the bars' durations, right of the axis
constexpr double kBar = 15.0, kBarGap = 4.0;
constexpr double kLine = 17.0;  // height of an error's sentence
constexpr double kShiftGap = 18.0;
constexpr double kAxisHeight = 40.0;

// [s] limit of the axis, so that one long clutch press does not compress all other bars
constexpr double kMaxAxisLength = 8.0;
constexpr const char* kClutchColour = "#8d99a6";
constexpr const char* kUnknownColour = "#e6eaee";

double height_of(const ChosenShift& chosen) {
  return 2.0 * kBar + kBarGap + kLine * static_cast<double>(chosen.errors.size()) + kShiftGap;
}

double axis_length(std::span<const ShownShift> shifts) {
  double longest = 0.5;
  for (const ShownShift& shown : shifts) longest = std::max(longest, shift_times(shown.chosen.shift).end);
  return std::min(kMaxAxisLength, 1.04 * longest);
}

struct Clutch {
  std::vector<ClutchPress> presses;
  bool is_known = true;  // false: several presses at unknown times
};

// Returns the clutch presses in the recording. Without a recording, uses the shift's record, which contains the times
// only if there was a single press.
Clutch clutch_of(const ShownShift& shown, const ShiftTimes& times) {
  if (shown.recorded && !shown.recorded->presses.empty()) return {shown.recorded->presses, true};
  if (times.presses > 1) return {{}, false};
  if (times.clutch_down && times.clutch_up) return {{{*times.clutch_down, *times.clutch_up}}, true};
  return {};
}

// Time from the start of the shift to an error [s]. An early clutch release is reported at the end of the shift, but
// happened earlier.
double moment_of(const DrivingError& error, const ShiftRecord& shift, const ShiftTimes& times) {
  const bool came_up = error.kind == ErrorKind::clutch_early && times.gear_in && shift.clutch_lag < 0.0;
  return came_up ? *times.gear_in + shift.clutch_lag : error.time - shift.begin;
}

class Timeline {
 public:
  Timeline(base::Svg& svg, const base::Rect& box, double seconds)
      : svg_(svg), box_(box), seconds_(seconds), chart_(svg, box, {0.0, seconds}, {0.0, 1.0}) {}

  void axis() {
    chart_.x_grid(base::grid_step(seconds_, 10));
    chart_.x_name("time since the shift began [s]");
  }

  void legend() {
    double x = box_.x;
    const auto entry = [&](const char* colour, std::string_view words, double width) {
      svg_.rect({x, 8.0, 14.0, 10.0}, colour, 2.0);
      svg_.text({x + 20.0, 17.0}, {12.0, base::kInk}, words);
      x += width;
    };
    entry(kClutchColour, "clutch down", 120.0);
    entry(base::kGearColour, "lever moving", 145.0);
    entry(base::kLockoutColour, "lever moving, clutch not down", 245.0);
    svg_.line({x + 7.0, 5.0}, {x + 7.0, 21.0}, {base::kLockoutColour, 1.5});
    svg_.text({x + 20.0, 17.0}, {12.0, base::kInk}, "driving error");
  }

  void shift(const ShownShift& shown, double top) {
    const ChosenShift& chosen = shown.chosen;
    const ShiftTimes times = shift_times(chosen.shift);
    const Clutch pedal = clutch_of(shown, times);
    svg_.text({0.0, top + 13.0}, {15.0, base::kInk, "start", true}, gear_change(chosen.shift));
    svg_.text({0.0, top + 31.0}, {12.0, base::kSoftInk},
              fmt::format("run {}, shift {}", chosen.run, chosen.shift.number + 1));
    clutch(times, pedal, chosen.shift, top);
    lever(times, pedal, chosen.shift, top + kBar + kBarGap);
    errors(chosen, times, top);
  }

 private:
  double x(double time) const { return chart_.at(std::clamp(time, 0.0, seconds_), 0.0).x; }
  void bar(double from, double to, double top, const char* colour) {
    svg_.rect({x(from), top, std::max(1.5, x(to) - x(from)), kBar}, colour, 2.0);
  }
  void number(double top, double seconds, std::string_view label) {
    svg_.text({box_.right() + 8.0, top + 12.0}, {12.0, base::kInk}, fmt::format("{:.2f} s {}", seconds, label));
  }

  void clutch(const ShiftTimes& times, const Clutch& clutch, const ShiftRecord& shift, double top) {
    if (times.presses == 0 && clutch.presses.empty()) {
      svg_.text({x(0.0) + 4.0, top + 12.0}, {12.0, base::kSoftInk}, "clutch not used");
      return;
    }
    for (const ClutchPress& press : clutch.presses) bar(press.from, press.to, top, kClutchColour);
    if (!clutch.is_known) {
      bar(*times.clutch_down, times.end, top, kUnknownColour);
      svg_.text({x(*times.clutch_down) + 4.0, top + 12.0}, {12.0, base::kSoftInk},
                fmt::format("down {} times", times.presses));
    }
    number(top, shift.clutch_time, "clutch");
  }

  void lever(const ShiftTimes& times, const Clutch& clutch, const ShiftRecord& shift, double top) {
    const double left = *times.lever_left, in = times.gear_in.value_or(times.end);
    bar(left, in, top, base::kGearColour);
    if (clutch.is_known) without_clutch(left, in, clutch.presses, top);
    if (times.gear_in) {
      number(top, shift.lever_time, "lever");
    } else {
      svg_.text({box_.right() + 8.0, top + 12.0}, {12.0, base::kInk}, "no gear");
    }
  }

  // Marks the parts of the lever's movement during which the clutch was not pressed.
  void without_clutch(double left, double in, const std::vector<ClutchPress>& presses, double top) {
    double from = left;
    for (const ClutchPress& press : presses) {
      if (std::min(press.from, in) > from) bar(from, std::min(press.from, in), top, base::kLockoutColour);
      from = std::max(from, press.to);
    }
    if (in > from) bar(from, in, top, base::kLockoutColour);
  }

  void errors(const ChosenShift& chosen, const ShiftTimes& times, double top) {
    double line = top + 2.0 * kBar + kBarGap + kLine - 3.0;
    for (const DrivingError& error : chosen.errors) {
      const double at = x(moment_of(error, chosen.shift, times));
      svg_.line({at, top - 3.0}, {at, top + 2.0 * kBar + kBarGap + 3.0}, {base::kLockoutColour, 1.5});
      svg_.text({x(0.0), line}, {12.0, base::kLockoutColour}, error_sentence(error));
      line += kLine;
    }
  }

  base::Svg& svg_;
  base::Rect box_;
  double seconds_;
  base::Chart chart_;
};

}  // namespace

std::string timeline_svg(std::span<const ShownShift> shifts) {
  double height = 0.0;
  for (const ShownShift& shown : shifts) height += height_of(shown.chosen);
  base::Svg svg({0.0, 0.0, kPageWidth, kTop + height + kAxisHeight}, 1.0);
  Timeline timeline(svg, {kLabels, kTop, kPageWidth - kLabels - kNumbers, height}, axis_length(shifts));
  timeline.legend();
  timeline.axis();
  double top = kTop + 0.5 * kShiftGap;
  for (const ShownShift& shown : shifts) {
    timeline.shift(shown, top);
    top += height_of(shown.chosen);
  }
  return std::move(svg).finish();
}

}  // namespace gearshift::lessons
