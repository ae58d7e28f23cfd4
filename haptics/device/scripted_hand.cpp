#include "haptics/device/scripted_hand.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "haptics/device/gaussian_noise.h"
#include "haptics/files/range_check.h"

namespace gearshift::haptics {
namespace {

constexpr double kArrivalTolerance = 0.001;  // [m] at this lag or less, the effort does not grow
constexpr double kRelaxationTime = 0.050;    // [s] time constant of the effort's decay after the lever's arrival

void check(const ScriptedHandConfig& config, double period) {
  require_between("ScriptedHand: start.x", config.start.x, -1.0, 1.0, "m");
  require_between("ScriptedHand: start.y", config.start.y, -1.0, 1.0, "m");
  require_between("ScriptedHand: aim_noise", config.aim_noise, 0.0, 0.1, "m");
  require_between("ScriptedHand: effort_gain", config.effort_gain, 0.0, 1e6, "N/(m s)");
  require_between("ScriptedHand: effort_limit", config.effort_limit, 0.0, 1000.0, "N");
  require_between("ScriptedHand: period", period, 1e-6, 1.0, "s");
}

void check(const HandStroke& stroke, std::size_t index) {
  const std::string name = "ScriptedHand: stroke " + std::to_string(index) + " ";
  require_between(name + "to.x", stroke.to.x, -1.0, 1.0, "m");
  require_between(name + "to.y", stroke.to.y, -1.0, 1.0, "m");
  require_between(name + "duration", stroke.duration, 1e-3, 1e4, "s");
  require_between(name + "dwell", stroke.dwell, 0.0, 1e4, "s");
  require_between(name + "push.x", stroke.push.x, -1000.0, 1000.0, "N");
  require_between(name + "push.y", stroke.push.y, -1000.0, 1000.0, "N");
}

}  // namespace

// The minimum-jerk path between two positions at rest (Flash and Hogan) is
//     a + (b - a)(10 s^3 - 15 s^4 + 6 s^5), with s = t / duration.
HandTarget minimum_jerk(glm::dvec2 a, glm::dvec2 b, double t, double duration) noexcept {
  HandTarget target;
  target.position = b;  // at the end exactly b, without rounding errors
  if (t >= duration) return target;
  const double s = std::max(t / duration, 0.0);
  target.position = a + (b - a) * (s * s * s * (10.0 + s * (-15.0 + s * 6.0)));
  target.velocity = (b - a) * (30.0 * s * s * (1.0 - s) * (1.0 - s) / duration);
  return target;
}

ScriptedHand::ScriptedHand(const ScriptedHandConfig& config, std::vector<HandStroke> strokes, double period)
    : config_(config), period_(period), effort_decay_(std::exp(-period / kRelaxationTime)) {
  check(config, period);
  GaussianNoise noise(config.seed);
  glm::dvec2 from = config.start, push_from{0.0};
  double begin = 0.0;
  segments_.reserve(strokes.size());
  for (HandStroke& stroke : strokes) {
    check(stroke, segments_.size());
    stroke.to.x += config.aim_noise * noise.next();
    stroke.to.y += config.aim_noise * noise.next();
    const double end = begin + stroke.duration + stroke.dwell;
    segments_.push_back({begin, end, from, push_from, stroke});
    from = stroke.to;
    push_from = stroke.push;
    begin = end;
  }
}

double ScriptedHand::duration() const noexcept {
  return segments_.empty() ? 0.0 : segments_.back().end;
}

HandTarget ScriptedHand::next(double time, glm::dvec2 lever) noexcept {
  HandTarget target;
  target.position = config_.start;
  if (!segments_.empty()) {
    const Segment& now = segment_at(time);
    target = minimum_jerk(now.from, now.stroke.to, time - now.begin, now.stroke.duration);
    target.push = minimum_jerk(now.push_from, now.stroke.push, time - now.begin, now.stroke.duration).position;
    target.pressed_down = now.stroke.pressed_down;
    target.lifted = now.stroke.lifted;
  }
  target.push += effort(target.position - lever);
  return target;
}

const ScriptedHand::Segment& ScriptedHand::segment_at(double time) noexcept {
  while (current_ > 0 && time < segments_[current_].begin) --current_;
  while (current_ + 1 < segments_.size() && time >= segments_[current_].end) ++current_;
  return segments_[current_];
}

// Effort that points against the lag decays, while effort in the direction of the lag is added. So the sum may change
// sign.
glm::dvec2 ScriptedHand::effort(glm::dvec2 lag) noexcept {
  for (int axis = 0; axis < 2; ++axis) {
    const bool is_behind = std::abs(lag[axis]) > kArrivalTolerance;
    if (!is_behind || lag[axis] * effort_[axis] < 0.0) effort_[axis] *= effort_decay_;
    if (is_behind) effort_[axis] += config_.effort_gain * lag[axis] * period_;
    effort_[axis] = std::clamp(effort_[axis], -config_.effort_limit, config_.effort_limit);
  }
  return effort_;
}

}  // namespace gearshift::haptics
