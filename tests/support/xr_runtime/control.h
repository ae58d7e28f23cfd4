// Controls the OpenXR test runtime. `Script` is what the runtime simulates, `Record` what it has received. The OpenXR
// loader finds the runtime through XR_RUNTIME_JSON. No headset and no display are needed. See README.md.
#pragma once

#include <openxr/openxr.h>

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <numbers>
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

struct Fov {  // [rad], signs as in XrFovf
  double left = 0.0, right = 0.0, up = 0.0, down = 0.0;
};

enum class Space { view, local, stage, action };
enum class Pacing {
  stepped,  // each xrWaitFrame advances one display period, without sleeping, so results are reproducible
  real,     // sleeps like a compositor; a late frame gets the next free period, and skipped periods count as dropped
};

// Something that happens at a given time of the script. The functions below create events.
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
    profile,  // the controllers changed; an empty profile: no controllers
    hidden,   // shouldRender is false for a while, in any state
    stall,    // xrWaitFrame blocks for some display periods, so that frames are dropped
  };
  double at = 0.0;  // [s] on Script's clock; -1: before the first xrBeginSession
  Kind kind = Kind::focused;
  Space space = Space::local;  // for `space_change`: `local` or `stage`
  Pose pose{};                 // for `space_change`: the new origin in the previous space
  int frames_ahead = 3;        // for `space_change`: display periods from the event to the change
  std::string profile{};
  double span = 0.0;  // [s] for hidden
  int periods = 0;    // for stall
};
inline Event focused(double at) {
  return {.at = at, .kind = Event::Kind::focused};
}
inline Event visible(double at) {
  return {.at = at, .kind = Event::Kind::visible};
}
inline Event synchronized(double at) {
  return {.at = at, .kind = Event::Kind::synchronized};
}
inline Event stopping(double at) {
  return {.at = at, .kind = Event::Kind::stopping};
}
inline Event ready(double at) {
  return {.at = at, .kind = Event::Kind::ready};
}
inline Event lose_session(double at) {
  return {.at = at, .kind = Event::Kind::loss_pending};
}
inline Event lose_instance(double at) {
  return {.at = at, .kind = Event::Kind::instance_loss};
}
inline Event exit(double at) {
  return {.at = at, .kind = Event::Kind::exit};
}
inline Event change_space(double at, Space space, Pose pose, int frames_ahead = 3) {
  return {.at = at, .kind = Event::Kind::space_change, .space = space, .pose = pose, .frames_ahead = frames_ahead};
}
inline Event change_profile(double at, std::string profile) {
  return {.at = at, .kind = Event::Kind::profile, .profile = std::move(profile)};
}
inline Event hidden(double at, double span) {
  return {.at = at, .kind = Event::Kind::hidden, .span = span};
}
inline Event stall(double at, int periods) {
  return {.at = at, .kind = Event::Kind::stall, .periods = periods};
}

struct Failure {
  std::string function{};  // "xrEndFrame"
  XrResult result = XR_ERROR_RUNTIME_FAILURE;
  int nth = 1;  // counted from now, only the nth call fails; 1: the next call
};

struct Hand {
  std::function<Pose(double)> aim = [](double) { return Pose{}; };
  std::function<Pose(double)> grip = [](double) { return Pose{}; };
};

struct Gap {                       // An interruption of head tracking.
  double from = 0.0, until = 0.0;  // [s]
  bool valid = false;              // true: estimated poses; false: no poses
};

struct Capture {                      // Selects the frames whose pixels are recorded; other data is always recorded.
  int every = 0;                      // every n-th frame; 0: none
  std::vector<std::uint64_t> only{};  // also these frames, by FrameRecord::index
  bool depth = true;
};

// All times in a script are display times, in seconds since the first xrBeginSession after start(). The clock continues
// across sessions.
struct Script {
  bool headset = true;  // false: xrGetSystem returns XR_ERROR_FORM_FACTOR_UNAVAILABLE
  bool vulkan_enable2 = true, composition_layer_depth = true, convert_timespec_time = true;  // offered extensions
  bool stage = true;
  Pose stage_origin{.position = {0.0, -1.2, 0.0}};                  // in the initial LOCAL space
  std::uint32_t recommended_width = 320, recommended_height = 240;  // [px] per eye
  std::uint32_t max_width = 4096, max_height = 4096;                // [px]
  std::uint32_t recommended_samples = 1, max_samples = 4;           // [1]
  std::uint32_t images = 3;                                         // per swapchain
  std::vector<std::int64_t> colour_formats{43, 50, 37, 44};         // VkFormat: R8G8B8A8 and B8G8R8A8, sRGB first
  std::vector<std::int64_t> depth_formats{126};                     // VkFormat: D32_SFLOAT
  std::array<Fov, 2> fov{Fov{-50 * kDegree, 42 * kDegree, 44 * kDegree, -48 * kDegree},  // left eye
                         Fov{-42 * kDegree, 50 * kDegree, 44 * kDegree, -48 * kDegree}};
  double eye_distance = 0.063;  // [m]
  double period = 1.0 / 90.0;   // [s] display period
  Pacing pacing = Pacing::stepped;
  int polls_before_ready = 0;  // xrPollEvent calls without an event between IDLE and READY
  std::function<Pose(double)> head = [](double) { return Pose{}; };  // pose of the head in the initial LOCAL space
  std::vector<Gap> tracking_gaps{};
  double early_error = 0.0;     // [m] error of the head's x in the first xrLocateViews of each frame
  std::array<Hand, 2> hands{};  // left, right
  std::string profile = "/interaction_profiles/oculus/touch_controller";
  std::map<std::string, std::function<double(double)>> inputs{};  // ["/user/hand/right/input/trigger/value"]
  std::vector<Event> timeline{};
  std::vector<Failure> failures{};
  Capture capture{};
};

struct Rect {
  int x = 0, y = 0, width = 0, height = 0;  // [px]
};

struct DepthRecord {
  bool is_present = false;
  float min_depth = 0.0f, max_depth = 0.0f, near_z = 0.0f, far_z = 0.0f;
  Rect rect{};
  std::vector<float> values{};  // inside the rectangle, rows from the top; empty if not captured
};

struct ViewRecord {
  Pose pose{};  // as submitted, in the space of the layer
  Fov fov{};
  Rect rect{};
  std::uint32_t layer = 0;  // index in the swapchain's array
  DepthRecord depth{};
  engine::Image picture{};  // the bytes stored in the rectangle; empty if not captured
};

struct LayerRecord {
  XrStructureType type = XR_TYPE_UNKNOWN;
  XrCompositionLayerFlags flags = 0;
  Space space = Space::local;
  std::vector<ViewRecord> views{};    // projection layer: left, right; quad layer: one entry, only pose and picture
  float width = 0.0f, height = 0.0f;  // [m] size of a quad layer
  XrEyeVisibility eyes = XR_EYE_VISIBILITY_BOTH;
};

struct FrameRecord {
  std::uint64_t index = 0;  // number of the xrWaitFrame call, from 0
  double time = 0.0;        // [s] predicted display time on Script's clock
  XrTime display_time = 0;
  bool should_render = false;
  bool discarded = false;  // xrBeginFrame was called again before xrEndFrame
  bool ended = false;
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

struct Rule {
  const char* id;
  XrResult result;      // result of a call that violates the rule; XR_SUCCESS: the call continues
  const char* section;  // heading of a section in the OpenXR 1.0 specification
  const char* law;
};

struct Violation {
  std::string rule{}, function{}, detail{};
};

struct Pulse {  // A call of xrApplyHapticFeedback.
  int hand = 0;
  double seconds = 0.0;  // [s] 0: the shortest pulse of the controller
  float frequency = 0.0f, amplitude = 0.0f;
};

struct Record {
  std::vector<FrameRecord> frames{};
  std::vector<Violation> violations{};
  std::vector<std::string> leaks{};  // handles destroyed with their parent, not by a call, e.g. "space of session"
  std::vector<std::string> log{};    // one line per frame, event, state change, violation
  // Number of live handles by kind: instance, session, swapchain, space, action set, action.
  std::map<std::string, int> live{};
  std::map<std::string, int> calls{};
  std::uint64_t dropped = 0;  // number of display periods without a new frame
  std::vector<Pulse> pulses{};
  XrSessionState state = XR_SESSION_STATE_UNKNOWN;

  int live_handles() const {
    int sum = 0;
    for (const auto& [kind, count] : live) sum += count;
    return sum;
  }
};

struct Control {
  Script script;  // may be changed in a session: poses, inputs, timeline, failures, capture, headset, profile
  Record record;
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

// Returns what Khronos' validation layer and the runtime found wrong with the program's calls since the last complaints(),
// one line each. Defined in the library xr_test_control.
std::string complaints();

}  // namespace gearshift::xr_test
