// The session's real stick. Only one runtime at a time uses it, and only the user arms it.
#include <stdexcept>
#include <utility>

#include <fmt/core.h>

#include "app/lessons/assessment/lever_path_text.h"
#include "app/session/session.h"
#include "haptics/contact/proxy.h"
#include "haptics/gate/gear_selector.h"

namespace gearshift::session {

// Switches the forces on. If the stick is not connected, refuses, because the stick must not start to push when it is
// plugged in.
bool Session::arm() {
  if (choice_.stick && !choice_.stick->connected()) {
    message_ = fmt::format("{} is not plugged in. Plug it in, then turn forces on.", choice_.stick->name());
    return false;
  }
  runtime_->arm();
  if (choice_.stick) message_.clear();  // the message asked the user to turn forces on
  return true;
}

// Collects the stick's messages. When the stick is disconnected, switches its forces off; they stay off when it is
// reconnected.
void Session::poll_stick() {
  if (!choice_.stick) return;
  std::string news;
  while (const std::optional<std::string> one = choice_.stick->take_message())
    news += (news.empty() ? "" : "; ") + *one;
  if (!news.empty()) message_ = news;
  const bool was_there = std::exchange(is_stick_connected_, choice_.stick->connected());
  if (was_there && !is_stick_connected_) runtime_->stop();
}

// Checks the new configuration while the old runtime still drives the stick. Returns the new gate.
haptics::Gate Session::check_stick(runtime::RuntimeConfig config) const {
  config.lever = [this](double period) { return choice_.stick->detached_lever(period); };
  return runtime::check_runtime(config);
}

// Ends the old runtime before creating the new one, because only one runtime may use the stick. The new configuration
// has already been checked; if the new runtime fails anyway, the old one is recreated.
std::unique_ptr<runtime::Runtime> Session::replace_runtime(const runtime::RuntimeConfig& config) {
  if (!runtime_) return std::make_unique<runtime::Runtime>(config);
  const runtime::RuntimeConfig before = runtime_->config();
  runtime_.reset();
  try {
    return std::make_unique<runtime::Runtime>(config);
  } catch (...) {
    runtime_ = std::make_unique<runtime::Runtime>(before);
    throw;
  }
}

// Throws unless the real stick is in the lesson's starting gear, because only the user can move a real stick.
void Session::check_lever_gear(const lessons::Lesson& lesson, const haptics::Gate& gate) const {
  if (!runtime_) return;
  if (!choice_.stick->connected())
    throw std::runtime_error(
        fmt::format("{} is not plugged in. Plug it in, then start the lesson.", choice_.stick->name()));
  haptics::GearSelector at_once(0.0);
  const int gear = at_once.update(gate, haptics::place_proxy(gate, runtime_->snapshot().lever).position, 0.0);
  if (gear == lesson.start.gear) return;
  throw std::runtime_error(fmt::format("the lesson starts in {0}, but the stick is in {1}. Move it to {0}, then start.",
                                       lessons::gear_word(lesson.start.gear), lessons::gear_word(gear)));
}

}  // namespace gearshift::session
