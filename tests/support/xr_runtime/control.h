// Controls the OpenXR test runtime. `Script` is what the runtime plays, `Record` what it has received. The OpenXR
// loader finds the runtime through XR_RUNTIME_JSON. No headset and no display are needed. See README.md.
#pragma once

#include <openxr/openxr.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <numbers>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "engine/image/image.h"

namespace gearshift::xr_test {

struct Pose {
  glm::dvec3 position{0.0};  // [m]
  glm::dquat orientation{1.0, 0.0, 0.0, 0.0};
  bool position_valid = true, orientation_valid = true, tracked = true;
};
inline Pose operator*(const Pose& a, const Pose& b) {
  return {a.position + a.orientation * b.position, a.orientation * b.orientation, a.position_valid && b.position_valid,
          a.orientation_valid && b.orientation_valid, a.tracked && b.tracked};
}
inline Pose inverse(const Pose& a) {
  const glm::dquat back = glm::conjugate(a.orientation);
  return {back * -a.position, back, a.position_valid, a.orientation_valid, a.tracked};
}

inline constexpr double kDegree = std::numbers::pi / 180.0;  // [rad]
inline constexpr double kPeriod = 1.0 / 90.0;                // [s] display period
inline constexpr double kEyeDistance = 0.063;                // [m]

struct Fov {  // [rad], signs as in XrFovf
  double left = 0.0, right = 0.0, up = 0.0, down = 0.0;
};

enum class Space { view = XR_REFERENCE_SPACE_TYPE_VIEW, local, stage, action };
enum class Pacing {
  stepped,  // each xrWaitFrame advances one display period, without sleeping, so results are reproducible
  real,     // sleeps like a compositor; a late frame gets the next free period, and skipped periods count as dropped
};

// Something that happens at a given time of the script.
struct Event {
  enum class Kind {
    focused,       // the program is visible and receives input
    visible,       // the program is visible, but a menu receives the input
    synchronized,  // the program is not visible: shouldRender is false
    stopping,      // the user took the headset off
    ready,         // the user put the headset on again
    loss_pending,  // the session is lost: its calls return XR_ERROR_SESSION_LOST
    instance_loss,
    exit,  // the user closed the program: states STOPPING, IDLE, EXITING
    space_change,
    hidden,  // shouldRender is false for a while, in any state
    absent,  // with `user_presence`: nobody wears the headset; the session's state stays
    present,
    stall,  // xrWaitFrame blocks for some display periods, so that frames are dropped
  };
  double at = 0.0;  // [s] on Script's clock
  Kind kind = Kind::focused;
  double span = 0.0;           // [s] for `hidden`
  int periods = 0;             // for `stall`
  Space space = Space::local;  // for `space_change`: `local` or `stage`
  Pose pose{};                 // for `space_change`: the new origin in the previous space
  int frames_ahead = 3;        // for `space_change`: display periods from the event to the change
};
inline Event change_space(double at, Space space, Pose pose, int frames_ahead = 3) {
  return {at, Event::Kind::space_change, 0.0, 0, space, pose, frames_ahead};
}
inline Event stall(double at, int periods) {
  return {at, Event::Kind::stall, 0.0, periods};
}

struct Failure {
  std::string function{};  // "xrEndFrame"
  XrResult result = XR_ERROR_RUNTIME_FAILURE;
  int nth = 1;  // counted from now, only the nth call fails; 1: the next call
};

// Blocks a call before it does anything, as a runtime whose service is stopped does.
struct Hang {
  std::string function{};
  double at = 0.0;    // [s] on Script's clock: the first call from then on hangs
  double span = 1e9;  // [s]; it also ends with Control::ends_hangs
};

struct Gap {                       // An interruption of head tracking, without poses.
  double from = 0.0, until = 0.0;  // [s]
};

// All times in a script are display times, in seconds since the first xrBeginSession after start(). The clock continues
// across sessions.
struct Script {
  bool headset = true;  // false: xrGetSystem returns XR_ERROR_FORM_FACTOR_UNAVAILABLE
  bool vulkan_enable2 = true, composition_layer_depth = true, convert_timespec_time = true;  // offered extensions
  std::vector<std::string> controllers{};  // extensions of controllers that are offered
  bool user_presence = false;              // offers XR_EXT_user_presence
  bool stage = true;
  Pose stage_origin{.position = {0.0, -1.2, 0.0}};                  // in the initial LOCAL space
  std::uint32_t recommended_width = 320, recommended_height = 240;  // [px] per eye
  std::uint32_t max_width = 4096;                                   // [px]
  std::vector<std::int64_t> colour_formats{43, 50, 37, 44};         // VkFormat: R8G8B8A8 and B8G8R8A8, sRGB first
  std::vector<std::int64_t> depth_formats{126};                     // VkFormat: D32_SFLOAT
  std::array<Fov, 2> fov{Fov{-50 * kDegree, 42 * kDegree, 44 * kDegree, -48 * kDegree},  // left eye
                         Fov{-42 * kDegree, 50 * kDegree, 44 * kDegree, -48 * kDegree}};
  Pacing pacing = Pacing::stepped;
  int polls_before_ready = 0;  // xrPollEvent calls without an event between IDLE and READY
  std::function<Pose(double)> head = [](double) { return Pose{}; };  // pose of the head in the initial LOCAL space
  std::vector<Gap> tracking_gaps{};
  double early_error = 0.0;  // [m] error of the head's x in the first xrLocateViews of each frame
  std::array<std::function<Pose(double)>, 2> aim{head, head};     // left, right controller
  std::map<std::string, std::function<double(double)>> inputs{};  // ["/user/hand/right/input/trigger/value"]
  std::vector<Event> timeline{};
  std::vector<Failure> failures{};
  std::vector<Hang> hangs{};
  bool prints = false;    // each injected failure prints lines to stderr, as client libraries do
  int capture_every = 0;  // records the pixels of every n-th frame; 0: of none. Other data is always recorded.
};

struct DepthRecord {
  bool is_present = false;
  float min_depth = 0.0f, max_depth = 0.0f, near_z = 0.0f, far_z = 0.0f;
  std::vector<float> values{};  // inside the rectangle, rows from the top; empty if not captured
};

struct ViewRecord {
  Pose pose{};  // as submitted, in the space of the layer
  Fov fov{};
  struct Rect {
    int x = 0, y = 0, width = 0, height = 0;  // [px]
  } rect{};
  DepthRecord depth{};
  engine::Image picture{};  // the bytes stored in the rectangle; empty if not captured
};

struct LayerRecord {
  XrStructureType type = XR_TYPE_UNKNOWN;
  XrCompositionLayerFlags flags = 0;
  std::vector<ViewRecord> views{};    // projection layer: left, right; quad layer: one entry, only pose and picture
  float width = 0.0f, height = 0.0f;  // [m] size of a quad layer
};

struct FrameRecord {
  std::uint64_t index = 0;  // number of the xrWaitFrame call, from 0
  double time = 0.0;        // [s] predicted display time on Script's clock
  XrTime display_time = 0;  // [ns] the same on the program's clock
  bool should_render = false;
  int locates = 0;                    // number of xrLocateViews calls before the next xrWaitFrame
  std::vector<LayerRecord> layers{};  // back to front

  const LayerRecord* projection() const { return first(XR_TYPE_COMPOSITION_LAYER_PROJECTION); }
  const LayerRecord* quad() const { return first(XR_TYPE_COMPOSITION_LAYER_QUAD); }

 private:
  const LayerRecord* first(XrStructureType type) const {
    for (const LayerRecord& layer : layers) {
      if (layer.type == type) return &layer;
    }
    return nullptr;
  }
};

struct Rule {  // a check that the runtime makes itself
  const char* id;
  XrResult result;  // result of a call that violates the rule
  const char* law;
};

struct Record {
  std::vector<FrameRecord> frames{};
  std::vector<std::string> violations{};  // one line each
  int leaks = 0;                          // handles destroyed with their parent, not by a call
  int live_handles = 0;                   // of all kinds
  std::set<std::string> profiles{};       // for which bindings were suggested and accepted
  std::map<std::string, int> calls{};
  std::uint64_t dropped = 0;  // number of display periods without a new frame
  XrSessionState state = XR_SESSION_STATE_UNKNOWN;
};

struct Control {
  Script script;  // may be changed in a session: poses, inputs, timeline, failures, capture_every, headset
  Record record;
  std::atomic<int> hanging{0};          // calls that hang now
  std::atomic<bool> ends_hangs{false};  // true: no call hangs any more
  std::span<const Rule> rules{};
  void (*restart)(Control&) = nullptr;
  Script (*read_script)(const char* file) = nullptr;  // reads a script file; throws std::runtime_error

  // Sets a new script and clears the record. Call before xrCreateInstance.
  void start(Script next = Script()) {
    script = std::move(next);
    restart(*this);
  }
};

// Loads the runtime, and sets the environment so that the OpenXR loader finds it and puts Khronos' validation layer in
// front of it. Each call returns the same object. Throws std::runtime_error. Defined in the library xr_test_control.
Control& control();

// Returns what Khronos' validation layer and the runtime found wrong with the program's calls since the last
// complaints(), one line each. Defined in the library xr_test_control.
std::string complaints();

}  // namespace gearshift::xr_test
