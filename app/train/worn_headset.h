// A headset that somebody wears at the lever: its pictures, where it sits in the cabin, and the hand that points at the
// panel. It may be lost and come back; without it the caller shows the cabin on the desktop.
#pragma once

#include <chrono>
#include <filesystem>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "app/headset/hanging_panel.h"
#include "app/headset/headset_report.h"
#include "app/headset/seat_file.h"
#include "app/headset/seating.h"
#include "app/stage/stage.h"
#include "app/view/headset_view.h"

namespace gearshift {

struct HeadsetSetup {
  HeadsetViewConfig view;
  std::filesystem::path seat_file;  // empty: nothing is kept
  SeatSettings seat;
  bool is_new = false;  // it is another one than the file's: kept once the trainer runs
};

class WornHeadset {
 public:
  // Nothing of a headset is opened yet. Window and panel outlive it.
  WornHeadset(const HeadsetSetup& setup, Window& window, UiContext& ui);

  // Is there a runtime with a headset now? Asks once every 2 s. Where there is, the window must be free for open().
  bool is_found();
  // What is_found() has found becomes the view. False where that fails: news() says why.
  bool open();
  bool is_open() const noexcept { return view_ != nullptr; }
  bool is_held() const noexcept { return view_ && view_->awaits(); }    // by the runtime: its next frame
  bool is_worn() const noexcept { return view_ && view_->is_shown(); }  // somebody sees through it

  void set_model(const Model& model);  // of the stage; also while nothing is open

  // A frame, in this order. begin(): waits for the headset's next frame and places the seat; false where nobody wears it
  // now, and the caller paces. Where the headset is lost everything of it is gone: is_open() says so, news() why.
  bool begin(const Stage& stage);
  // seen: what the panel leaves to the cabin; card: the same with a learner's card; desk: from where the window shows the
  // cabin while nobody sees through the headset.
  void draw(const FrameScene& scene, const SeenPart& seen, const SeenPart& card, const EyePose& desk);

  // Of the frame that has begun.
  EyePose head() const;  // in the cabin, midway between the eyes
  struct Pointer {
    PanelHit hit;
    bool selects = false;
    glm::dvec2 scroll{0.0};
  };
  const std::optional<Pointer>& pointer() const noexcept { return pointer_; }  // of the hand that points at the panel
  const std::optional<Beam>& beam() const noexcept { return beam_; }           // from that hand, in the cabin
  bool wants_exit() const noexcept { return wants_exit_; }
  bool take_opened() noexcept { return std::exchange(opened_, false); }  // a menu button asked for the whole panel

  void recentre() noexcept { seating_.recentre(); }
  void obey(const HeadsetRequests& requests, double bound);  // bound [m]: how far felt and seen lever may be apart
  HeadsetReport report() const;
  double touch_error() const noexcept;  // [m] between felt and seen lever, as far as the seat makes it
  std::string take_news();              // one sentence, once; empty: none

 private:
  void tell_once(const std::string& news);
  bool is_leaving() const;
  void lose(const std::string& why);
  template <class Deed>
  void guarded(const Deed& deed);
  void put_down();
  void tell_put_down();
  void take_seat(const Stage& stage);
  void follow_hands(const Stage& stage);

  HeadsetSetup setup_;
  Window& window_;
  UiContext& ui_;
  std::unique_ptr<HeadsetRuntime> found_;
  std::unique_ptr<HeadsetView> view_;
  std::future<void> leaving_;  // of a view that was lost while the runtime held a frame of it back
  std::chrono::steady_clock::time_point next_try_{};
  std::chrono::seconds pause_{2};
  std::string told_;  // the last of what is looked for in vain

  Seating seating_;
  bool worn_ = false;                                              // in the frame before
  std::optional<std::chrono::steady_clock::time_point> put_down_;  // and not yet told
  bool placed_ = false;  // where the head is has been told; until then it sits where it looks from

  HangingPanel panel_;
  std::optional<Pointer> pointer_;
  std::optional<Beam> beam_;
  std::array<bool, 2> selected_{}, menu_{};  // in the frame before
  bool panel_open_ = false;                  // all of it, not the learner's card alone: by the hand's menu button
  bool opened_ = false;                      // just now
  bool wants_exit_ = false;
  std::string news_;
};

}  // namespace gearshift
