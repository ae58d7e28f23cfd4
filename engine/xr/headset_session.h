// A session at a headset: its life cycle, its frames, its images. One thread.
//
// A frame by the book: poll(), wait(), locate(), draw, locate() again just before it is submitted, end().
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

#include "engine/gpu/gpu_image.h"
#include "engine/scene/view.h"
#include "engine/xr/headset_runtime.h"

namespace gearshift {

struct HeadsetConfig {
  glm::ivec2 eye{0};    // [px] of each eye's picture
  glm::ivec2 panel{0};  // [px] of the panel's; 0: there is none
};

// What the runtime lets us do; in the order of getting there.
enum class HeadsetState : std::uint8_t {
  idle,          // nobody wears it, or another program has it
  ready,         // begins with the next poll()
  synchronised,  // frames are paced and not seen
  visible,       // seen, but another program has hands and buttons: its menu is open
  focused,       // all is ours
  stopping,      // put down
  exiting        // the person has asked us to leave
};
std::string_view name_of(HeadsetState state) noexcept;

// One frame. Times are on the runtime's clock.
struct HeadsetFrame {
  std::int64_t display_ns = 0;  // [ns] when it will be seen, as predicted
  std::int64_t woken_ns = 0;    // [ns] when wait() was over; 0 where the runtime's clock is not told
  double period = 0.0;          // [s] between two frames of the display
  bool is_shown = false;        // false: nothing need be drawn
};

// Eyes in the tracking space. Where tracking is lost the head stays where it was, or looks where it did, as far as it is
// lost; both eyes stay on it.
struct HeadsetEyes {
  std::array<EyePose, 2> pose;
  std::array<Fov, 2> fov;
  bool is_known = false;     // their place was told since the session began
  bool is_tracked = false;   // place and orientation are told now
  bool is_oriented = false;  // orientation is: all that some headsets ever tell
};

// The room's origin has moved: what stood at p in it stands at new_from_old p from now on.
struct SpaceChange {
  bool ours = false;                    // the space that all poses are in; else the one that a person recentres
  std::optional<EyePose> new_from_old;  // none: nobody knows
};

struct HeadsetHand {
  bool is_tracked = false;
  bool is_seen = false;    // now: its place is no guess
  EyePose aim;             // points along its -Z
  bool selects = false;    // trigger
  bool menu = false;       // button
  glm::dvec2 scroll{0.0};  // [1] thumb stick, right and up +
};

// A part of the panel's picture that hangs in the room: its middle, facing along its +Z.
struct HeadsetPanel {
  EyePose pose;
  glm::dvec2 size{0.0};            // [m]
  glm::dvec2 low{0.0}, high{1.0};  // [1] of the picture, from its upper left corner
};

class HeadsetSession {
 public:
  // Both outlive it. Throws HeadsetError, HeadsetLost.
  HeadsetSession(HeadsetRuntime& runtime, Gpu& gpu, const HeadsetConfig& config);
  ~HeadsetSession();  // waits until the device is idle

  // What the runtime has told since the last poll: the session begins and ends as it asks. While a frame is waited for
  // nothing is taken. Throws HeadsetLost.
  void poll();
  HeadsetState state() const noexcept;
  bool awaits() const noexcept;              // a frame that wait() has not got yet: the end waits for it
  bool runs() const noexcept;                // frames are wanted: wait() paces them
  const HeadsetEyes& eyes() const noexcept;  // as they were located last; before that, side by side at the origin
  bool is_stage() const noexcept;            // poses are in a room that stays from one day to the next

  // Until the runtime wants the next frame, which it begins. None: it does not want one yet, the waiting goes on beside
  // us, and the next call takes it up. A runtime may hold a frame back for as long as it likes. Throws HeadsetLost.
  std::optional<HeadsetFrame> wait(std::chrono::milliseconds patience);
  HeadsetEyes locate(const HeadsetFrame& frame);
  std::array<HeadsetHand, 2> hands(const HeadsetFrame& frame);        // left, right; none while not focused
  std::optional<SpaceChange> take_change(const HeadsetFrame& frame);  // once its time has come

  // The images of this frame, null where the runtime has none now (depth and panel also where there are none). Copied
  // into between take and ready_to_give(), which is recorded; given back with end(), after the submission.
  struct Images {
    GpuImage *colour = nullptr, *depth = nullptr, *panel = nullptr;
  };
  Images take_images(bool panel);
  void ready_to_give(VkCommandBuffer commands);

  // Shows what was drawn, from where it was drawn; null: nothing. near_plane [m]: of the depth's projection.
  void end(const HeadsetFrame& frame, const HeadsetEyes* eyes, double near_plane, const HeadsetPanel* panel);

  std::int64_t now_ns() const;  // [ns] on the runtime's clock; 0 where it is not told

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gearshift
