// Sounds in space. To the sound card, or rendered to memory; without either it is silent and everything goes on.
// All worlds of a program belong to one thread: OpenAL has one current context for the process.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace gearshift {

class SoundDevice;

inline constexpr int kSoundRate = 48000;  // [Hz]
inline constexpr float kSoundReferenceDistance =
    0.5f;                                  // [m] up to here at full gain; beyond it gain falls as 1/distance
inline constexpr int kOneShotVoices = 24;  // at a time

using ClipId = int;   // what is played
using VoiceId = int;  // one that plays

struct Voice {
  glm::vec3 position{0.0f};  // [m] world
  float gain = 1.0f;         // [1] 0 to 1
  float pitch = 1.0f;        // [1] 0.25 to 4, of the clip's own
  float radius = 0.0f;  // [m] >= 0 of the source. A point beside the listener is heard with one ear, a wide one not
};

enum class SoundOutput { card, memory, none };

// Opens what is asked for (card or memory) or throws std::runtime_error with the reason in a few words.
using SoundDeviceOpener = std::function<std::unique_ptr<SoundDevice>(SoundOutput)>;

class SoundWorld {
 public:
  // card: falls back to none where there is no card, and says why. memory: for tests and films, by render().
  explicit SoundWorld(SoundOutput output);
  SoundWorld(SoundOutput output, SoundDeviceOpener open);  // by another opener: a test's device can be lost
  ~SoundWorld();
  SoundWorld(const SoundWorld&) = delete;
  SoundWorld& operator=(const SoundWorld&) = delete;

  SoundOutput output() const noexcept;             // what it really is, now
  const std::string& why_silent() const noexcept;  // empty while there is sound

  // Mono samples in [-1, 1] at kSoundRate. Valid for ever.
  ClipId add_clip(std::span<const float> samples);

  // What is out of range is clamped, what is no number is 0; an id that was never given throws std::out_of_range.
  void set_listener(glm::vec3 position, glm::vec3 forward, glm::vec3 up);
  void set_volume(float gain);                    // [1] 0 to 1, of all
  void play(ClipId clip, const Voice& voice);     // once; the oldest one gives way beyond 24 at a time
  VoiceId loop(ClipId clip, const Voice& voice);  // until the end of the world
  void set(VoiceId voice, const Voice& to);
  void restart(VoiceId voice);  // from the clip's first sample

  // Once a frame: notices a lost device and tries to get it back (at most once a second). Never throws.
  // What was asked of loops and listener since the last update or render takes effect here, all at the same sample:
  // loops that start together and keep one pitch stay in phase.
  void update(double time);  // [s]

  // memory only: the next frames, interleaved stereo floats. Not limited: the sum of voices can pass 1. Else silence.
  void render(std::span<float> stereo);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gearshift
