// A file whose poll() events can be controlled: a pseudo-terminal with its output stopped. usbfs uses POLLOUT for a
// completed transfer and POLLERR for a disconnect; a plain file would always report POLLOUT, and libusb would never
// sleep.
#pragma once

#include <string>

namespace gearshift::test {

class HeldTerminal {
 public:
  HeldTerminal();  // not writable. Throws std::runtime_error
  ~HeldTerminal();
  HeldTerminal(const HeldTerminal&) = delete;
  HeldTerminal& operator=(const HeldTerminal&) = delete;

  const std::string& path() const noexcept { return path_; }
  void set_writable(bool writable) noexcept;
  void hang_up() noexcept;  // everyone who has it open then gets POLLERR

 private:
  std::string path_;
  int master_ = -1, slave_ = -1;
  bool writable_ = true;
};

}  // namespace gearshift::test
