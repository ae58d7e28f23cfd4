#include "app/session/replay_viewer.h"

#include <utility>

namespace gearshift::session {

void ReplayViewer::open(const std::filesystem::path& recording, std::optional<double> near) {
  opening_ = std::make_unique<lessons::DriveLoader>(recording);
  opening_name_ = recording.filename().string();
  near_ = near;
}

lessons::Player ReplayViewer::take() {
  const std::unique_ptr<lessons::DriveLoader> opened = std::exchange(opening_, nullptr);
  lessons::Player player = opened->take();
  if (near_) player.select_nearest_shift(*near_);
  return player;
}

const lessons::RecordedShift* ReplayViewer::shift() const {
  return player_ && player_->shift() ? &player_->drive().shifts()[*player_->shift()] : nullptr;
}

}  // namespace gearshift::session
