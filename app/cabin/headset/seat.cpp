#include "app/cabin/headset/seat.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "haptics/files/number_text.h"

namespace gearshift::cabin {
namespace {

constexpr glm::dvec3 kUp{0.0, 1.0, 0.0}, kAhead{0.0, 0.0, -1.0};
constexpr double kMinHorizontal = 0.3;  // [1] smallest horizontal part of a view direction that gives a heading
constexpr double kMinSpread = 0.020;    // [m] minimum RMS distance of the touches from their mean, to fit a rotation

// The heading of the head [rad], positive to the right of the room's -Z. If the user looks straight down or up, the top
// of the head gives the heading: it then points ahead or back.
double heading(const glm::dquat& head) {
  glm::dvec3 look = head * kAhead;
  if (std::hypot(look.x, look.z) < kMinHorizontal) look = (look.y < 0.0 ? 1.0 : -1.0) * (head * kUp);
  return std::atan2(look.x, -look.z);
}

// A pose that rotates by `turn` [rad] about the vertical and maps the point `room` to the point `cabin`.
engine::EyePose placed(double turn, glm::dvec3 room, glm::dvec3 cabin) {
  const glm::dquat orientation = glm::angleAxis(turn, kUp);
  return {cabin - orientation * room, orientation};
}

Eigen::Matrix3d rotation(const glm::dquat& held) {
  return Eigen::Quaterniond(held.w, held.x, held.y, held.z).toRotationMatrix();
}

}  // namespace

void check_knob(const KnobDistance& knob, DriveSide drive) {
  const double away = drive == DriveSide::left ? knob.right : -knob.right;
  if (away > 0.0) return;
  const bool left = drive == DriveSide::left;
  throw std::invalid_argument(
      fmt::format("when the driver sits on the {}, the knob must be on the {}; {} m to the right is on the wrong side",
                  left ? "left" : "right", left ? "right" : "left", haptics::number_text(knob.right)));
}

engine::EyePose seat_at_eyes(const engine::EyePose& head, const SeatPlaces& places, double height) {
  return placed(heading(head.orientation), head.position, places.eye + height * kUp);
}

engine::EyePose seat_at_lever(const engine::EyePose& head, const SeatPlaces& places, const KnobDistance& knob) {
  const double turn = heading(head.orientation);
  const glm::dvec3 away = glm::angleAxis(-turn, kUp) * glm::dvec3(knob.right, -knob.down, -knob.ahead);
  return placed(turn, head.position + away, places.knob);
}

// Computes the fraction as in pivot calibration: an error e of the tip in controller axes is an error R e in the room,
// where R is the controller's orientation. The part of this error that the fit's translation and rotation cannot absorb
// is linear in e. The smallest RMS of that part, over all directions of a unit error e, follows from the smallest
// singular value of the linear map.
double LeverTouches::tip_error_fraction() const {
  if (touches_.size() < 3) return 0.0;
  const double count = static_cast<double>(touches_.size());
  glm::dvec3 middle(0.0);
  Eigen::Matrix3d mean = Eigen::Matrix3d::Zero();
  for (const Touch& touch : touches_) {
    middle += touch.cabin / count;
    mean += rotation(touch.held) / count;
  }
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  Eigen::Vector3d by_turn = Eigen::Vector3d::Zero();
  double turn_squares = 0.0;
  for (const Touch& touch : touches_) {
    const glm::dvec3 along = glm::cross(kUp, touch.cabin - middle);
    const Eigen::Vector3d turn(along.x, along.y, along.z);
    const Eigen::Matrix3d left = rotation(touch.held) - mean;
    squares += left.transpose() * left;
    by_turn += left.transpose() * turn;
    turn_squares += turn.squaredNorm();
  }
  if (turn_squares > 0.0) squares -= by_turn * by_turn.transpose() / turn_squares;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(squares, Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, solver.eigenvalues()[0]) / count);
}

// Least-squares fit of a rotation about y by the angle a, which maps (x, z) to (x cos a + z sin a, z cos a - x sin a).
// The sum of squared distances between rotated room points and cabin points is smallest where the sum of their scalar
// products, along * cos a + across * sin a, is largest: a = atan2(across, along).
std::optional<LeverTouches::Fit> LeverTouches::fit(const engine::EyePose& now) const {
  if (touches_.empty()) return std::nullopt;
  const double count = static_cast<double>(touches_.size());
  glm::dvec3 room(0.0), cabin(0.0);
  for (const Touch& touch : touches_) {
    room += touch.room / count;
    cabin += touch.cabin / count;
  }
  double along = 0.0, across = 0.0, spread = 0.0;
  for (const Touch& touch : touches_) {
    const glm::dvec3 r = touch.room - room, c = touch.cabin - cabin;
    along += c.x * r.x + c.z * r.z;
    across += c.x * r.z - c.z * r.x;
    spread += (c.x * c.x + c.z * c.z) / count;
  }
  Fit fit;
  fit.turned = std::sqrt(spread) >= kMinSpread;
  fit.cabin_from_room = placed(
      fit.turned ? std::atan2(across, along) : 2.0 * std::atan2(now.orientation.y, now.orientation.w), room, cabin);
  for (const Touch& touch : touches_)
    fit.worst = std::max(fit.worst, glm::distance(fit.cabin_from_room * touch.room, touch.cabin));
  return fit;
}

}  // namespace gearshift::cabin
