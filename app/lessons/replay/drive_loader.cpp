#include "app/lessons/replay/drive_loader.h"

#include <chrono>
#include <exception>
#include <utility>

namespace gearshift::lessons {

DriveLoader::DriveLoader(const std::filesystem::path& file)
    : file_(file), player_(promise_.get_future()), thread_([this](const std::stop_token& stop) {
        try {
          promise_.set_value(Player(file_, stop));
        } catch (...) {
          promise_.set_exception(std::current_exception());
        }
      }) {}

bool DriveLoader::is_over() const {
  return player_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

Player DriveLoader::take() {
  return player_.get();
}

}  // namespace gearshift::lessons
