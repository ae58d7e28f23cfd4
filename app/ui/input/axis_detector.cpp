#include "app/ui/input/axis_detector.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/core.h>

#include "haptics/files/printable.h"

namespace gearshift::ui {
namespace {

constexpr double kMinMove = 0.2;        // [1] smaller changes of the raw value (-1 to 1) count as no movement
constexpr double kMaxSecondAxis = 0.5;  // [1] maximum motion of a second axis, divided by the largest motion
constexpr double kMinPedalSide = 0.75;  // [1] minimum fraction of a pedal's range that lies on one side of rest
constexpr double kMinLeverSide = 0.15;  // [1] minimum fraction of a lever's range that lies on each side of rest
constexpr double kMaxDeadZone = 0.25;   // [1] maximum dead zone, as a fraction of the range; a noisier axis is rejected
constexpr double kMinZone = 0.02;       // [1] minimum dead zone; also used as the end zone
constexpr double kNoiseMargin = 1.5;    // [1] dead zone divided by measured noise; above 1, as noise may grow later

// Rounds up to hundredths, because the user may read and edit the number in the bindings file.
double rounded_up(double fraction) {
  return std::ceil(100.0 * fraction - 1e-9) / 100.0;
}

double dead_zone(double wander, double range, const std::string& axis_name) {
  const double zone = std::max(kMinZone, rounded_up(kNoiseMargin * wander / range));
  if (zone > kMaxDeadZone)
    throw std::invalid_argument(fmt::format(
        "{} moved by {:.2f} of its range when it should have been at rest. Don't touch the control after you "
        "release it.",
        axis_name, wander / range));
  return zone;
}

}  // namespace

// The first call records the sticks. Later calls return false from the first frame in which the sticks differ, even if
// the recorded sticks come back.
bool AxisDetector::check_sticks(const std::vector<engine::Controller>& sticks) {
  const bool is_new = sticks_.empty();
  if (is_new)
    for (const engine::Controller& stick : sticks)
      sticks_.push_back({stick, std::vector<AxisRange>(stick.axes.size())});
  const auto same = [](const Stick& a, const engine::Controller& b) {
    return a.name() == b.name && a.controller.guid == b.guid && a.axes.size() == b.axes.size();
  };
  changed_ = changed_ || !std::equal(sticks_.begin(), sticks_.end(), sticks.begin(), sticks.end(), same);
  for (std::size_t s = 0; is_new && s < sticks.size(); ++s)
    for (std::size_t a = 0; a < sticks[s].axes.size(); ++a) sticks_[s].axes[a].first = sticks[s].axes[a];
  return !changed_;
}

void AxisDetector::record_move(const std::vector<engine::Controller>& sticks) {
  ++frames_;
  if (!check_sticks(sticks)) return;
  for (std::size_t s = 0; s < sticks.size(); ++s) {
    for (std::size_t a = 0; a < sticks[s].axes.size(); ++a) {
      AxisRange& range = sticks_[s].axes[a];
      const double raw = sticks[s].axes[a];
      range.now = raw;
      if (!range.is_reported && raw == range.first) continue;
      // A jump is the first report; a small change is motion from a value that was reported before.
      if (!range.is_reported && std::abs(raw - range.first) > kMinMove) range.first = raw;
      if (!range.is_reported) range.low = range.high = raw;
      range.is_reported = true;
      if (raw < range.low) range.low_at = frames_, range.low = raw;
      if (raw > range.high) range.high_at = frames_, range.high = raw;
    }
  }
}

void AxisDetector::record_rest(const std::vector<engine::Controller>& sticks) {
  if (!check_sticks(sticks)) return;
  for (std::size_t s = 0; s < sticks.size(); ++s) {
    for (std::size_t a = 0; a < sticks[s].axes.size(); ++a) {
      AxisRange& range = sticks_[s].axes[a];
      const double raw = sticks[s].axes[a];
      if (!std::isfinite(raw)) continue;
      range.rest_low = range.rests == 0 ? raw : std::min(range.rest_low, raw);
      range.rest_high = range.rests == 0 ? raw : std::max(range.rest_high, raw);
      range.rest_sum += raw;
      ++range.rests;
    }
  }
}

std::string AxisDetector::name_of(const Place& at) const {
  return haptics::printable(sticks_[at.stick].name());
}

std::string AxisDetector::describe_axis(const Place& at) const {
  return fmt::format("Axis {} of {}", at.axis, name_of(at));
}

// All axes, that with the largest travel first.
std::vector<AxisDetector::Place> AxisDetector::places_by_travel() const {
  std::vector<Place> places;
  for (std::size_t s = 0; s < sticks_.size(); ++s)
    for (std::size_t a = 0; a < sticks_[s].axes.size(); ++a) places.push_back({s, a});
  const auto further = [this](const Place& a, const Place& b) { return range_of(a).span() > range_of(b).span(); };
  std::stable_sort(places.begin(), places.end(), further);
  return places;
}

std::optional<AxisDetector::MovingAxis> AxisDetector::moving() const {
  const std::vector<Place> places = places_by_travel();
  if (places.empty() || range_of(places[0]).span() < kMinMove) return std::nullopt;
  const AxisRange& range = range_of(places[0]);
  return MovingAxis{describe_axis(places[0]), range.first, range.low, range.high, range.now};
}

AxisDetector::Place AxisDetector::axis_with_max_travel() const {
  const std::vector<Place> places = places_by_travel();
  if (places.empty()) throw std::invalid_argument("No stick with an axis is plugged in. Plug one in.");
  const double max_span = range_of(places[0]).span();
  if (max_span < kMinMove) throw std::invalid_argument("Nothing moved. Move one control all the way and release it.");
  if (places.size() > 1 && range_of(places[1]).span() > kMaxSecondAxis * max_span)
    throw std::invalid_argument(fmt::format("Axis {} of {} and axis {} of {} moved together. Move only one control.",
                                            places[0].axis, name_of(places[0]), places[1].axis, name_of(places[1])));
  return places[0];
}

// Returns a binding that finds this stick and axis again.
AxisBinding AxisDetector::binding_of(const Place& at) const {
  const engine::Controller& stick = sticks_[at.stick].controller;
  AxisBinding axis;
  axis.of = ui::name_of(stick);
  axis.axis = static_cast<int>(at.axis);
  for (std::size_t s = 0; s < at.stick; ++s) axis.which += matches_stick(sticks_[s].controller, axis.of.stick) ? 1 : 0;
  return axis;
}

AxisBinding AxisDetector::pedal(const Place& at) const {
  const AxisRange& range = range_of(at);
  AxisBinding axis = binding_of(at);
  axis.from = range.rest();
  axis.to = range.high - axis.from > axis.from - range.low ? range.high : range.low;
  const double travel = std::abs(axis.to - axis.from);
  if (travel < kMinMove || travel < kMinPedalSide * range.span())
    throw std::invalid_argument(
        describe_axis(at) + " rests in the middle of its range. Press the pedal all the way down, then release it.");
  axis.dead_zone = dead_zone(0.5 * (range.rest_high - range.rest_low), travel, describe_axis(at));
  axis.end_zone = kMinZone;
  return axis;
}

// The end that the lever reached first counts as left or back, because the prompt asks for that end first.
AxisBinding AxisDetector::lever(const Place& at) const {
  const AxisRange& range = range_of(at);
  AxisBinding axis = binding_of(at);
  const bool low_first = range.low_at <= range.high_at;
  axis.from = low_first ? range.low : range.high;
  axis.to = low_first ? range.high : range.low;
  axis.centre = range.rest();
  const double side = std::min(range.high - range.rest(), range.rest() - range.low);
  if (side < kMinLeverSide * range.span())
    throw std::invalid_argument(
        describe_axis(at) +
        " moved to only one side of its rest position. Move the lever to one end, then to the other.");
  // Distance between the lever's rest positions before and after it was moved.
  const double before = std::abs(range.first - range.rest());
  const double slack = before < 0.5 * side ? before : 0.0;
  axis.dead_zone = dead_zone(slack + 0.5 * (range.rest_high - range.rest_low), side, describe_axis(at));
  axis.end_zone = kMinZone;
  return axis;
}

AxisBinding AxisDetector::result() const {
  if (changed_) throw std::invalid_argument("A stick was plugged in or unplugged.");
  const Place at = axis_with_max_travel();
  if (range_of(at).rests < kMinRestFrames)
    throw std::invalid_argument(describe_axis(at) +
                                " was not at rest long enough. Release the control and don't touch it for a second.");
  return control_ == Control::pedal ? pedal(at) : lever(at);
}

}  // namespace gearshift::ui
