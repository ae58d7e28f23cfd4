// Plays a recorded drive: play, pause, slow motion, seek, single shifts.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <stop_token>
#include <string>

#include "app/lessons/replay/recorded_drive.h"

namespace gearshift::lessons {

inline constexpr double kMinPace = 0.05, kMaxPace = 4.0;  // [1] speed of playback relative to real time
inline constexpr double kShiftMargin = 0.5;               // [s]

class Player {
 public:
  // Starts playing at the beginning. Throws FileError like RecordedDrive.
  explicit Player(const std::filesystem::path& file, const std::stop_token& stop = {});

  const RecordedDrive& drive() const noexcept { return drive_; }
  const std::filesystem::path& file() const noexcept { return file_; }

  // Advances by `seconds` of real time. Returns false if the position did not change: playback is paused, or is at the
  // end of the selection.
  bool advance(double seconds);
  void seek(double time);      // [s] on the haptic loop's clock; clamped to the selection
  void start_at(double time);  // [s] since the drive began; throws std::invalid_argument after the drive's end
  void play(bool on);          // if playback is at the end of the selection, restarts the selection
  void set_pace(double pace);  // kMinPace to kMaxPace; clamped
  // Selects and plays a shift, from kShiftMargin before the shift to kShiftMargin after it. If `shift` is empty,
  // selects the whole drive and keeps the position. For an unknown shift, throws std::invalid_argument with a message
  // that lists the valid shifts.
  void select_shift(std::optional<std::size_t> shift);
  // Selects the shift that begins nearest to `time` [s]; if there are no shifts, the whole drive.
  void select_nearest_shift(double time);

  double time() const noexcept { return time_; }
  double from() const noexcept { return from_; }  // [s] start of the selection
  double to() const noexcept { return to_; }
  double pace() const noexcept { return pace_; }
  bool is_playing() const noexcept { return is_playing_; }
  std::optional<std::size_t> shift() const noexcept { return shift_; }  // selected shift; empty: the whole drive
  const vehicle::DriveSample& now() const noexcept { return drive_.at(time_); }
  // Samples over which the last advance() moved, for plots. Successive calls of advance() give each sample once. After
  // a jump, the sample at the new position is included.
  std::span<const vehicle::DriveSample> passed() const noexcept { return passed_; }
  // True if a seek or a selection has changed the position since the last advance(). Plots must then start again. Call
  // before the next advance().
  bool has_jumped() const noexcept { return has_jumped_; }

 private:
  void jump_to(double time) noexcept;

  std::filesystem::path file_;
  RecordedDrive drive_;
  double time_ = 0.0, from_ = 0.0, to_ = 0.0;  // [s]
  double pace_ = 1.0;
  bool is_playing_ = true;
  bool has_jumped_ = true;
  bool fresh_ = true;  // no sample was passed since the last jump
  std::optional<std::size_t> shift_;
  std::span<const vehicle::DriveSample> passed_;
};

}  // namespace gearshift::lessons
