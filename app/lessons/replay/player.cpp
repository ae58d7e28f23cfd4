#include "app/lessons/replay/player.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/core.h>

namespace gearshift::lessons {
namespace {

std::string no_shift_message(std::size_t shift, std::size_t count) {
  const std::string wanted = "the drive has no shift " + std::to_string(shift + 1);
  if (count == 0) return wanted + ", because it contains no shifts";
  return wanted + "; choose one from 1 to " + std::to_string(count);
}

}  // namespace

Player::Player(const std::filesystem::path& file, const std::stop_token& stop)
    : file_(file), drive_(file, stop), time_(drive_.begin()), from_(drive_.begin()), to_(drive_.end()) {}

bool Player::advance(double seconds) {
  has_jumped_ = false;
  passed_ = {};
  if (!is_playing_ || !(seconds > 0.0)) return false;
  const double before = time_;
  time_ = std::min(before + seconds * pace_, to_);
  is_playing_ = time_ < to_;
  passed_ = drive_.between(before, time_);
  if (fresh_) passed_ = {&drive_.at(before), passed_.data() + passed_.size()};
  fresh_ = false;
  return time_ > before;
}

void Player::seek(double time) {
  jump_to(time);
}

void Player::start_at(double time) {
  const double length = drive_.end() - drive_.begin();
  if (!(time >= 0.0 && time <= length))
    throw std::invalid_argument(fmt::format("{:g} s is outside the drive, which lasts {:.3f} s", time, length));
  jump_to(drive_.begin() + time);
}

void Player::play(bool on) {
  if (on && time_ >= to_) jump_to(from_);
  is_playing_ = on;
}

void Player::set_pace(double pace) {
  if (!std::isnan(pace)) pace_ = std::clamp(pace, kMinPace, kMaxPace);
}

void Player::select_shift(std::optional<std::size_t> shift) {
  const std::vector<RecordedShift>& shifts = drive_.shifts();
  if (shift && *shift >= shifts.size()) throw std::invalid_argument(no_shift_message(*shift, shifts.size()));
  shift_ = shift;
  from_ = drive_.begin();
  to_ = drive_.end();
  if (!shift) return jump_to(time_);
  from_ = std::max(from_, shifts[*shift].record.begin - kShiftMargin);
  to_ = std::min(to_, shifts[*shift].record.end + kShiftMargin);
  jump_to(from_);
  is_playing_ = true;
}

void Player::select_nearest_shift(double time) {
  const std::vector<RecordedShift>& shifts = drive_.shifts();
  if (shifts.empty()) return select_shift(std::nullopt);
  const auto away = [&](const RecordedShift& shift) { return std::abs(shift.record.begin - time); };
  const auto nearest = std::min_element(
      shifts.begin(), shifts.end(), [&](const RecordedShift& a, const RecordedShift& b) { return away(a) < away(b); });
  select_shift(static_cast<std::size_t>(nearest - shifts.begin()));
}

void Player::jump_to(double time) noexcept {
  time_ = std::isnan(time) ? from_ : std::clamp(time, from_, to_);
  passed_ = {};
  has_jumped_ = fresh_ = true;
}

}  // namespace gearshift::lessons
