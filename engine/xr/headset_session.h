// An OpenXR session: life cycle, frames, images. Each call may block for as long as the runtime likes: use it, its
// construction and destruction included, on a HeadsetThread only. Calls in which the runtime may use the Vulkan queue
// hold Gpu::queue_mutex() meanwhile.
//
// Order of calls in a frame: poll(), wait(), locate(); draw; locate() again just before the submission; end().
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

#include "engine/gpu/gpu_image.h"
#include "engine/scene/view.h"
#include "engine/xr/headset_runtime.h"

namespace gearshift::engine {

struct HeadsetConfig {
  glm::ivec2 eye{0};    // [px] per eye
  glm::ivec2 panel{0};  // [px] size of the panel's picture; 0: no panel
};

// States of the session, in the order in which a session normally reaches them.
enum class HeadsetState : std::uint8_t {
  idle,          // headset not worn, or in use by another program
  ready,         // the session has just begun
  synchronised,  // frames are paced but not visible
  visible,       // visible, but hands and buttons go to another program, e.g. the system menu
  focused,       // visible and with input
  stopping,      // the session ends, e.g. because the headset was taken off
  exiting        // the user has asked us to exit
};
std::string_view to_string(HeadsetState state) noexcept;

// Times are on the runtime's clock.
struct HeadsetFrame {
  std::int64_t display_ns = 0;   // [ns] predicted display time
  std::int64_t wait_end_ns = 0;  // [ns] end time of the runtime's wait; 0 if the runtime's clock is not available
  double period = 0.0;           // [s] display period
  bool should_render = false;    // false: drawing is unnecessary
};

// Eyes in the tracking space. While the head's position or orientation is not tracked, its last value is used; both
// eyes stay attached to the head.
struct HeadsetEyes {
  std::array<EyePose, 2> pose;
  std::array<Fov, 2> fov;
  bool is_known = false;     // the poses were tracked at least once in this session
  bool is_tracked = false;   // position and orientation are tracked now
  bool is_oriented = false;  // orientation is tracked now; some headsets track only this
};

// The origin of the tracking space has moved: a point that had coordinates p now has coordinates new_from_old * p.
struct SpaceChange {
  // True: the space in which this session gives all poses has moved. False: a different space moved, because the user
  // recentred the view.
  bool is_session_space = false;
  std::optional<EyePose> new_from_old;  // empty: unknown
};

struct HeadsetHand {
  bool is_active = false;  // a controller or tracked hand that this program knows is in use
  bool is_tracked = false;
  bool is_position_tracked = false;  // position is tracked now, not estimated
  EyePose aim;                       // pose of the pointing ray, which points along -Z
  bool selects = false;              // trigger
  bool menu = false;                 // button
  glm::dvec2 scroll{0.0};            // [1] thumb stick, right and up are positive
};

// A rectangle of the panel's picture, placed in the room. `pose` is the pose of the rectangle's centre; the rectangle
// faces +Z.
struct HeadsetPanel {
  EyePose pose;
  glm::dvec2 size{0.0};            // [m]
  glm::dvec2 low{0.0}, high{1.0};  // [1] fractions of the picture, from its upper left corner
};

class HeadsetSession {
 public:
  // Runtime and Gpu must outlive the session. Throws HeadsetError, HeadsetLost.
  HeadsetSession(HeadsetRuntime& runtime, Gpu& gpu, const HeadsetConfig& config);
  ~HeadsetSession();  // waits until the device is idle

  // Handles the runtime's events since the last poll(), and begins or ends the session as the runtime requests. Throws
  // HeadsetLost.
  void poll();
  HeadsetState state() const noexcept;
  // wait() is waiting for the runtime, which may hold back a frame as long as it likes. May be called on any thread.
  bool is_waiting() const noexcept;
  std::optional<bool> is_present() const noexcept;  // somebody wears the headset; empty: the runtime does not tell
  bool is_running() const noexcept;                 // the runtime requests frames, so wait() paces them
  const HeadsetEyes& eyes() const noexcept;         // as last located; at first, side by side at the origin
  bool is_stage() const noexcept;                   // poses are in a room-fixed space that persists from day to day

  // Waits until the runtime requests the next frame, reads the controllers, and begins that frame. Throws HeadsetLost.
  HeadsetFrame wait();
  HeadsetEyes locate(const HeadsetFrame& frame);
  std::array<HeadsetHand, 2> hands(const HeadsetFrame& frame);  // left, right; default values while not focused
  std::optional<SpaceChange> take_due_space_change(const HeadsetFrame& frame);  // empty until a change is due

  // Images of this frame; an image is null if the runtime has no free one, or if there is no depth or panel. Copy into
  // the images between acquire_images() and transition_for_release(), which records a layout transition. end() releases
  // the images, after the submission.
  struct Images {
    GpuImage *colour = nullptr, *depth = nullptr, *panel = nullptr;
  };
  Images acquire_images(bool panel);
  void transition_for_release(VkCommandBuffer commands);

  // Submits the frame. `eyes`: the views from which it was drawn; null: no picture. `panel`: null if there is none.
  // `near_plane`: near plane of the depth image's projection [m].
  void end(const HeadsetFrame& frame, const HeadsetEyes* eyes, double near_plane, const HeadsetPanel* panel);

  std::int64_t now_ns() const;  // [ns] on the runtime's clock; 0 if it is not available

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gearshift::engine
