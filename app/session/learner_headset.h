// The headset in a running session: its pictures, the user's seat in the cabin, and the hand that points at the panel.
// The headset may be lost and found again; in the meantime the caller shows the cabin on the desktop.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "app/base/console.h"
#include "app/cabin/headset/hanging_panel.h"
#include "app/cabin/headset/headset_report.h"
#include "app/cabin/headset/seat_calibration.h"
#include "app/cabin/headset/seat_file.h"
#include "app/cabin/stage/stage.h"
#include "app/cabin/view/headset_view.h"
#include "app/ui/panel/commands.h"

namespace gearshift::session {

struct HeadsetSetup {
  cabin::HeadsetViewConfig view;
  std::filesystem::path seat_file;  // file in which the seat is saved; empty: not saved
  cabin::SeatSettings seat;
  bool is_new = false;  // true if `seat` differs from the file and must be saved
};

class LearnerHeadset {
 public:
  // Does not open a headset yet. Window and panel must outlive this object.
  LearnerHeadset(const HeadsetSetup& setup, engine::Window& window, engine::UiContext& ui);

  // Searches for an OpenXR runtime with a headset, and opens it, without waiting: call it in each frame. A search begins
  // at most every 2 s. When this returns true, destroy the window's view, then call open().
  bool is_found();
  // Creates the view of the headset that is_found() has found. Returns false on failure; see take_message().
  bool open();
  bool is_open() const noexcept { return view_ != nullptr; }
  bool is_held() const noexcept { return view_ && view_->is_held(); }   // the runtime withholds the next frame
  bool is_worn() const noexcept { return view_ && view_->is_shown(); }  // the user sees the headset's pictures

  // Uploads the stage's model; call only while is_open(). False: not done, because the runtime is using the GPU.
  bool set_model(const engine::Model& model);

  // Call begin() and draw() once per frame, in this order. begin() waits for the headset's next frame and updates the
  // seat. It returns false if nobody is wearing the headset; the caller must then limit the frame rate. If the headset
  // is lost, the view is destroyed: see is_open() and take_message().
  bool begin(const cabin::Stage& stage);
  // `visible`: the part of the picture that the panel leaves free. `card`: that part plus the lesson card. `desk`: the
  // window's camera, used while nobody is wearing the headset.
  void draw(const engine::FrameScene& scene, const cabin::VisibleRegion& visible, const cabin::VisibleRegion& card,
            const engine::EyePose& desk);

  // The functions from here to beam() return values for the frame that begin() has started.
  engine::EyePose head() const;  // pose in the cabin; midway between the eyes
  struct Pointer {
    cabin::PanelHit hit;
    bool selects = false;
    glm::dvec2 scroll{0.0};
  };
  const std::optional<Pointer>& pointer() const noexcept { return pointer_; }  // the hand's pointer on the panel
  const std::optional<cabin::Beam>& beam() const noexcept { return beam_; }    // the hand's beam in cabin coordinates
  bool wants_exit() const noexcept { return wants_exit_; }
  // Returns true once after a menu button has opened the whole panel.
  void toggle_panel() noexcept { opened_ = panel_open_ = !panel_open_; }  // the whole panel, or only the lesson card
  bool take_opened() noexcept { return std::exchange(opened_, false); }

  void recentre() noexcept { seating_.recentre(); }
  // Call only while is_open(). `bound` [m]: maximum allowed distance between felt and displayed lever.
  void apply(const ui::HeadsetCommand& command, double bound);
  cabin::HeadsetReport report() const;
  double touch_error() const noexcept;  // [m] distance between felt and displayed lever due to the seat calibration
  std::string take_message();           // one sentence, returned only once; empty: no message

 private:
  void report_once(const std::string& message);
  void stop_opening(const std::string& why);
  void lose(const std::string& why);
  template <class Work>
  void guarded(const Work& work);
  bool is_off() const;
  void follow_wearing();
  void report_taken_off();
  void update_seat(const cabin::Stage& stage);
  void follow_hands(const cabin::Stage& stage);

  HeadsetSetup setup_;
  engine::Window& window_;
  engine::UiContext& ui_;
  // While a headset is opened or closed: client libraries of runtimes print lines to stderr at each attempt.
  std::optional<base::QuietLibraries> quiet_;
  std::unique_ptr<cabin::OpeningHeadset> opening_;  // null: none is being opened
  std::chrono::steady_clock::time_point began_opening_{};
  std::unique_ptr<cabin::HeadsetView> view_;
  std::chrono::steady_clock::time_point next_try_{};
  std::chrono::seconds pause_{2};
  std::string reported_;  // the last reported reason why no headset is open

  cabin::SeatCalibration seating_;
  bool was_worn_ = false;
  // Since when the session of a worn headset shows nothing.
  std::optional<std::chrono::steady_clock::time_point> unseen_since_;
  // Time at which the headset was taken off; empty once this has been reported.
  std::optional<std::chrono::steady_clock::time_point> taken_off_at_;
  bool placed_ = false;  // true if the head's position is known; else the head is placed at the driver's eye point

  cabin::HangingPanel panel_;
  std::optional<Pointer> pointer_;
  std::optional<cabin::Beam> beam_;
  std::array<bool, 2> selected_{}, menu_{};  // for each hand, in the previous frame: trigger held; menu button held
  bool panel_open_ = false;                  // false: only the lesson card; a hand's menu button toggles this
  bool opened_ = false;                      // see take_opened()
  bool wants_exit_ = false;
  std::string message_;
};

}  // namespace gearshift::session
