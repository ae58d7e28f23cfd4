// Errors of the headset.
#pragma once

#include <stdexcept>

namespace gearshift::engine {

// The message is one sentence.
struct HeadsetError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// A runtime is present, but no headset is connected: try again later.
struct HeadsetAbsent : HeadsetError {
  using HeadsetError::HeadsetError;
};

// The session or the runtime is lost: HeadsetSession, HeadsetRuntime and the Gpu created through that runtime must be
// recreated.
struct HeadsetLost : HeadsetError {
  using HeadsetError::HeadsetError;
};

}  // namespace gearshift::engine
