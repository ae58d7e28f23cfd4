#include "app/train/worn_headset.h"

#include <algorithm>
#include <utility>

#include <fmt/core.h>

namespace gearshift {
namespace {

constexpr std::chrono::seconds kPause(2), kLongestPause(60);  // between two looks for a headset
constexpr std::chrono::seconds kPutDown(1);                   // after which it is told: who leaves puts it down, too
constexpr double kTip = 0.10;  // [m] of the ray of a hand that touches: where it begins is the tip

HeadsetPanel in_room(const EyePose& cabin_from_room, const HangingPanel& panel) {
  return {inverse(cabin_from_room) * panel.pose, panel.size, panel.low, panel.high};
}

EyePose between(const HeadsetEyes& eyes) {
  return {0.5 * (eyes.pose[0].position + eyes.pose[1].position),
          glm::slerp(eyes.pose[0].orientation, eyes.pose[1].orientation, 0.5)};
}

}  // namespace

WornHeadset::WornHeadset(const HeadsetSetup& setup, Window& window, UiContext& ui)
    : setup_(setup),
      window_(window),
      ui_(ui),
      seating_(setup.seat, setup.seat_file, camera("driver", setup.seat.drive).position) {
  if (setup.is_new) seating_.keep();
}

bool WornHeadset::is_found() {
  const auto now = std::chrono::steady_clock::now();
  if (view_ || now < next_try_ || is_leaving()) return false;
  next_try_ = now + pause_;
  try {
    found_ = std::make_unique<HeadsetRuntime>();
    return true;
  } catch (const HeadsetAbsent& absent) {
    pause_ = kPause;
    tell_once(fmt::format("{}; the desktop shows the cabin until one is", absent.what()));
  } catch (const HeadsetError& error) {
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
    return false;
  }
  news_ = fmt::format("{} at {}", view_->headset().headset, view_->headset().runtime);
  return true;
}

// Nothing of a headset or of its GPU ends the trainer.
template <class Deed>
void WornHeadset::guarded(const Deed& deed) {
  try {
    deed();
  } catch (const HeadsetError& error) {
    lose(error.what());
  } catch (const GpuError& error) {
    lose(error.what());
  }
}

void WornHeadset::set_model(const Model& model) {
  guarded([&] { view_->set_model(model); });
}

bool WornHeadset::is_leaving() const {
  return leaving_.valid() && leaving_.wait_for(std::chrono::seconds(0)) != std::future_status::ready;
}

// STOP waits for no runtime: a view of which a frame is held back goes beside us.
void WornHeadset::lose(const std::string& why) {
  if (view_ && view_->awaits()) {
    view_->leave_window();
    leaving_ = std::async(std::launch::async, [view = std::move(view_)]() mutable { view.reset(); });
  }
  view_.reset();
  found_.reset();
  pointer_.reset();
  beam_.reset();
  worn_ = false;
  put_down_.reset();
  seating_.leave();
  next_try_ = std::chrono::steady_clock::now() + pause_;
  pause_ = std::min(2 * pause_, kLongestPause);  // each try takes the desktop's picture away
  tell_once(fmt::format("{}; the desktop shows the cabin, the lever goes on", why));
}

bool WornHeadset::begin(const Stage& stage) {
  bool worn = false;
  guarded([&] {
    worn = view_->begin();
    wants_exit_ = wants_exit_ || view_->state() == HeadsetState::exiting;
    if (std::string news = view_->take_news(); !news.empty()) news_ = "the window does not show it: " + news;
    if (std::exchange(worn_, worn) && !worn) put_down();
    tell_put_down();
    pointer_.reset();
    beam_.reset();
    if (!view_->has_begun()) return;
    while (const std::optional<SpaceChange> change = view_->take_change())
      seating_.follow(*change, view_->keeps_room());
    if (view_->is_shown()) {
      pause_ = kPause;
      told_.clear();
      take_seat(stage);
    }
    follow_hands(stage);
  });
  return worn && view_ != nullptr;
}

void WornHeadset::put_down() {
  seating_.stand_up();
  put_down_ = std::chrono::steady_clock::now();
}

void WornHeadset::tell_put_down() {
  if (worn_ || wants_exit_) put_down_.reset();
  if (!put_down_ || std::chrono::steady_clock::now() - *put_down_ < kPutDown) return;
  put_down_.reset();
  news_ = "the headset is put down; the desktop shows the cabin";
}

// Some headsets never tell a place, and some not at first: the head is at the wheel all the same, and sits down anew once
// there is a place. What was touched in the room is nothing to a head that is nowhere in it.
void WornHeadset::take_seat(const Stage& stage) {
  const HeadsetEyes& eyes = view_->eyes();
  if (std::exchange(placed_, eyes.is_known) != eyes.is_known) seating_.recentre();
  const bool seen = eyes.is_known ? eyes.is_tracked : eyes.is_oriented;
  if (seen) seating_.sit(between(eyes), stage.knob_at_rest(), eyes.is_known && view_->keeps_room());
}

void WornHeadset::draw(const FrameScene& scene, const SeenPart& seen, const SeenPart& card, const EyePose& desk) {
  const DriveSide side = setup_.seat.drive;
  const EyePose driver = camera("driver", side);
  const glm::dvec2 size = setup_.view.panel;
  panel_ = panel_open_ ? hang_panel(driver.position, side, size)
                       : hang_card(driver.position, side, size, card.low, card.high);
  const HeadsetPanel panel = in_room(seating_.cabin_from_room(), panel_);
  const EyePose& seat = view_->is_shown() ? seating_.cabin_from_room() : desk;
  guarded([&] { view_->draw(scene, seat, &panel, seen); });
}

// The first hand that points at the panel has it.
void WornHeadset::follow_hands(const Stage& stage) {
  const std::array<HeadsetHand, 2> hands = view_->hands();
  for (std::size_t i = 0; i < hands.size(); ++i) {
    const HeadsetHand& hand = hands[i];
    const bool selected = std::exchange(selected_[i], hand.selects), had_menu = std::exchange(menu_[i], hand.menu);
    const bool pressed = hand.selects && !selected;
    if (hand.menu && !had_menu) opened_ = panel_open_ = !panel_open_;
    if (!hand.is_tracked) continue;
    const EyePose aim = seating_.cabin_from_room() * hand.aim;
    const glm::dvec3 along = aim.orientation * glm::dvec3(0.0, 0.0, -1.0);
    if (pointer_) continue;
    if (const std::optional<PanelHit> hit = point_at(panel_, aim)) {
      pointer_ = Pointer{*hit, hand.selects, hand.scroll};
      beam_ = Beam{aim.position, aim.position + hit->distance * along};
    } else if (seating_.touches()) {
      beam_ = Beam{aim.position, aim.position + kTip * along};
      if (pressed && hand.is_seen) seating_.touch(hand.aim, stage.knob_top());
    }
  }
}

void WornHeadset::obey(const HeadsetRequests& requests, double bound) {
  if (requests.touch) panel_open_ = true;  // it says how
  seating_.obey(requests, bound, view_->keeps_room());
}

EyePose WornHeadset::head() const {
  return seating_.cabin_from_room() * between(view_->eyes());
}

double WornHeadset::touch_error() const noexcept {
  return view_ ? seating_.touch_error() : 0.0;
}

std::string WornHeadset::take_news() {
  if (news_.empty()) return seating_.take_news();
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
  report.turns_alone = view_->eyes().is_oriented && !view_->eyes().is_known;
  seating_.report(report);
  return report;
}

}  // namespace gearshift
