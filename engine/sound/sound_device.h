// An OpenAL device with its context: a sound card, or memory.
#pragma once

#include <AL/alc.h>

#include <memory>
#include <span>

#include "engine/sound/sound_world.h"

namespace gearshift::engine {

class SoundDevice {
 public:
  // `output`: SoundOutput::card, or SoundOutput::memory, which renders stereo floats at kSoundRate. Throws
  // std::runtime_error with a short reason if the device cannot be opened.
  explicit SoundDevice(SoundOutput output);
  virtual ~SoundDevice() = default;
  SoundDevice(const SoundDevice&) = delete;
  SoundDevice& operator=(const SoundDevice&) = delete;

  virtual bool connected() const;  // false after the card was unplugged or its server ended
  void make_current() const;
  void render(std::span<float> stereo);  // only for SoundOutput::memory

 private:
  struct Close {
    void operator()(ALCdevice* device) const { alcCloseDevice(device); }
    void operator()(ALCcontext* context) const;
  };
  std::unique_ptr<ALCdevice, Close> device_;
  std::unique_ptr<ALCcontext, Close> context_;  // must be destroyed before the device
  void (*render_samples_)(ALCdevice*, void*, ALCsizei) = nullptr;
};

}  // namespace gearshift::engine
