#include "engine/xr/headset_session.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <mutex>
#include <vector>

#include "engine/xr/headset_hands.h"
#include "engine/xr/headset_images.h"
#include "engine/xr/headset_runtime_state.h"

namespace gearshift::engine {
namespace {

// sRGB formats let the runtime filter linear light; 16 bits per channel store linear light directly.
constexpr VkFormat kPictureFormats[] = {VK_FORMAT_R8G8B8A8_SRGB, VK_FORMAT_B8G8R8A8_SRGB,
                                        VK_FORMAT_R16G16B16A16_SFLOAT};
constexpr VkFormat kDepthFormats[] = {VK_FORMAT_D32_SFLOAT};
constexpr double kEyeDistance = 0.063;  // [m] assumed until the runtime has located the eyes
// [ns] longest wait for an eye image; exceeds the frame time of any headset
constexpr XrDuration kEyeImageTimeout = 100'000'000;
constexpr XrDuration kExtraImageTimeout = 5'000'000;  // [ns] longest wait for depth and panel, which are optional

std::vector<XrReferenceSpaceType> spaces_of(XrSession session) {
  return list_of<XrReferenceSpaceType>("xrEnumerateReferenceSpaces", XR_REFERENCE_SPACE_TYPE_VIEW,
                                       [&](std::uint32_t capacity, std::uint32_t* count, XrReferenceSpaceType* items) {
                                         return xrEnumerateReferenceSpaces(session, capacity, count, items);
                                       });
}

// Returns the content of the buffer as an event of the given type.
template <class Event>
const Event& as(const XrEventDataBuffer& buffer) {
  return *reinterpret_cast<const Event*>(&buffer);
}

HeadsetState state_of(XrSessionState state) {
  switch (state) {
    case XR_SESSION_STATE_READY:
      return HeadsetState::ready;
    case XR_SESSION_STATE_SYNCHRONIZED:
      return HeadsetState::synchronised;
    case XR_SESSION_STATE_VISIBLE:
      return HeadsetState::visible;
    case XR_SESSION_STATE_FOCUSED:
      return HeadsetState::focused;
    case XR_SESSION_STATE_STOPPING:
      return HeadsetState::stopping;
    case XR_SESSION_STATE_EXITING:
      return HeadsetState::exiting;
    default:
      return HeadsetState::idle;
  }
}

}  // namespace

std::string_view to_string(HeadsetState state) noexcept {
  constexpr std::string_view kNames[] = {"idle", "ready", "synchronised", "visible", "focused", "stopping", "exiting"};
  return kNames[static_cast<std::size_t>(state)];
}

struct HeadsetSession::State {
  State(HeadsetRuntime& runtime, Gpu& device, const HeadsetConfig& config);
  ~State();
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  void make_session();
  void leave() noexcept;
  XrSpace make_space(XrReferenceSpaceType type) const;
  void make_images(const HeadsetConfig& config);
  void make_depth(const HeadsetConfig& config);
  void handle_event(const XrEventDataBuffer& event);
  void handle_state(XrSessionState next);
  void queue_space_change(const XrEventDataReferenceSpaceChangePending& change);
  void update_eyes(const XrView* views, XrViewStateFlags flags);
  void move_last_eyes(const EyePose& new_from_old);
  std::int64_t runtime_time(const timespec& monotonic) const;

  struct Pending {
    XrTime at;
    SpaceChange change;
  };

  const HeadsetRuntime::State& xr;
  Gpu& gpu;
  XrSession session = XR_NULL_HANDLE;
  XrReferenceSpaceType space_type = XR_REFERENCE_SPACE_TYPE_LOCAL;
  XrSpace space = XR_NULL_HANDLE;
  std::unique_ptr<HeadsetImages> colour, depth, panel;
  std::unique_ptr<HeadsetHands> hands;
  PFN_xrConvertTimespecTimeToTimeKHR to_runtime_time = nullptr;
  HeadsetState state = HeadsetState::idle;
  std::optional<bool> is_present;
  bool is_running = false;
  bool depth_of_frame = false;             // depth was written for this frame
  HeadsetEyes eyes;                        // as last located
  std::array<XrPosef, 2> located{};        // the same as the runtime gave it
  glm::dvec3 eye_midpoint{0.0};            // [m] midpoint between the eyes
  std::array<glm::dvec3, 2> eye_offset{};  // [m] offset of each eye from the midpoint, in head space
  std::vector<Pending> pending;
  std::atomic<bool> is_waiting{false};
};

HeadsetSession::State::State(HeadsetRuntime& runtime, Gpu& device, const HeadsetConfig& config)
    : xr(*runtime.state_), gpu(device) {
  make_session();
  try {
    const auto offered = spaces_of(session);
    const bool stage = std::find(offered.begin(), offered.end(), XR_REFERENCE_SPACE_TYPE_STAGE) != offered.end();
    space_type = stage ? XR_REFERENCE_SPACE_TYPE_STAGE : XR_REFERENCE_SPACE_TYPE_LOCAL;
    space = make_space(space_type);
    make_images(config);
    hands = std::make_unique<HeadsetHands>(xr.instance, session, xr.extensions);
    if (xr.timespec)
      to_runtime_time = load<PFN_xrConvertTimespecTimeToTimeKHR>(xr.instance, "xrConvertTimespecTimeToTimeKHR");
  } catch (...) {
    hands.reset();
    colour.reset();
    depth.reset();
    panel.reset();
    xrDestroySession(session);  // also destroys its spaces
    throw;
  }
  for (std::size_t eye = 0; eye < 2; ++eye) {
    eye_offset[eye] = {(eye == 0 ? -0.5 : 0.5) * kEyeDistance, 0.0, 0.0};
    eyes.pose[eye].position = eye_offset[eye];
    eyes.fov[eye] = symmetric_fov(1.5, static_cast<double>(config.eye.x) / config.eye.y);
  }
}

// Ends a running session as OpenXR asks for, so that the runtime shows its own room at once and not a frozen picture. A
// lost session only fails.
void HeadsetSession::State::leave() noexcept {
  constexpr int kMaxFrames = 30;
  if (!is_running || XR_FAILED(xrRequestExitSession(session))) return;
  for (int i = 0; i < kMaxFrames && is_running; ++i) {
    XrEventDataBuffer event{XR_TYPE_EVENT_DATA_BUFFER};
    const XrResult polled = xrPollEvent(xr.instance, &event);
    if (XR_FAILED(polled)) return;
    const bool is_end = polled == XR_SUCCESS && event.type == XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED &&
                        as<XrEventDataSessionStateChanged>(event).state == XR_SESSION_STATE_STOPPING;
    if (is_end) is_running = XR_FAILED(xrEndSession(session));
    if (polled != XR_EVENT_UNAVAILABLE) continue;
    XrFrameState frame{XR_TYPE_FRAME_STATE};
    XrFrameEndInfo end{XR_TYPE_FRAME_END_INFO};
    if (XR_FAILED(xrWaitFrame(session, nullptr, &frame)) || XR_FAILED(xrBeginFrame(session, nullptr))) return;
    end.displayTime = frame.predictedDisplayTime;
    end.environmentBlendMode = xr.blend;
    if (XR_FAILED(xrEndFrame(session, &end))) return;
  }
}

HeadsetSession::State::~State() {
  const std::lock_guard lock(gpu.queue_mutex());
  leave();
  gpu.wait_idle();  // because frames in flight may still write to the runtime's images
  hands.reset();
  colour.reset();
  depth.reset();
  panel.reset();
  xrDestroySpace(space);
  xrDestroySession(session);
}

void HeadsetSession::State::make_session() {
  XrGraphicsBindingVulkan2KHR binding{XR_TYPE_GRAPHICS_BINDING_VULKAN2_KHR};
  binding.instance = gpu.instance();
  binding.physicalDevice = gpu.physical();
  binding.device = gpu.device();
  binding.queueFamilyIndex = gpu.queue_family();
  XrSessionCreateInfo info{XR_TYPE_SESSION_CREATE_INFO};
  info.next = &binding;
  info.systemId = xr.system;
  check(xrCreateSession(xr.instance, &info, &session), "xrCreateSession");
}

XrSpace HeadsetSession::State::make_space(XrReferenceSpaceType type) const {
  XrReferenceSpaceCreateInfo info{XR_TYPE_REFERENCE_SPACE_CREATE_INFO};
  info.referenceSpaceType = type;
  info.poseInReferenceSpace = xr_pose({});
  XrSpace created = XR_NULL_HANDLE;
  check(xrCreateReferenceSpace(session, &info, &created), "xrCreateReferenceSpace");
  return created;
}

// Creates the images of eyes, depth and panel. Without depth images the session still works: depth is only used for
// reprojection.
void HeadsetSession::State::make_images(const HeadsetConfig& config) {
  colour = std::make_unique<HeadsetImages>(session, gpu, config.eye, 2, kPictureFormats);
  make_depth(config);
  if (config.panel.x > 0) panel = std::make_unique<HeadsetImages>(session, gpu, config.panel, 1, kPictureFormats);
}

void HeadsetSession::State::make_depth(const HeadsetConfig& config) {
  if (!xr.traits.depth) return;
  try {
    depth = std::make_unique<HeadsetImages>(session, gpu, config.eye, 2, kDepthFormats);
  } catch (const HeadsetLost&) {
    throw;
  } catch (const HeadsetError&) {
  }
}

void HeadsetSession::State::handle_event(const XrEventDataBuffer& event) {
  if (event.type == XR_TYPE_EVENT_DATA_USER_PRESENCE_CHANGED_EXT) {
    const auto& changed = as<XrEventDataUserPresenceChangedEXT>(event);
    if (changed.session == session) is_present = changed.isUserPresent == XR_TRUE;
    return;
  }
  switch (event.type) {
    case XR_TYPE_EVENT_DATA_INSTANCE_LOSS_PENDING:
      throw HeadsetLost("the OpenXR runtime is shutting down");
    case XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED: {
      const auto& changed = as<XrEventDataSessionStateChanged>(event);
      if (changed.session == session) handle_state(changed.state);
      break;
    }
    case XR_TYPE_EVENT_DATA_REFERENCE_SPACE_CHANGE_PENDING: {
      const auto& change = as<XrEventDataReferenceSpaceChangePending>(event);
      if (change.session == session) queue_space_change(change);
      break;
    }
    default:
      break;  // no other event is needed: input is polled each frame
  }
}

void HeadsetSession::State::handle_state(XrSessionState next) {
  state = state_of(next);
  if (next == XR_SESSION_STATE_READY) {
    XrSessionBeginInfo begin{XR_TYPE_SESSION_BEGIN_INFO};
    begin.primaryViewConfigurationType = kTwoEyes;
    check(xrBeginSession(session, &begin), "xrBeginSession");
    is_running = true;
  } else if (next == XR_SESSION_STATE_STOPPING) {
    check(xrEndSession(session), "xrEndSession");
    is_running = false;
  } else if (next == XR_SESSION_STATE_LOSS_PENDING) {
    throw HeadsetLost("the connection to the headset was lost");
  }
}

// The event contains the pose of the new origin relative to the old space; the inverse of this pose converts old to new
// coordinates.
void HeadsetSession::State::queue_space_change(const XrEventDataReferenceSpaceChangePending& event) {
  if (event.referenceSpaceType == XR_REFERENCE_SPACE_TYPE_VIEW) return;
  SpaceChange change;
  change.is_session_space = event.referenceSpaceType == space_type;
  if (event.poseValid == XR_TRUE) change.new_from_old = inverse(pose_of(event.poseInPreviousSpace));
  pending.push_back({event.changeTime, change});
}

// Updates the eyes from the located views. While the head's position or orientation is not tracked, its last value is
// used. Both eyes stay attached to the head.
void HeadsetSession::State::update_eyes(const XrView* views, XrViewStateFlags flags) {
  const bool orientation_valid = (flags & XR_VIEW_STATE_ORIENTATION_VALID_BIT) != 0;
  const bool position_valid = (flags & XR_VIEW_STATE_POSITION_VALID_BIT) != 0;
  std::array<glm::dvec3, 2> at{};
  for (std::size_t eye = 0; eye < 2; ++eye) {
    const Fov fov = fov_of(views[eye].fov);
    if (fov.left < fov.right && fov.down < fov.up) eyes.fov[eye] = fov;
    located[eye] = views[eye].pose;
    if (orientation_valid) eyes.pose[eye].orientation = pose_of({views[eye].pose.orientation, {}}).orientation;
    if (position_valid) at[eye] = {views[eye].pose.position.x, views[eye].pose.position.y, views[eye].pose.position.z};
  }
  const glm::dquat head = glm::slerp(eyes.pose[0].orientation, eyes.pose[1].orientation, 0.5);
  if (position_valid) eye_midpoint = 0.5 * (at[0] + at[1]);
  for (std::size_t eye = 0; eye < 2; ++eye) {
    if (position_valid && orientation_valid) eye_offset[eye] = glm::conjugate(head) * (at[eye] - eye_midpoint);
    eyes.pose[eye].position = position_valid && orientation_valid ? at[eye] : eye_midpoint + head * eye_offset[eye];
  }
  eyes.is_oriented = orientation_valid;
  eyes.is_tracked = orientation_valid && position_valid;
  eyes.is_known = eyes.is_known || eyes.is_tracked;
}

// Converts the last eye poses to the moved tracking space, so that an untracked head stays in place in the room.
void HeadsetSession::State::move_last_eyes(const EyePose& new_from_old) {
  eye_midpoint = new_from_old * eye_midpoint;
  for (EyePose& eye : eyes.pose) eye = new_from_old * eye;
}

HeadsetSession::HeadsetSession(HeadsetRuntime& runtime, Gpu& gpu, const HeadsetConfig& config)
    : state_(std::make_unique<State>(runtime, gpu, config)) {}
HeadsetSession::~HeadsetSession() = default;

void HeadsetSession::poll() {
  State& s = *state_;
  while (true) {
    XrEventDataBuffer event{XR_TYPE_EVENT_DATA_BUFFER};
    const XrResult result = xrPollEvent(s.xr.instance, &event);
    check(result, "xrPollEvent");
    if (result == XR_EVENT_UNAVAILABLE) return;
    s.handle_event(event);
  }
}

HeadsetState HeadsetSession::state() const noexcept {
  return state_->state;
}

bool HeadsetSession::is_waiting() const noexcept {
  return state_->is_waiting;
}

std::optional<bool> HeadsetSession::is_present() const noexcept {
  return state_->is_present;
}

bool HeadsetSession::is_running() const noexcept {
  return state_->is_running;
}

const HeadsetEyes& HeadsetSession::eyes() const noexcept {
  return state_->eyes;
}

bool HeadsetSession::is_stage() const noexcept {
  return state_->space_type == XR_REFERENCE_SPACE_TYPE_STAGE;
}

std::int64_t HeadsetSession::now_ns() const {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return state_->runtime_time(now);
}

std::int64_t HeadsetSession::State::runtime_time(const timespec& monotonic) const {
  if (to_runtime_time == nullptr) return 0;
  XrTime time = 0;
  check(to_runtime_time(xr.instance, &monotonic, &time), "xrConvertTimespecTimeToTimeKHR");
  return time;
}

HeadsetFrame HeadsetSession::wait() {
  State& s = *state_;
  XrFrameState frame_state{XR_TYPE_FRAME_STATE};
  s.is_waiting = true;
  const XrResult result = xrWaitFrame(s.session, nullptr, &frame_state);
  s.is_waiting = false;
  timespec ended{};
  clock_gettime(CLOCK_MONOTONIC, &ended);
  check(result, "xrWaitFrame");
  HeadsetFrame frame;
  frame.wait_end_ns = s.runtime_time(ended);
  s.hands->sync();
  {
    const std::lock_guard lock(s.gpu.queue_mutex());
    check(xrBeginFrame(s.session, nullptr), "xrBeginFrame");
  }
  frame.display_ns = frame_state.predictedDisplayTime;
  frame.period = 1e-9 * static_cast<double>(frame_state.predictedDisplayPeriod);
  frame.should_render = frame_state.shouldRender == XR_TRUE;
  return frame;
}

HeadsetEyes HeadsetSession::locate(const HeadsetFrame& frame) {
  State& s = *state_;
  XrViewLocateInfo info{XR_TYPE_VIEW_LOCATE_INFO};
  info.viewConfigurationType = kTwoEyes;
  info.displayTime = frame.display_ns;
  info.space = s.space;
  XrViewState view_state{XR_TYPE_VIEW_STATE};
  XrView views[2] = {{XR_TYPE_VIEW}, {XR_TYPE_VIEW}};
  std::uint32_t count = 0;
  check(xrLocateViews(s.session, &info, &view_state, 2, &count, views), "xrLocateViews");
  if (count == 2) s.update_eyes(views, view_state.viewStateFlags);
  return s.eyes;
}

std::array<HeadsetHand, 2> HeadsetSession::hands(const HeadsetFrame& frame) {
  return state_->hands->read(state_->space, frame.display_ns);
}

std::optional<SpaceChange> HeadsetSession::take_due_space_change(const HeadsetFrame& frame) {
  auto& pending = state_->pending;
  if (pending.empty() || frame.display_ns < pending.front().at) return std::nullopt;
  const SpaceChange change = pending.front().change;
  pending.erase(pending.begin());
  if (change.is_session_space && change.new_from_old && !state_->eyes.is_tracked)
    state_->move_last_eyes(*change.new_from_old);
  return change;
}

HeadsetSession::Images HeadsetSession::acquire_images(bool with_panel) {
  State& s = *state_;
  const std::lock_guard lock(s.gpu.queue_mutex());
  Images images;
  images.colour = s.colour->acquire(kEyeImageTimeout);
  if (!images.colour) return {};  // the caller then draws nothing
  if (s.depth) images.depth = s.depth->acquire(kExtraImageTimeout);
  if (with_panel && s.panel) images.panel = s.panel->acquire(kExtraImageTimeout);
  s.depth_of_frame = images.depth != nullptr;
  return images;
}

void HeadsetSession::transition_for_release(VkCommandBuffer commands) {
  for (const auto* images : {&state_->colour, &state_->depth, &state_->panel})
    if (*images) (*images)->transition_for_release(commands);
}

namespace {

using LayerHeader = const XrCompositionLayerBaseHeader*;

// Composition layers of one frame. OpenXR's structures point at each other, so the object must not be moved.
struct Layers {
  std::array<XrCompositionLayerDepthInfoKHR, 2> depth;
  std::array<XrCompositionLayerProjectionView, 2> views;
  XrCompositionLayerProjection picture{XR_TYPE_COMPOSITION_LAYER_PROJECTION};
  XrCompositionLayerQuad panel{XR_TYPE_COMPOSITION_LAYER_QUAD};
  std::vector<LayerHeader> all;
  Layers() = default;
  Layers(const Layers&) = delete;
  Layers& operator=(const Layers&) = delete;

  // `located`: poses as the runtime gave them, one of which is submitted unchanged where a picture was drawn from it.
  void add_picture(XrSpace space, const HeadsetEyes& eyes, const std::array<XrPosef, 2>& located,
                   const HeadsetImages& images) {
    for (std::uint32_t eye = 0; eye < 2; ++eye) {
      views[eye] = {XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW};
      const EyePose same = pose_of(located[eye]);
      const bool is_same = same.position == eyes.pose[eye].position && same.orientation == eyes.pose[eye].orientation;
      views[eye].pose = is_same ? located[eye] : xr_pose(eyes.pose[eye]);
      views[eye].fov = xr_fov(eyes.fov[eye]);
      views[eye].subImage = images.layer(eye);
    }
    picture.space = space;
    picture.viewCount = 2;
    picture.views = views.data();
    all.push_back(reinterpret_cast<LayerHeader>(&picture));
  }

  // Depth is near plane / distance: 0 is infinity, 1 is the near plane.
  void add_depth(const HeadsetImages& images, double near_plane) {
    for (std::uint32_t eye = 0; eye < 2; ++eye) {
      depth[eye] = {XR_TYPE_COMPOSITION_LAYER_DEPTH_INFO_KHR};
      depth[eye].subImage = images.layer(eye);
      depth[eye].minDepth = 0.0f;
      depth[eye].maxDepth = 1.0f;
      depth[eye].nearZ = std::numeric_limits<float>::infinity();
      depth[eye].farZ = static_cast<float>(near_plane);
      views[eye].next = &depth[eye];
    }
  }

  // The panel's colours are already multiplied by their alpha.
  void add_panel(XrSpace space, const HeadsetPanel& placement, const HeadsetImages& images) {
    panel.layerFlags = XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT;
    panel.space = space;
    panel.eyeVisibility = XR_EYE_VISIBILITY_BOTH;
    panel.subImage = images.layer(0);
    const glm::dvec2 size(images.size());
    const glm::ivec2 low(placement.low * size), high(placement.high * size);
    panel.subImage.imageRect = {{low.x, low.y}, {std::max(1, high.x - low.x), std::max(1, high.y - low.y)}};
    panel.pose = xr_pose(placement.pose);
    panel.size = {static_cast<float>(placement.size.x), static_cast<float>(placement.size.y)};
    all.push_back(reinterpret_cast<LayerHeader>(&panel));
  }
};

}  // namespace

void HeadsetSession::end(const HeadsetFrame& frame, const HeadsetEyes* eyes, double near_plane,
                         const HeadsetPanel* panel) {
  State& s = *state_;
  const std::lock_guard lock(s.gpu.queue_mutex());
  for (const auto* images : {&s.colour, &s.depth, &s.panel})
    if (*images) (*images)->release();
  Layers layers;
  if (eyes != nullptr && s.colour->has_been_released()) layers.add_picture(s.space, *eyes, s.located, *s.colour);
  if (eyes != nullptr && s.depth_of_frame) layers.add_depth(*s.depth, near_plane);
  if (panel != nullptr && s.panel && s.panel->has_been_released()) layers.add_panel(s.space, *panel, *s.panel);
  XrFrameEndInfo info{XR_TYPE_FRAME_END_INFO};
  info.displayTime = frame.display_ns;
  info.environmentBlendMode = s.xr.blend;
  info.layerCount = static_cast<std::uint32_t>(layers.all.size());
  info.layers = layers.all.data();
  s.depth_of_frame = false;
  check(xrEndFrame(s.session, &info), "xrEndFrame");
}

}  // namespace gearshift::engine
