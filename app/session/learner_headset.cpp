#include "app/session/learner_headset.h"

#include <algorithm>
#include <utility>

#include <fmt/core.h>

#include "engine/xr/headset_thread.h"

namespace gearshift::session {
namespace {

// Shortest and longest pause between two searches for a headset.
constexpr std::chrono::seconds kMinPause(2), kMaxPause(60);
constexpr std::chrono::seconds kMaxOpening(10);  // a runtime that has not opened a headset by then is left behind
// The removal of the headset is reported after this delay, because a user who quits also removes the headset and
// needs no report.
constexpr std::chrono::seconds kTakenOffDelay(1);
constexpr std::chrono::seconds kUnseenIsOff(2);  // see LearnerHeadset::is_off()
constexpr double kTip = 0.10;                    // [m] length of the hand's beam while the user touches the knob

engine::HeadsetPanel in_room(const engine::EyePose& cabin_from_room, const cabin::HangingPanel& panel) {
  return {engine::inverse(cabin_from_room) * panel.pose, panel.size, panel.low, panel.high};
}

engine::EyePose middle_eye(const engine::HeadsetEyes& eyes) {
  return {0.5 * (eyes.pose[0].position + eyes.pose[1].position),
          glm::slerp(eyes.pose[0].orientation, eyes.pose[1].orientation, 0.5)};
}

}  // namespace

LearnerHeadset::LearnerHeadset(const HeadsetSetup& setup, engine::Window& window, engine::UiContext& ui)
    : setup_(setup),
      window_(window),
      ui_(ui),
      seating_(setup.seat, setup.seat_file, cabin::camera("driver", setup.seat.drive).position) {
  if (setup.is_new) seating_.save_settings();
}

bool LearnerHeadset::is_found() {
  const auto now = std::chrono::steady_clock::now();
  if (quiet_ && !opening_ && engine::HeadsetThread::wait_for_ended(std::chrono::milliseconds(0))) quiet_.reset();
  if (view_ || (!opening_ && now < next_try_)) return false;
  try {
    if (!opening_) {
      // A runtime in which an earlier headset is still blocked has no room for another one.
      if (!engine::HeadsetThread::wait_for_ended(std::chrono::milliseconds(0))) return false;
      if (!quiet_) quiet_.emplace();
      opening_ = std::make_unique<cabin::OpeningHeadset>(setup_.view);
      began_opening_ = now;
    }
    if (opening_->is_open()) return true;
    if (now - began_opening_ < kMaxOpening) return false;
    stop_opening(
        fmt::format("the OpenXR runtime has not answered for {} s; the desktop shows the cabin", kMaxOpening.count()));
  } catch (const engine::HeadsetAbsent& absent) {
    stop_opening(fmt::format("{}; the desktop shows the cabin until a headset is connected", absent.what()));
    pause_ = kMinPause;
  } catch (const std::exception& error) {  // raised by the headset's runtime or the GPU
    stop_opening(fmt::format("{}; the desktop shows the cabin", error.what()));
  }
  return false;
}

// The pause until the next attempt doubles with each failure.
void LearnerHeadset::stop_opening(const std::string& why) {
  opening_.reset();
  next_try_ = std::chrono::steady_clock::now() + pause_;
  pause_ = std::min(2 * pause_, kMaxPause);
  report_once(why);
}

// Reports the result of a search only if it differs from the previous result, because the search is repeated.
void LearnerHeadset::report_once(const std::string& message) {
  if (message == reported_) return;
  reported_ = message_ = message;
}

bool LearnerHeadset::open() {
  try {
    view_ = std::make_unique<cabin::HeadsetView>(std::move(opening_), window_, ui_);
  } catch (const std::exception& error) {  // raised by the headset's runtime or the GPU
    lose(error.what());
    return false;
  }
  quiet_.reset();
  message_ = fmt::format("{} connected through {}", view_->headset().headset, view_->headset().runtime);
  return true;
}

// Calls `work`. An error from the headset or its GPU closes the view instead of ending the trainer.
template <class Work>
void LearnerHeadset::guarded(const Work& work) {
  try {
    work();
  } catch (const engine::HeadsetError& error) {
    lose(error.what());
  } catch (const engine::GpuError& error) {
    lose(error.what());
  }
}

bool LearnerHeadset::set_model(const engine::Model& model) {
  bool is_set = false;
  guarded([&] { is_set = view_->set_model(model); });
  return is_set;
}

// Closes the view after an error.
void LearnerHeadset::lose(const std::string& why) {
  if (!quiet_) quiet_.emplace();
  view_.reset();
  opening_.reset();
  pointer_.reset();
  beam_.reset();
  was_worn_ = false;
  taken_off_at_.reset();
  unseen_since_.reset();
  seating_.on_headset_lost();
  next_try_ = std::chrono::steady_clock::now() + pause_;
  pause_ = std::min(2 * pause_, kMaxPause);  // doubled, because each attempt interrupts the desktop's picture
  report_once(fmt::format("{}; the desktop shows the cabin. The lever keeps running.", why));
}

bool LearnerHeadset::begin(const cabin::Stage& stage) {
  bool worn = false;
  guarded([&] {
    worn = view_->begin();
    wants_exit_ = wants_exit_ || view_->state() == engine::HeadsetState::exiting;
    if (std::string message = view_->take_message(); !message.empty())
      message_ = "the window does not mirror the headset: " + message;
    follow_wearing();
    pointer_.reset();
    beam_.reset();
    if (!view_->has_begun()) return;
    while (const std::optional<engine::SpaceChange> change = view_->take_due_space_change())
      seating_.follow(*change, view_->is_room_persistent());
    if (view_->is_shown() && was_worn_) {
      pause_ = kMinPause;
      reported_.clear();
      update_seat(stage);
    }
    follow_hands(stage);
  });
  return worn && view_ != nullptr;
}

// Some runtimes keep the session when the headset is taken off, but show nothing of it; so does another program that is
// shown for a moment, so this counts only after a while.
bool LearnerHeadset::is_off() const {
  if (view_->is_present()) return !*view_->is_present();
  if (view_->state() >= engine::HeadsetState::visible || !unseen_since_) return false;
  return std::chrono::steady_clock::now() - *unseen_since_ >= kUnseenIsOff;
}

void LearnerHeadset::follow_wearing() {
  const auto now = std::chrono::steady_clock::now();
  const bool is_seen =
      view_->state() == engine::HeadsetState::visible || view_->state() == engine::HeadsetState::focused;
  if (is_seen || !was_worn_) unseen_since_.reset();
  if (!is_seen && was_worn_ && !unseen_since_) unseen_since_ = now;
  if (was_worn_ && is_off()) {
    was_worn_ = false;
    seating_.on_headset_removed();
    taken_off_at_ = unseen_since_.value_or(now);
  }
  was_worn_ = was_worn_ || (is_seen && !is_off());
  report_taken_off();
}

void LearnerHeadset::report_taken_off() {
  if (was_worn_ || wants_exit_) taken_off_at_.reset();
  if (!taken_off_at_ || std::chrono::steady_clock::now() - *taken_off_at_ < kTakenOffDelay) return;
  taken_off_at_.reset();
  message_ = "the headset was taken off, so the desktop shows the cabin";
}

// Some headsets never report a position, some only after a while. While no position is known, the head is placed at the
// driver's eye point. The seat is recentred whenever the position becomes known or unknown. A touch calibration needs a
// known head position.
void LearnerHeadset::update_seat(const cabin::Stage& stage) {
  const engine::HeadsetEyes& eyes = view_->eyes();
  if (std::exchange(placed_, eyes.is_known) != eyes.is_known) seating_.recentre();
  const bool is_tracked = eyes.is_known ? eyes.is_tracked : eyes.is_oriented;
  if (is_tracked)
    seating_.seat_if_needed(middle_eye(eyes), stage.knob_at_rest(), eyes.is_known && view_->is_room_persistent());
}

void LearnerHeadset::draw(const engine::FrameScene& scene, const cabin::VisibleRegion& visible,
                          const cabin::VisibleRegion& card, const engine::EyePose& desk) {
  const cabin::DriveSide side = setup_.seat.drive;
  const engine::EyePose driver = cabin::camera("driver", side);
  const glm::dvec2 size = setup_.view.panel;
  panel_ = panel_open_ ? cabin::hang_panel(driver.position, side, size)
                       : cabin::hang_card(driver.position, side, size, card.low, card.high);
  const engine::HeadsetPanel panel = in_room(seating_.cabin_from_room(), panel_);
  const engine::EyePose& seat = view_->is_shown() ? seating_.cabin_from_room() : desk;
  guarded([&] { view_->draw(scene, seat, &panel, visible); });
}

// Reads both hands; the first one that points at the panel controls it.
void LearnerHeadset::follow_hands(const cabin::Stage& stage) {
  const std::array<engine::HeadsetHand, 2>& hands = view_->hands();
  for (std::size_t i = 0; i < hands.size(); ++i) {
    const engine::HeadsetHand& hand = hands[i];
    const bool selected = std::exchange(selected_[i], hand.selects), had_menu = std::exchange(menu_[i], hand.menu);
    const bool pressed = hand.selects && !selected;
    if (hand.menu && !had_menu) toggle_panel();
    if (!hand.is_tracked) continue;
    const engine::EyePose aim = seating_.cabin_from_room() * hand.aim;
    const glm::dvec3 along = aim.orientation * glm::dvec3(0.0, 0.0, -1.0);
    if (pointer_) continue;
    if (const std::optional<cabin::PanelHit> hit = cabin::point_at(panel_, aim)) {
      pointer_ = Pointer{*hit, hand.selects, hand.scroll};
      beam_ = cabin::Beam{aim.position, aim.position + hit->distance * along};
    } else if (seating_.is_touching()) {
      beam_ = cabin::Beam{aim.position, aim.position + kTip * along};
      if (pressed && hand.is_position_tracked) seating_.touch(hand.aim, stage.knob_top());
    }
  }
}

void LearnerHeadset::apply(const ui::HeadsetCommand& command, double bound) {
  struct Handlers {
    LearnerHeadset& headset;
    double bound;
    void operator()(const ui::RecentreSeat&) const { headset.recentre(); }
    void operator()(const ui::StartTouching&) const {
      headset.panel_open_ = true;  // because the panel shows the instructions
      headset.seating_.start_touching();
    }
    void operator()(const ui::SaveTouches&) const {
      headset.seating_.save_touches(bound, headset.view_->is_room_persistent());
    }
    void operator()(const ui::ForgetTouches&) const { headset.seating_.forget_touches(); }
    void operator()(const ui::SetSeatHeight& asked) const { headset.seating_.set_height(asked.height); }
    void operator()(const ui::SetKnob& asked) const { headset.seating_.set_knob(asked.knob); }
    void operator()(const ui::ForgetKnob&) const { headset.seating_.set_knob(std::nullopt); }
  };
  std::visit(Handlers{*this, bound}, command);
}

engine::EyePose LearnerHeadset::head() const {
  return seating_.cabin_from_room() * middle_eye(view_->eyes());
}

double LearnerHeadset::touch_error() const noexcept {
  return view_ ? seating_.touch_error() : 0.0;
}

std::string LearnerHeadset::take_message() {
  if (message_.empty()) return seating_.take_message();
  return std::exchange(message_, {});
}

cabin::HeadsetReport LearnerHeadset::report() const {
  cabin::HeadsetReport report;
  report.headset = view_->headset().headset;
  report.runtime = view_->headset().runtime;
  report.state = engine::to_string(view_->state());
  report.eye = view_->eye_size();
  report.timing = view_->timing();
  report.is_tracked = view_->eyes().is_tracked;
  report.orientation_only = view_->eyes().is_oriented && !view_->eyes().is_known;
  const auto& hands = view_->hands();
  report.has_controller = view_->state() != engine::HeadsetState::focused || hands[0].is_active || hands[1].is_active;
  seating_.report(report);
  return report;
}

}  // namespace gearshift::session
