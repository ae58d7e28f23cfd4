// Positioned sounds, played on the sound card or rendered to memory; without either, everything works silently. All
// SoundWorlds of a program must be used from one thread, because OpenAL has one current context per process.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace gearshift::engine {

class SoundDevice;

inline constexpr int kSoundRate = 48000;                // [Hz]
inline constexpr float kSoundReferenceDistance = 0.5f;  // [m] full gain up to here; beyond it, gain falls as 1/distance
inline constexpr int kOneShotVoices = 24;               // simultaneous one-shots

using ClipId = int;   // a loaded sound
using VoiceId = int;  // a playing loop

struct Voice {
  glm::vec3 position{0.0f};  // [m] world
  float gain = 1.0f;         // [1] 0 to 1
  float pitch = 1.0f;        // [1] 0.25 to 4, relative to the clip
  // [m] radius of the source, at least 0. A point source next to the head is heard in one ear only, a wide source in
  // both.
  float radius = 0.0f;
};

enum class SoundOutput { card, memory, none };

// Opens the given output (card or memory), or throws std::runtime_error with a short reason.
using SoundDeviceOpener = std::function<std::unique_ptr<SoundDevice>(SoundOutput)>;

class SoundWorld {
 public:
  // SoundOutput::card falls back to none if there is no card; see silence_reason(). SoundOutput::memory is for tests
  // and films, which read the sound through render().
  explicit SoundWorld(SoundOutput output);
  SoundWorld(SoundOutput output, SoundDeviceOpener open);  // `open` lets a test simulate the loss of a device
  ~SoundWorld();
  SoundWorld(const SoundWorld&) = delete;
  SoundWorld& operator=(const SoundWorld&) = delete;

  SoundOutput output() const noexcept;                 // the output in use now; none if the device failed or was lost
  const std::string& silence_reason() const noexcept;  // empty while there is sound

  // `samples`: mono, in [-1, 1] at kSoundRate. The returned id stays valid, even if the device is lost.
  ClipId add_clip(std::span<const float> samples);

  // Values out of range are clamped, and NaN becomes the lowest value. An unknown id throws std::out_of_range. This
  // holds for all functions below.
  void set_listener(glm::vec3 position, glm::vec3 forward, glm::vec3 up);
  void set_volume(float gain);                    // [1] 0 to 1, for all sounds
  void play(ClipId clip, const Voice& voice);     // plays once; beyond kOneShotVoices, the oldest is stopped
  VoiceId loop(ClipId clip, const Voice& voice);  // plays for as long as the SoundWorld exists
  void set(VoiceId voice, const Voice& to);
  void restart(VoiceId voice);  // restarts a loop at the clip's first sample

  // Call once per frame. Detects a lost device and tries to reopen it, at most once per second. Never throws. All
  // changes to loops and listener since the last update() or render() take effect here, at the same sample. So loops
  // that start together and keep the same pitch stay in phase.
  void update(double time);  // [s]

  // With SoundOutput::memory, renders the next frames as interleaved stereo floats; the sum of voices is not limited
  // and can exceed 1. With other outputs, writes silence.
  void render(std::span<float> stereo);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gearshift::engine
