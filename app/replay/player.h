// A recorded drive, looked at again: played, stopped, slowed, scrubbed, shift by shift.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <stop_token>
#include <string>

#include "app/replay/recorded_drive.h"

namespace gearshift {

inline constexpr double kSlowest = 0.05, kFastest = 4.0;  // [1] of its own pace
inline constexpr double kShiftMargin = 0.5;               // [s]

class Player {
 public:
  // Stands at the begin, plays. Throws FileError, as RecordedDrive does.
  explicit Player(const std::filesystem::path& file, const std::stop_token& stop = {});

  const RecordedDrive& drive() const noexcept { return drive_; }
  const std::filesystem::path& file() const noexcept { return file_; }

  // Moves on by so much of the person's time; false where it stands: paused, or at the end of what is looked at, where
  // it plays no more. Within a shift it stops at the shift's end.
  bool advance(double seconds);
  void seek(double time);      // [s] on the loop's clock; clamped to what is looked at
  void begin_at(double time);  // [s] of the drive. Throws std::invalid_argument naming how long it is
  void play(bool on);          // at the end: from the begin again
  void set_pace(double pace);  // kSlowest to kFastest; clamped
  // Looks at that shift, from kShiftMargin before it to kShiftMargin after it, and plays it from there. Nothing: at all
  // of it, from where it stands. Throws std::invalid_argument naming the shifts that there are.
  void look_at(std::optional<std::size_t> shift);
  void look_near(double time);  // at the shift that begins nearest to then [s]; none: at all of it

  double time() const noexcept { return time_; }
  double from() const noexcept { return from_; }  // [s] of what is looked at
  double to() const noexcept { return to_; }
  double pace() const noexcept { return pace_; }
  bool plays() const noexcept { return plays_; }
  std::optional<std::size_t> shift() const noexcept { return shift_; }  // that is looked at
  const DriveSample& now() const noexcept { return drive_.at(time_); }
  // Of the last advance(): what plots take. Each sample once, the first time after a jump from now() on.
  std::span<const DriveSample> passed() const noexcept { return passed_; }
  // By seek or look since the last advance(): plots begin anew. To be asked before the next one.
  bool jumped() const noexcept { return jumped_; }

 private:
  void jump_to(double time) noexcept;

  std::filesystem::path file_;
  RecordedDrive drive_;
  double time_ = 0.0, from_ = 0.0, to_ = 0.0;  // [s]
  double pace_ = 1.0;
  bool plays_ = true;
  bool jumped_ = true;
  bool fresh_ = true;  // nothing was passed since the last jump
  std::optional<std::size_t> shift_;
  std::span<const DriveSample> passed_;
};

}  // namespace gearshift
