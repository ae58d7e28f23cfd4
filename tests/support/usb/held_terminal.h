// A file with which poll() can be played: a pseudo-terminal whose output is held. usbfs says by POLLOUT that a transfer is
// done, and by POLLERR that the device is gone; a plain file would always say POLLOUT, and libusb would never sleep.
#pragma once

#include <string>

namespace gearshift {

class HeldTerminal {
 public:
  HeldTerminal();  // not writable. Throws std::runtime_error
  ~HeldTerminal();
  HeldTerminal(const HeldTerminal&) = delete;
  HeldTerminal& operator=(const HeldTerminal&) = delete;

  const std::string& path() const noexcept { return path_; }
  void set_writable(bool writable) noexcept;
  void hang_up() noexcept;  // whoever has it open polls POLLERR from now on

 private:
  std::string path_;
  int master_ = -1, slave_ = -1;
  bool writable_ = true;
};

}  // namespace gearshift
