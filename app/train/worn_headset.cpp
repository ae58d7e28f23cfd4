#include "app/train/worn_headset.h"

#include <algorithm>
#include <utility>

#include <fmt/core.h>

#include "haptics/files/file_error.h"

namespace gearshift {
namespace {

constexpr auto kPause = std::chrono::seconds(2);  // between two looks for a headset
constexpr double kTip = 0.10;                     // [m] of the ray of a hand that touches: where it begins is the tip

HeadsetPanel in_room(const EyePose& cabin_from_room, const HangingPanel& panel) {
  return {inverse(cabin_from_room) * panel.pose, panel.size, panel.low, panel.high};
}

EyePose between(const HeadsetEyes& eyes) {
  return {0.5 * (eyes.pose[0].position + eyes.pose[1].position),
          glm::slerp(eyes.pose[0].orientation, eyes.pose[1].orientation, 0.5)};
}

}  // namespace

WornHeadset::WornHeadset(const HeadsetSetup& setup, Window& window, UiContext& ui)
    : setup_(setup), window_(window), ui_(ui), cabin_from_room_(camera("driver", setup.seat.drive)) {
  if (setup.is_new) keep();
}

bool WornHeadset::is_found() {
  const auto now = std::chrono::steady_clock::now();
  if (view_ || !tries_ || now < next_try_) return false;
  next_try_ = now + kPause;
  try {
    found_ = std::make_unique<HeadsetRuntime>();
    return true;
  } catch (const HeadsetAbsent& absent) {
    tell_once(fmt::format("{}; the desktop shows the cabin until one is", absent.what()));
  } catch (const HeadsetError& error) {
    tries_ = was_open_;  // what was never there does not come by itself
    tell_once(fmt::format("{}; the desktop shows the cabin", error.what()));
  }
  return false;
}

// What is found every 2 s is no news.
void WornHeadset::tell_once(const std::string& news) {
  if (news == told_) return;
  told_ = news_ = news;
}

bool WornHeadset::open() {
  try {
    view_ = std::make_unique<HeadsetView>(setup_.view, std::move(found_), window_, ui_);
  } catch (const std::exception& error) {  // of the runtime or of the GPU
    lose(error.what());
    tries_ = was_open_;  // what never could be shown is not tried again
    return false;
  }
  was_open_ = true;
  told_.clear();
  sits_ = false;
  news_ = fmt::format("{} at {}", view_->headset().headset, view_->headset().runtime);
  return true;
}

void WornHeadset::set_model(const Model& model) {
  if (view_) view_->set_model(model);
}

void WornHeadset::lose(const std::string& why) {
  view_.reset();
  found_.reset();
  pointer_.reset();
  beam_.reset();
  next_try_ = std::chrono::steady_clock::now() + kPause;
  tell_once(fmt::format("{}; the desktop shows the cabin, the lever goes on", why));
}

bool WornHeadset::begin(const Stage& stage) {
  try {
    const bool worn = view_->begin();
    wants_exit_ = wants_exit_ || view_->state() == HeadsetState::exiting;
    if (!worn) return false;
    follow_changes();
    sit(stage);
    follow_hands(stage);
    return true;
  } catch (const HeadsetError& error) {
    lose(error.what());
  } catch (const GpuError& error) {
    lose(error.what());
  }
  return false;
}

void WornHeadset::draw(const FrameScene& scene, const SeenPart& seen, const SeenPart& card, glm::dvec2 panel_size) {
  const DriveSide side = setup_.seat.drive;
  const glm::dvec3 eye = camera("driver", side).position;
  panel_ = panel_open_ ? hang_panel(eye, side, panel_size) : hang_card(eye, side, panel_size, card.low, card.high);
  const HeadsetPanel panel = in_room(cabin_from_room_, panel_);
  try {
    view_->draw(scene, cabin_from_room_, &panel, seen);
  } catch (const HeadsetError& error) {
    lose(error.what());
  } catch (const GpuError& error) {
    lose(error.what());
  }
}

// Where a person has set the room's origin anew, what was touched in it moves with it; a person who recentres wants to sit.
void WornHeadset::follow_changes() {
  while (const std::optional<SpaceChange> change = view_->take_change()) {
    if (!change->ours) {
      recentre();
    } else if (change->new_from_old && is_touched_) {
      cabin_from_room_ = cabin_from_room_ * inverse(*change->new_from_old);
      setup_.seat.touched = cabin_from_room_;
      keep();
    } else {
      if (is_touched_) news_ = "the room was set up anew: touch the knob again";
      setup_.seat.touched.reset();
      recentre();
    }
  }
}

// Once the head is known; and again when it is asked for.
void WornHeadset::sit(const Stage& stage) {
  const HeadsetEyes& eyes = view_->eyes();
  if (sits_ || !eyes.is_tracked) return;
  sits_ = true;
  const SeatSettings& seat = setup_.seat;
  const SeatPlaces places{camera("driver", seat.drive).position, stage.knob_at_rest()};
  is_touched_ = seat.touched.has_value() && view_->keeps_room();
  if (is_touched_)
    cabin_from_room_ = *seat.touched;
  else if (seat.knob)
    cabin_from_room_ = seat_at_lever(between(eyes), places, *seat.knob);
  else
    cabin_from_room_ = seat_at_eyes(between(eyes), places, seat.height);
}

// The first hand that points at the panel has it.
void WornHeadset::follow_hands(const Stage& stage) {
  pointer_.reset();
  beam_.reset();
  const std::array<HeadsetHand, 2> hands = view_->hands();
  for (std::size_t i = 0; i < hands.size(); ++i) {
    const HeadsetHand& hand = hands[i];
    const bool selected = std::exchange(selected_[i], hand.selects), had_menu = std::exchange(menu_[i], hand.menu);
    const bool pressed = hand.selects && !selected;
    if (hand.menu && !had_menu) panel_open_ = !panel_open_;
    if (!hand.is_tracked) continue;
    const EyePose aim = cabin_from_room_ * hand.aim;
    const glm::dvec3 along = aim.orientation * glm::dvec3(0.0, 0.0, -1.0);
    if (pointer_) continue;
    if (const std::optional<PanelHit> hit = point_at(panel_, aim)) {
      pointer_ = Pointer{*hit, hand.selects, hand.scroll};
      beam_ = Beam{aim.position, aim.position + hit->distance * along};
    } else if (touching_) {
      beam_ = Beam{aim.position, aim.position + kTip * along};
      if (pressed) touch(hand.aim, stage);
    }
  }
}

void WornHeadset::touch(const EyePose& hand, const Stage& stage) {
  touches_.add(hand.position, stage.knob_top());
  const std::optional<LeverTouches::Fit> fit = touches_.fit(cabin_from_room_);
  cabin_from_room_ = fit->cabin_from_room;
  worst_touch_ = fit->worst;
}

void WornHeadset::obey(const HeadsetRequests& requests, double bound) {
  SeatSettings& seat = setup_.seat;
  if (requests.touch) {
    touching_ = panel_open_ = true;  // it says how
    touches_.forget();
    worst_touch_ = 0.0;
  }
  if (requests.touched && touching_) {
    touching_ = false;
    if (touches_.count() == 0) {
      news_ = "nothing was touched: the seat stays";
    } else if (worst_touch_ > bound) {
      news_ =
          fmt::format("the touches are up to {:.0f} mm from the lever as it is seen, and {:.0f} may be: touch again",
                      1e3 * worst_touch_, 1e3 * bound);
      sits_ = false;
    } else {
      is_touched_ = true;
      seat.touched = cabin_from_room_;
      seat.touch_error = worst_touch_;
      keep();
    }
  }
  if (requests.forget_touches) {
    touching_ = is_touched_ = sits_ = false;
    seat.touched.reset();
    seat.touch_error = 0.0;
    keep();
  }
  if (requests.height) {
    if (sits_ && !is_touched_ && !seat.knob) cabin_from_room_.position.y += *requests.height - seat.height;
    seat.height = *requests.height;
    keep();
  }
  if (requests.knob || requests.forget_knob) {
    seat.knob = requests.knob;
    sits_ = false;
    keep();
  }
  if (requests.recentre) recentre();
}

// Where the room is another tomorrow, what was touched is of today alone.
void WornHeadset::keep() {
  if (setup_.seat_file.empty()) return;
  SeatSettings seat = setup_.seat;
  if (view_ && !view_->keeps_room()) seat.touched.reset();
  try {
    write_seat(seat, setup_.seat_file);
  } catch (const FileError& error) {
    news_ = error.what();
  }
}

EyePose WornHeadset::head() const {
  return cabin_from_room_ * between(view_->eyes());
}

double WornHeadset::touch_error() const noexcept {
  return view_ && is_touched_ ? setup_.seat.touch_error : 0.0;
}

std::string WornHeadset::take_news() {
  return std::exchange(news_, {});
}

HeadsetReport WornHeadset::report() const {
  HeadsetReport report;
  report.headset = view_->headset().headset;
  report.runtime = view_->headset().runtime;
  report.state = name_of(view_->state());
  report.eye = view_->eye_size();
  report.timing = view_->timing();
  report.is_tracked = view_->eyes().is_tracked;
  report.seat = setup_.seat;
  report.touching = touching_;
  report.touches = touches_.count();
  report.worst_touch = worst_touch_;
  return report;
}

}  // namespace gearshift
