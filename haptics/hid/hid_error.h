// What a HID device says wrongly or does not do, in one printable sentence.
#pragma once

#include <stdexcept>
#include <string>

namespace gearshift {

class HidError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// It is not there (any more): nothing else of it can be asked.
class HidGone : public HidError {
 public:
  using HidError::HidError;
};

}  // namespace gearshift
