#include "engine/sound/sound_world.h"

#include <AL/al.h>
#include <AL/alext.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <utility>

#include "engine/sound/sound_device.h"

namespace gearshift::engine {

struct SoundClip {
  std::vector<float> samples;
  ALuint buffer = 0;
};

struct SoundLoop {
  ClipId clip = 0;
  Voice voice;
  ALuint source = 0;  // 0: the device had no free source
  bool changed = true, starts = true;
};

struct SoundOneShot {
  ALuint source = 0;
  std::uint64_t number = 0;  // number of the play() call; the smallest is the oldest
};

struct SoundListener {
  glm::vec3 position{0.0f}, forward{0.0f, 0.0f, -1.0f}, up{0.0f, 1.0f, 0.0f};
  float volume = 1.0f;
};

namespace {

constexpr double kRetryPeriod = 1.0;  // [s] between attempts to reopen a lost device

float clamp_or_low(float value, float low, float high) {
  return std::isnan(value) ? low : std::clamp(value, low, high);
}

bool is_finite(glm::vec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void write_voice(ALuint source, const Voice& voice) {
  if (is_finite(voice.position)) alSource3f(source, AL_POSITION, voice.position.x, voice.position.y, voice.position.z);
  alSourcef(source, AL_GAIN, clamp_or_low(voice.gain, 0.0f, 1.0f));
  alSourcef(source, AL_PITCH, clamp_or_low(voice.pitch, 0.25f, 4.0f));
  // Needs AL_EXT_SOURCE_RADIUS; without this extension, every source is a point.
  alSourcef(source, AL_SOURCE_RADIUS, clamp_or_low(voice.radius, 0.0f, 1e3f));
}

void write_listener(const SoundListener& listener) {
  const auto& [position, forward, up, volume] = listener;
  const float orientation[6] = {forward.x, forward.y, forward.z, up.x, up.y, up.z};
  if (is_finite(position)) alListener3f(AL_POSITION, position.x, position.y, position.z);
  if (is_finite(forward) && is_finite(up)) alListenerfv(AL_ORIENTATION, orientation);
  alListenerf(AL_GAIN, clamp_or_low(volume, 0.0f, 1.0f));
}

// Makes a source whose gain is reference / max(reference, distance). Returns 0 if the device has no free source.
ALuint make_source() {
  alGetError();  // clears earlier errors
  ALuint source = 0;
  alGenSources(1, &source);
  if (alGetError() != AL_NO_ERROR) return 0;
  alSourcef(source, AL_REFERENCE_DISTANCE, kSoundReferenceDistance);
  return source;
}

ALuint make_buffer(const std::vector<float>& samples) {
  ALuint buffer = 0;
  alGenBuffers(1, &buffer);
  alBufferData(buffer, AL_FORMAT_MONO_FLOAT32, samples.data(), static_cast<ALsizei>(samples.size() * sizeof(float)),
               kSoundRate);
  return buffer;
}

// All changes made while an object of this type exists reach the mixer at the same sample (AL_SOFT_deferred_updates).
struct DeferredUpdates {
  using Function = void (*)();
  DeferredUpdates() { call("alDeferUpdatesSOFT"); }
  ~DeferredUpdates() { call("alProcessUpdatesSOFT"); }
  static void call(const char* name) {
    if (alIsExtensionPresent("AL_SOFT_deferred_updates") == AL_FALSE) return;
    if (const auto function = reinterpret_cast<Function>(alGetProcAddress(name))) function();
  }
};

std::unique_ptr<SoundDevice> open_device(SoundOutput output) {
  return std::make_unique<SoundDevice>(output);
}

}  // namespace

// The desired sound state, and the device that plays it. The state survives the loss of a device.
struct SoundWorld::State {
  SoundOutput wanted = SoundOutput::none;
  SoundDeviceOpener opener;
  std::unique_ptr<SoundDevice> device;
  std::string silence_reason = "sound is off";
  bool is_lost = false;
  double next_attempt = 0.0;  // [s]

  std::vector<SoundClip> clips;
  std::vector<SoundLoop> loops;
  std::array<SoundOneShot, kOneShotVoices> one_shots;
  std::uint64_t played = 0;
  SoundListener listener;
  bool listener_changed = true;

  void open();
  void mark_lost() noexcept;
  void reopen(double time) noexcept;
  void rebuild();
  void set_up(SoundLoop& loop);
  void apply_changes();
  void start_loops();
  SoundOneShot& next_one_shot();
};

// Opens the device and transfers the state to it. Passes on exceptions of the opener.
void SoundWorld::State::open() {
  device = opener(wanted);
  rebuild();
  silence_reason.clear();
  is_lost = false;
}

void SoundWorld::State::mark_lost() noexcept {
  device.reset();
  is_lost = true;
  silence_reason = "the sound device was lost";
}

void SoundWorld::State::reopen(double time) noexcept {
  next_attempt = std::min(next_attempt, time + kRetryPeriod);  // keeps retrying even if the clock was set back
  if (time < next_attempt) return;
  next_attempt = time + kRetryPeriod;
  try {
    open();
  } catch (const std::exception&) {
    device.reset();  // silence_reason still says that the device was lost
  }
}

// Transfers the whole state to a new device. Interrupted one-shots are not restarted.
void SoundWorld::State::rebuild() {
  device->make_current();
  alDistanceModel(AL_INVERSE_DISTANCE_CLAMPED);
  for (SoundClip& clip : clips) clip.buffer = make_buffer(clip.samples);
  for (SoundOneShot& shot : one_shots) shot = {make_source(), 0};
  for (SoundLoop& loop : loops) set_up(loop);
  listener_changed = true;
}

void SoundWorld::State::set_up(SoundLoop& loop) {
  loop.source = make_source();
  alSourcei(loop.source, AL_BUFFER, static_cast<ALint>(clips.at(static_cast<std::size_t>(loop.clip)).buffer));
  alSourcei(loop.source, AL_LOOPING, AL_TRUE);
  loop.changed = loop.starts = true;
}

void SoundWorld::State::apply_changes() {
  device->make_current();
  {
    const DeferredUpdates deferred;
    if (std::exchange(listener_changed, false)) write_listener(listener);
    for (SoundLoop& loop : loops) {
      if (std::exchange(loop.changed, false)) write_voice(loop.source, loop.voice);
    }
  }
  start_loops();
}

void SoundWorld::State::start_loops() {
  std::vector<ALuint> sources;
  for (SoundLoop& loop : loops) {
    if (std::exchange(loop.starts, false) && loop.source != 0) sources.push_back(loop.source);
  }
  if (!sources.empty()) alSourcePlayv(static_cast<ALsizei>(sources.size()), sources.data());
}

// Returns a source that has finished, or else the oldest one.
SoundOneShot& SoundWorld::State::next_one_shot() {
  for (SoundOneShot& shot : one_shots) {
    ALint state = AL_STOPPED;
    alGetSourcei(shot.source, AL_SOURCE_STATE, &state);
    if (state != AL_PLAYING) return shot;
  }
  return *std::min_element(one_shots.begin(), one_shots.end(),
                           [](const SoundOneShot& a, const SoundOneShot& b) { return a.number < b.number; });
}

SoundWorld::SoundWorld(SoundOutput output) : SoundWorld(output, open_device) {}

SoundWorld::SoundWorld(SoundOutput output, SoundDeviceOpener open) : state_(std::make_unique<State>()) {
  state_->wanted = output;
  state_->opener = std::move(open);
  if (output == SoundOutput::none) return;
  try {
    state_->open();
  } catch (const std::exception& error) {
    state_->device.reset();
    state_->silence_reason = error.what();
  }
}

SoundWorld::~SoundWorld() = default;

SoundOutput SoundWorld::output() const noexcept {
  return state_->device ? state_->wanted : SoundOutput::none;
}

const std::string& SoundWorld::silence_reason() const noexcept {
  return state_->silence_reason;
}

ClipId SoundWorld::add_clip(std::span<const float> samples) {
  SoundClip& clip = state_->clips.emplace_back();
  clip.samples.assign(samples.begin(), samples.end());
  if (state_->device) {
    state_->device->make_current();
    clip.buffer = make_buffer(clip.samples);
  }
  return static_cast<ClipId>(state_->clips.size()) - 1;
}

void SoundWorld::set_listener(glm::vec3 position, glm::vec3 forward, glm::vec3 up) {
  SoundListener& listener = state_->listener;
  listener = {position, forward, up, listener.volume};
  state_->listener_changed = true;
}

void SoundWorld::set_volume(float gain) {
  state_->listener.volume = gain;
  state_->listener_changed = true;
}

void SoundWorld::play(ClipId clip, const Voice& voice) {
  const ALuint buffer = state_->clips.at(static_cast<std::size_t>(clip)).buffer;
  if (!state_->device) return;
  state_->device->make_current();
  SoundOneShot& shot = state_->next_one_shot();
  shot.number = ++state_->played;
  alSourceStop(shot.source);  // the clip of a playing source cannot be changed
  alSourcei(shot.source, AL_BUFFER, static_cast<ALint>(buffer));
  write_voice(shot.source, voice);
  alSourcePlay(shot.source);
}

VoiceId SoundWorld::loop(ClipId clip, const Voice& voice) {
  static_cast<void>(state_->clips.at(static_cast<std::size_t>(clip)));
  SoundLoop& loop = state_->loops.emplace_back(SoundLoop{clip, voice});
  if (state_->device) {
    state_->device->make_current();
    state_->set_up(loop);
  }
  return static_cast<VoiceId>(state_->loops.size()) - 1;
}

void SoundWorld::set(VoiceId voice, const Voice& to) {
  SoundLoop& loop = state_->loops.at(static_cast<std::size_t>(voice));
  loop.voice = to;
  loop.changed = true;
}

void SoundWorld::restart(VoiceId voice) {
  state_->loops.at(static_cast<std::size_t>(voice)).starts = true;
}

void SoundWorld::update(double time) {
  if (state_->device && !state_->device->connected()) state_->mark_lost();
  if (state_->is_lost) state_->reopen(time);
  if (state_->device) state_->apply_changes();
}

void SoundWorld::render(std::span<float> stereo) {
  if (output() != SoundOutput::memory) {
    std::fill(stereo.begin(), stereo.end(), 0.0f);
    return;
  }
  state_->apply_changes();
  state_->device->render(stereo);
}

}  // namespace gearshift::engine
