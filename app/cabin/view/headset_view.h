// The cabin in a headset with the panel as an image hanging in it, and a mirror window for the instructor.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "app/cabin/view/visible_region.h"
#include "engine/model/model.h"
#include "engine/scene/frame_scene.h"
#include "engine/ui/ui.h"
#include "engine/window/window.h"
#include "engine/xr/frame_times.h"
#include "engine/xr/headset_session.h"

namespace gearshift::cabin {

struct HeadsetViewConfig {
  double scale = 1.0;            // [1] 0.3 to 2, relative to the image size recommended by the headset
  int samples = 0;               // 1, 4, or 0: 4 on a GPU, 1 on a software driver
  double near_plane = 0.05;      // [m]
  glm::ivec2 panel{1920, 1080};  // [px] size of its image: 32 px per degree on the lesson card
};

class HeadsetView {
 public:
  // window and ui must outlive the view. Throws HeadsetError with one sentence, GpuError.
  HeadsetView(const HeadsetViewConfig& config, std::unique_ptr<engine::HeadsetRuntime> runtime, engine::Window& window,
              engine::UiContext& ui);
  ~HeadsetView();

  void set_model(const engine::Model& model);

  // Polls the headset. If it is in use, waits for its next frame, locates the eyes and returns true; draw() must
  // follow. If the runtime holds the frame back for more than 50 ms, no frame begins, so that the lever's keys are not
  // delayed. This and the other functions throw HeadsetLost, after which the view must be recreated.
  bool begin();
  bool has_begun() const noexcept;                   // a frame has begun
  bool is_waiting() const noexcept;                  // the runtime holds a frame back: the destructor waits for it
  void release_window();                             // ends the mirror, so that another view can use the window
  bool is_shown() const noexcept;                    // the runtime displays the last frame
  const engine::HeadsetEyes& eyes() const noexcept;  // in the room
  // For the frame that has begun.
  std::array<engine::HeadsetHand, 2> hands();  // in the room: left, right
  std::optional<engine::SpaceChange> take_due_space_change();

  // Draws from the current eye poses, submits the frame, and then updates the mirror in that region of the window.
  // cabin_from_room: see SeatCalibration. panel: in the room; null: hidden. If no frame is shown, only the mirror is
  // drawn, from the room's origin.
  void draw(const engine::FrameScene& scene, const engine::EyePose& cabin_from_room, const engine::HeadsetPanel* panel,
            const VisibleRegion& region);

  const engine::HeadsetTraits& headset() const noexcept;
  engine::HeadsetState state() const noexcept;
  bool is_room_persistent() const noexcept;  // the tracking space is the same in the next session
  const engine::HeadsetTiming& timing() const noexcept;
  glm::ivec2 eye_size() const noexcept;  // [px]
  std::uint64_t validation_messages() const;
  std::string take_message();  // returns once why the mirror failed; empty: no failure

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gearshift::cabin
