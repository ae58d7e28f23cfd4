#include "app/input/axis_learner.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/core.h>

#include "haptics/files/printable.h"

namespace gearshift {
namespace {

constexpr double kLeastMove = 0.2;        // [raw, of 2] less is no movement
constexpr double kAlone = 0.5;            // [1] of the widest axis: another one that moves so far was meant as well
constexpr double kMostly = 0.75;          // [1] of what a pedal's axis did lies on one side of its rest
constexpr double kLeastLeverSide = 0.15;  // [1] of what a lever's axis did lies on either side of it
constexpr int kLeastRests = 20;           // frames
constexpr double kRestless = 0.25;        // [1] of the way: such a dead zone is none
constexpr double kLeastZone = 0.02;       // [1]
constexpr double kNoiseMargin = 1.5;      // what a second shows is not the most

// Up to whole hundredths: a number that a person may read and change.
double rounded_up(double share) {
  return std::ceil(100.0 * share - 1e-9) / 100.0;
}

double dead_zone(double wander, double way, const std::string& words) {
  const double zone = std::max(kLeastZone, rounded_up(kNoiseMargin * wander / way));
  if (zone > kRestless)
    throw std::invalid_argument(
        fmt::format("{} does not rest: left alone it was {:.2f} of its way off; do not touch it, and try again", words,
                    wander / way));
  return zone;
}

bool fits_a_file(const std::string& name) {
  return !name.empty() && printable(name) == name;
}

}  // namespace

// The same sticks as at first?
bool AxisLearner::meet(const std::vector<PadState>& sticks) {
  const bool is_new = sticks_.empty();
  if (is_new)
    for (const PadState& stick : sticks)
      sticks_.push_back({stick.name, stick.guid, std::vector<Way>(stick.axes.size())});
  const auto same = [](const Stick& a, const PadState& b) {
    return a.name == b.name && a.guid == b.guid && a.axes.size() == b.axes.size();
  };
  changed_ = changed_ || !std::equal(sticks_.begin(), sticks_.end(), sticks.begin(), sticks.end(), same);
  for (std::size_t s = 0; is_new && s < sticks.size(); ++s)
    for (std::size_t a = 0; a < sticks[s].axes.size(); ++a)
      sticks_[s].axes[a].first = sticks_[s].axes[a].low = sticks_[s].axes[a].high = sticks[s].axes[a];
  return !changed_;
}

void AxisLearner::watch_move(const std::vector<PadState>& sticks) {
  ++frames_;
  if (!meet(sticks)) return;
  for (std::size_t s = 0; s < sticks.size(); ++s) {
    for (std::size_t a = 0; a < sticks[s].axes.size(); ++a) {
      Way& way = sticks_[s].axes[a];
      const double raw = sticks[s].axes[a];
      if (raw < way.low) way.low_at = frames_, way.low = raw;
      if (raw > way.high) way.high_at = frames_, way.high = raw;
    }
  }
}

void AxisLearner::watch_rest(const std::vector<PadState>& sticks) {
  if (!meet(sticks)) return;
  for (std::size_t s = 0; s < sticks.size(); ++s) {
    for (std::size_t a = 0; a < sticks[s].axes.size(); ++a) {
      Way& way = sticks_[s].axes[a];
      const double raw = sticks[s].axes[a];
      if (!std::isfinite(raw)) continue;
      way.rest_low = way.rests == 0 ? raw : std::min(way.rest_low, raw);
      way.rest_high = way.rests == 0 ? raw : std::max(way.rest_high, raw);
      way.rest_sum += raw;
      ++way.rests;
    }
  }
}

std::string AxisLearner::words(const Place& at) const {
  return fmt::format("axis {} of {}", at.axis, printable(sticks_[at.stick].name));
}

AxisLearner::Place AxisLearner::moved_most() const {
  std::vector<Place> places;
  for (std::size_t s = 0; s < sticks_.size(); ++s)
    for (std::size_t a = 0; a < sticks_[s].axes.size(); ++a) places.push_back({s, a});
  if (places.empty()) throw std::invalid_argument("no stick with an axis is plugged in");
  const auto further = [this](const Place& a, const Place& b) { return way_of(a).span() > way_of(b).span(); };
  std::stable_sort(places.begin(), places.end(), further);
  const double most = way_of(places[0]).span();
  if (most < kLeastMove) throw std::invalid_argument("nothing moved: move one control all the way, and let it go");
  if (places.size() > 1 && way_of(places[1]).span() > kAlone * most)
    throw std::invalid_argument(
        fmt::format("two axes moved together, {} and {}: move one control alone", words(places[0]), words(places[1])));
  return places[0];
}

// So that it is found again.
AxisBinding AxisLearner::named(const Place& at) const {
  const Stick& stick = sticks_[at.stick];
  AxisBinding axis;
  axis.stick = fits_a_file(stick.name) ? stick.name : stick.guid;
  axis.axis = static_cast<int>(at.axis);
  for (std::size_t s = 0; s < at.stick; ++s)
    axis.pad += is_meant({sticks_[s].name, {}, {}, sticks_[s].guid}, axis.stick) ? 1 : 0;
  return axis;
}

AxisBinding AxisLearner::pedal(const Place& at) const {
  const Way& way = way_of(at);
  AxisBinding axis = named(at);
  axis.from = way.rest();
  axis.to = way.high - axis.from > axis.from - way.low ? way.high : way.low;
  const double travel = std::abs(axis.to - axis.from);
  if (travel < kLeastMove || travel < kMostly * way.span())
    throw std::invalid_argument(words(at) + " rests in the middle of its way: press the pedal down, and let it go");
  axis.dead_zone = dead_zone(0.5 * (way.rest_high - way.rest_low), travel, words(at));
  axis.end_zone = kLeastZone;
  return axis;
}

// The end that it reached first is the left or the back one.
AxisBinding AxisLearner::lever(const Place& at) const {
  const Way& way = way_of(at);
  AxisBinding axis = named(at);
  const bool low_first = way.low_at <= way.high_at;
  axis.from = low_first ? way.low : way.high;
  axis.to = low_first ? way.high : way.low;
  axis.centre = way.rest();
  const double side = std::min(way.high - way.rest(), way.rest() - way.low);
  if (side < kLeastLeverSide * way.span())
    throw std::invalid_argument(words(at) +
                                " went to one side of its rest only: move the lever to one end, then to the other");
  const double before = std::abs(way.first - way.rest());  // as it was left the last time
  const double slack = before < 0.5 * side ? before : 0.0;
  axis.dead_zone = dead_zone(slack + 0.5 * (way.rest_high - way.rest_low), side, words(at));
  axis.end_zone = kLeastZone;
  return axis;
}

AxisBinding AxisLearner::answer() const {
  if (changed_) throw std::invalid_argument("a stick was plugged in or out meanwhile: try again");
  const Place at = moved_most();
  if (way_of(at).rests < kLeastRests)
    throw std::invalid_argument(words(at) + " was not seen at rest: let it go, and leave it alone for a second");
  return control_ == Control::pedal ? pedal(at) : lever(at);
}

}  // namespace gearshift
