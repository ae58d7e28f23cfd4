#include "engine/sound/sound_device.h"

#include <AL/alext.h>
#include <fcntl.h>
#include <unistd.h>

#include <stdexcept>

namespace gearshift::engine {

namespace {

// Redirects stderr to /dev/null during its lifetime, because without a sound card, ALSA and OpenAL print ten lines to
// stderr, and again at each attempt to reopen a lost device. This output can be turned off only by linking ALSA.
class QuietStderr {
 public:
  QuietStderr() : saved_stderr_(dup(STDERR_FILENO)) {
    const int null_device = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (saved_stderr_ >= 0 && null_device >= 0) dup2(null_device, STDERR_FILENO);
    if (null_device >= 0) close(null_device);
  }
  ~QuietStderr() {
    if (saved_stderr_ < 0) return;
    dup2(saved_stderr_, STDERR_FILENO);
    close(saved_stderr_);
  }
  QuietStderr(const QuietStderr&) = delete;
  QuietStderr& operator=(const QuietStderr&) = delete;

 private:
  int saved_stderr_;
};

template <typename Function>
Function alc_function(const char* name) {
  return reinterpret_cast<Function>(alcGetProcAddress(nullptr, name));
}

ALCdevice* open_card() {
  const QuietStderr quiet;
  return alcOpenDevice(nullptr);
}

ALCdevice* open_memory() {
  if (alcIsExtensionPresent(nullptr, "ALC_SOFT_loopback") == ALC_FALSE) return nullptr;
  const auto open = alc_function<LPALCLOOPBACKOPENDEVICESOFT>("alcLoopbackOpenDeviceSOFT");
  return open != nullptr ? open(nullptr) : nullptr;
}

// On a sound card, the driver decides about headphones (HRTF) and limits the volume. The memory device renders the
// plain stereo sum, which is the same on every machine and linear, so that it can be measured.
ALCcontext* make_context(ALCdevice* device, SoundOutput output) {
  static constexpr ALCint card[] = {ALC_FREQUENCY, kSoundRate, 0};
  static constexpr ALCint memory[] = {ALC_FREQUENCY,
                                      kSoundRate,
                                      ALC_FORMAT_CHANNELS_SOFT,
                                      ALC_STEREO_SOFT,
                                      ALC_FORMAT_TYPE_SOFT,
                                      ALC_FLOAT_SOFT,
                                      ALC_HRTF_SOFT,
                                      ALC_FALSE,
                                      ALC_OUTPUT_LIMITER_SOFT,
                                      ALC_FALSE,
                                      0};
  return alcCreateContext(device, output == SoundOutput::card ? card : memory);
}

}  // namespace

void SoundDevice::Close::operator()(ALCcontext* context) const {
  if (alcGetCurrentContext() == context) alcMakeContextCurrent(nullptr);
  alcDestroyContext(context);
}

SoundDevice::SoundDevice(SoundOutput output) {
  const bool is_card = output == SoundOutput::card;
  device_.reset(is_card ? open_card() : open_memory());
  if (!device_) throw std::runtime_error(is_card ? "there is no sound card" : "OpenAL cannot render to memory");
  context_.reset(make_context(device_.get(), output));
  if (!context_) throw std::runtime_error("the sound device does not support stereo at 48 kHz");
  if (!is_card) render_samples_ = alc_function<LPALCRENDERSAMPLESSOFT>("alcRenderSamplesSOFT");
}

bool SoundDevice::connected() const {
  if (alcIsExtensionPresent(device_.get(), "ALC_EXT_disconnect") == ALC_FALSE) return true;
  ALCint connected = ALC_TRUE;
  alcGetIntegerv(device_.get(), ALC_CONNECTED, 1, &connected);
  return connected != ALC_FALSE;
}

void SoundDevice::make_current() const {
  if (alcGetCurrentContext() != context_.get()) alcMakeContextCurrent(context_.get());
}

void SoundDevice::render(std::span<float> stereo) {
  render_samples_(device_.get(), stereo.data(), static_cast<ALCsizei>(stereo.size() / 2));
}

}  // namespace gearshift::engine
