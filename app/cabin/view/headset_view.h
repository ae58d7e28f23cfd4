// Draws the cabin in a headset, with the panel as an image that hangs in the cabin, and a mirror window for the
// instructor.
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
  double scale = 1.0;            // [1] 0.3 to 2: image size / size recommended by the headset
  int samples = 0;               // samples per pixel: 1 or 4; 0: 4 on a GPU that supports it, otherwise 1
  double near_plane = 0.05;      // [m]
  glm::ivec2 panel{1920, 1080};  // [px] size of the panel's image; gives the lesson card 32 px per degree
};

// A headset that is being opened: the runtime, and what draws its pictures. Everything is made, used and destroyed on a
// HeadsetThread. Whoever destroys it, or the view made of it, waits for nothing; what a hung runtime blocks is left
// behind, see engine::HeadsetThread::wait_for_ended().
class OpeningHeadset {
 public:
  explicit OpeningHeadset(const HeadsetViewConfig& config);  // throws HeadsetError if no thread can be started
  ~OpeningHeadset();
  // False while it is not open yet. Throws why opening failed: HeadsetError, HeadsetAbsent, HeadsetLost or GpuError.
  bool is_open();

 private:
  friend class HeadsetView;
  struct State;
  std::unique_ptr<State> state_;
};

class HeadsetView {
 public:
  // `opened`: is_open(). window and ui must outlive the view. Throws GpuError.
  HeadsetView(std::unique_ptr<OpeningHeadset> opened, engine::Window& window, engine::UiContext& ui);
  ~HeadsetView();

  // Uploads the model. Returns false, having done nothing, while the runtime may be using the GPU's queue.
  bool set_model(const engine::Model& model);

  // Polls the headset. If the headset is in use, waits for its next frame, locates the eyes and returns true; draw()
  // must follow. If the runtime takes more than 50 ms, returns true without a frame (see has_begun()), so that nothing
  // else waits for the runtime; later calls then wait for 5 ms only. A runtime may hold back a frame for ever; if it
  // does not return from another call within 5 s, this throws HeadsetLost. This and the other functions throw
  // HeadsetLost, after which the view must be recreated.
  bool begin();
  bool has_begun() const noexcept;                   // true between begin() and draw()
  bool is_held() const noexcept;                     // the runtime has not returned from a call in time
  bool is_shown() const noexcept;                    // true if the headset displays the newest frame
  const engine::HeadsetEyes& eyes() const noexcept;  // poses of the eyes in the room
  // Left and right hand when the frame began; poses in the room.
  const std::array<engine::HeadsetHand, 2>& hands() const noexcept;
  std::optional<engine::SpaceChange> take_due_space_change();

  // Draws from the current eye poses, submits the frame, and then updates the mirror. `cabin_from_room`: see
  // SeatCalibration. `panel`: pose and size in the room; if null, the panel is hidden. `region`: the part of the
  // mirror's image that shows the view. If the headset displays no frames, only the mirror is drawn, from the room's
  // origin.
  void draw(const engine::FrameScene& scene, const engine::EyePose& cabin_from_room, const engine::HeadsetPanel* panel,
            const VisibleRegion& region);

  const engine::HeadsetTraits& headset() const noexcept;
  engine::HeadsetState state() const noexcept;
  std::optional<bool> is_present() const noexcept;  // somebody wears the headset; empty: the runtime does not report it
  bool is_room_persistent() const noexcept;         // true if the tracking space stays the same in the next session
  const engine::HeadsetTiming& timing() const noexcept;
  glm::ivec2 eye_size() const noexcept;  // [px]
  std::uint64_t validation_messages() const;
  std::string take_message();  // why the mirror failed, returned only once; empty: no failure

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gearshift::cabin
