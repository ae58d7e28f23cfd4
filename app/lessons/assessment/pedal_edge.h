// Detects on which side of the bite point a clutch pedal is, with hysteresis.
#pragma once

namespace gearshift::lessons {

// The pedal counts as down when it reaches the bite point, and as up when it has risen kBand above the bite point.
// up_at() is nevertheless the time at which the pedal passed the bite point itself.
class PedalEdge {
 public:
  // [1] hysteresis as a fraction of pedal travel; more than the noise of a potentiometer (engineering value)
  static constexpr double kBand = 0.02;

  explicit PedalEdge(double bite) noexcept : bite_(bite) {}

  // `pedal` [1]: 0 is up, 1 is down. `time` [s].
  void update(double pedal, double time) noexcept {
    const bool was = down_;
    if (pedal >= bite_) {
      if (!down_) down_at_ = time;
      down_ = true;
      below_ = false;
    } else if (down_) {
      if (!below_) up_at_ = time;
      below_ = true;
      if (pedal < bite_ - kBand) down_ = false;
    }
    went_down_ = down_ && !was;
    went_up_ = was && !down_;
  }

  bool is_down() const noexcept { return down_; }
  bool is_past() const noexcept { return down_ && !below_; }  // beyond the bite point now, without hysteresis
  bool went_down() const noexcept { return went_down_; }      // the pedal went down in the last update
  bool went_up() const noexcept { return went_up_; }
  double down_at() const noexcept { return down_at_; }  // [s] when the pedal last passed the bite point downwards
  double up_at() const noexcept { return up_at_; }      // [s] when the pedal last passed the bite point upwards

 private:
  double bite_;
  bool down_ = false, below_ = false, went_down_ = false, went_up_ = false;
  double down_at_ = 0.0, up_at_ = 0.0;
};

}  // namespace gearshift::lessons
