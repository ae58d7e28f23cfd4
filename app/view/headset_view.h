// The cabin in a headset, the panel as a picture that hangs in it, and what the learner sees in a window for the
// instructor.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "app/view/seen_part.h"
#include "engine/model/model.h"
#include "engine/scene/frame_scene.h"
#include "engine/ui/ui.h"
#include "engine/window/window.h"
#include "engine/xr/frame_times.h"
#include "engine/xr/headset_session.h"

namespace gearshift {

struct HeadsetViewConfig {
  double scale = 1.0;            // [1] 0.3 to 2: of the picture that the headset recommends
  int samples = 0;               // 1, 4, or 0: 4 on a GPU, 1 on a software driver
  double near_plane = 0.05;      // [m]
  glm::ivec2 panel{1920, 1080};  // [px] its picture: enough for 32 to a degree of a learner's card
};

class HeadsetView {
 public:
  // Window and panel outlive it. Throws HeadsetError in one sentence, GpuError.
  HeadsetView(const HeadsetViewConfig& config, std::unique_ptr<HeadsetRuntime> runtime, Window& window, UiContext& ui);
  ~HeadsetView();

  void set_model(const Model& model);

  // Takes what the headset tells. Where it is worn, waits for its next frame and finds the eyes: true, and draw() must
  // follow. Where the runtime holds the frame back for 50 ms, none has begun: the lever's keys do not wait for it.
  // Throws HeadsetLost: all of this is to be made anew; so do the others.
  bool begin();
  bool has_begun() const noexcept;           // a frame
  bool awaits() const noexcept;              // a frame that is held back: the destructor waits for it
  void leave_window();                       // to another view: the instructor sees nothing from here any more
  bool is_shown() const noexcept;            // to somebody, said the runtime of its last frame
  const HeadsetEyes& eyes() const noexcept;  // in the room
  // Of the frame that has begun.
  std::array<HeadsetHand, 2> hands();  // in the room: left, right
  std::optional<SpaceChange> take_change();

  // Draws from where the eyes are now, shows it, and then to the instructor, in that part of the window. cabin_from_room:
  // see Seat. panel: in the room; null: it is hidden. Where no frame is shown the instructor alone sees it, from
  // cabin_from_room itself: nobody is behind the eyes.
  void draw(const FrameScene& scene, const EyePose& cabin_from_room, const HeadsetPanel* panel, const SeenPart& seen);

  const HeadsetTraits& headset() const noexcept;
  HeadsetState state() const noexcept;
  bool keeps_room() const noexcept;  // the room is the same from one day to the next
  const HeadsetTiming& timing() const noexcept;
  glm::ivec2 eye_size() const noexcept;  // [px]
  std::uint64_t validation_messages() const;
  std::string take_news();  // why the window shows nothing, once; empty: it does

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gearshift
