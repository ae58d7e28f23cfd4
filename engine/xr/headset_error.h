// What a headset can do wrong.
#pragma once

#include <stdexcept>

namespace gearshift {

// One sentence.
struct HeadsetError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// There is a runtime but no headset at it now: try again later.
struct HeadsetAbsent : HeadsetError {
  using HeadsetError::HeadsetError;
};

// Session or runtime are gone: HeadsetSession, HeadsetRuntime and the Gpu that it made must be made anew.
struct HeadsetLost : HeadsetError {
  using HeadsetError::HeadsetError;
};

}  // namespace gearshift
