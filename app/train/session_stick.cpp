// A session's stick: a lever that a person holds, which has one trainer at a time and which nobody else arms.
#include <stdexcept>
#include <utility>

#include <fmt/core.h>

#include "app/train/session.h"
#include "haptics/contact/proxy.h"
#include "haptics/gate/gear_selector.h"

namespace gearshift {

// A stick that is not there would push by itself when it comes.
bool Session::arm() {
  if (choice_.stick && !choice_.stick->connected()) {
    message_ = fmt::format("{} is not plugged in: plug it in first, then arm it", choice_.stick->name());
    return false;
  }
  trainer_->arm();
  if (choice_.stick) message_.clear();  // that asked for it
  return true;
}

// One that is gone has no forces, and none when it comes back.
void Session::follow_stick() {
  if (!choice_.stick) return;
  std::string news;
  while (const std::optional<std::string> one = choice_.stick->take_news()) news += (news.empty() ? "" : "; ") + *one;
  if (!news.empty()) message_ = news;
  const bool was_there = std::exchange(stick_is_there_, choice_.stick->connected());
  if (was_there && !stick_is_there_) trainer_->stop();
}

// While the old trainer drives it. Returns the new one's gate.
Gate Session::check_stick(TrainerConfig config) const {
  config.lever = [this](double period) { return choice_.stick->stand_in(period); };
  return check_trainer(config);
}

// The old trainer ends first. What could be refused has been: where the new one cannot be all the same, the old one is
// made anew.
std::unique_ptr<Trainer> Session::hand_over(const TrainerConfig& config) {
  if (!trainer_) return std::make_unique<Trainer>(config);
  const TrainerConfig before = trainer_->config();
  trainer_.reset();
  try {
    return std::make_unique<Trainer>(config);
  } catch (...) {
    trainer_ = std::make_unique<Trainer>(before);
    throw;
  }
}

// A simulated lever is put where the lesson begins; a person puts the stick there.
void Session::check_gear_of(const Lesson& lesson, const Gate& gate) const {
  if (!trainer_) return;
  if (!choice_.stick->connected())
    throw std::runtime_error(fmt::format("{} is not plugged in: plug it in, then begin", choice_.stick->name()));
  GearSelector at_once(0.0);
  const int gear = at_once.update(gate, place_proxy(gate, trainer_->snapshot().lever).position, 0.0);
  if (gear == lesson.start.gear) return;
  throw std::runtime_error(fmt::format("the lesson begins in {} and the stick stands in {}: move it there, then begin",
                                       gear_name(lesson.start.gear), gear_name(gear)));
}

}  // namespace gearshift
