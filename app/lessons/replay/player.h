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
  // Starts at the beginning, playing. Throws FileError like RecordedDrive.
  explicit Player(const std::filesystem::path& file, const std::stop_token& stop = {});

  const RecordedDrive& drive() const noexcept { return drive_; }
  const std::filesystem::path& file() const noexcept { return file_; }

  // Advances by `seconds` of real time. Returns false if the position did not change, because playback is paused or at
  // the end of the selection, where it stops.
  bool advance(double seconds);
  void seek(double time);      // [s] on the loop's clock; clamped to the selection
  void start_at(double time);  // [s] since the drive began. Throws std::invalid_argument if it is too late
  void play(bool on);          // at the end of the selection, plays it again from its begin
  void set_pace(double pace);  // kMinPace to kMaxPace; clamped
  // Selects a shift, with kShiftMargin before and after it, and plays it from its start. Empty: selects the whole drive
  // without moving. Throws std::invalid_argument that names the valid shifts.
  void select_shift(std::optional<std::size_t> shift);
  // Selects the shift that begins nearest to `time` [s]; if there are no shifts, the whole drive.
  void select_nearest_shift(double time);

  double time() const noexcept { return time_; }
  double from() const noexcept { return from_; }  // [s] begin of the selection
  double to() const noexcept { return to_; }
  double pace() const noexcept { return pace_; }
  bool is_playing() const noexcept { return is_playing_; }
  std::optional<std::size_t> shift() const noexcept { return shift_; }  // selected shift; empty: the whole drive
  const vehicle::DriveSample& now() const noexcept { return drive_.at(time_); }
  // Samples passed in the last advance(), for plots. Each sample is returned once; after a jump, the sample at the
  // jump's target is included.
  std::span<const vehicle::DriveSample> passed() const noexcept { return passed_; }
  // True if a seek or a selection has changed the position since the last advance(), so that plots start again. Call
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
