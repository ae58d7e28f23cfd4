// A recorded drive that is being read, on a thread of its own: an hour of it takes many seconds.
#pragma once

#include <filesystem>
#include <future>
#include <thread>

#include "app/replay/player.h"

namespace gearshift {

class OpeningDrive {
 public:
  explicit OpeningDrive(const std::filesystem::path& file);
  ~OpeningDrive() = default;  // stops reading within milliseconds
  OpeningDrive(const OpeningDrive&) = delete;
  OpeningDrive& operator=(const OpeningDrive&) = delete;

  const std::filesystem::path& file() const noexcept { return file_; }
  bool is_over() const;  // read, or refused
  Player take();         // once; waits until it is over. Throws FileError as Player does

 private:
  std::filesystem::path file_;
  std::promise<Player> promise_;
  std::future<Player> player_;
  std::jthread thread_;  // last: it ends before what it writes to
};

}  // namespace gearshift
