// Shows a recorded drive instead of the live lever.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "app/lessons/replay/drive_loader.h"
#include "app/lessons/replay/player.h"

namespace gearshift::session {

class ReplayViewer {
 public:
  // Starts to read the recording in the background. `near` [s]: the shift that begins nearest to this time will be
  // shown; empty: the whole drive.
  void open(const std::filesystem::path& recording, std::optional<double> near);
  bool is_opening() const { return opening_ != nullptr; }
  bool is_opened() const { return opening_ && opening_->is_over(); }  // take() does not wait
  std::string_view opening_name() const { return opening_ ? std::string_view(opening_name_) : std::string_view(); }
  // The opened recording; waits until it is read. Throws FileError, std::invalid_argument or std::runtime_error with a
  // one-sentence message.
  lessons::Player take();
  void cancel() { opening_.reset(); }

  void show(lessons::Player player) { player_ = std::move(player); }
  void close() { player_.reset(); }
  lessons::Player* player() { return player_ ? &*player_ : nullptr; }  // null: no replay
  const lessons::Player* player() const { return player_ ? &*player_ : nullptr; }
  const lessons::RecordedShift* shift() const;  // the shift that is shown; null: the whole drive, or no replay

 private:
  std::unique_ptr<lessons::DriveLoader> opening_;  // not null while a recording is being read
  std::string opening_name_;                       // of its file
  std::optional<double> near_;                     // [s] see open()
  std::optional<lessons::Player> player_;          // not empty during a replay
};

}  // namespace gearshift::session
