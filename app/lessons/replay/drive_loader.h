// Loads a recorded drive on its own thread, because reading an hour of driving takes many seconds.
#pragma once

#include <filesystem>
#include <future>
#include <thread>

#include "app/lessons/replay/player.h"

namespace gearshift::lessons {

class DriveLoader {
 public:
  explicit DriveLoader(const std::filesystem::path& file);
  ~DriveLoader() = default;  // stops loading within milliseconds
  DriveLoader(const DriveLoader&) = delete;
  DriveLoader& operator=(const DriveLoader&) = delete;

  const std::filesystem::path& file() const noexcept { return file_; }
  bool is_over() const;  // the drive is loaded, or loading has failed
  Player take();         // call once; waits until loading is over. Throws FileError like Player

 private:
  std::filesystem::path file_;
  std::promise<Player> promise_;
  std::future<Player> player_;
  std::jthread thread_;  // declared last, so that the thread ends before the members it uses
};

}  // namespace gearshift::lessons
