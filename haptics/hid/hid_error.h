// Errors of a HID device, each with one printable sentence.
#pragma once

#include <stdexcept>
#include <string>

namespace gearshift::haptics {

class HidError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The device is not connected, or was disconnected.
class HidDisconnected : public HidError {
 public:
  using HidError::HidError;
};

}  // namespace gearshift::haptics
