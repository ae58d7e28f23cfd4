// A file whose poll() events can be controlled: a pseudo-terminal whose output is stopped. usbfs signals a completed
// transfer with POLLOUT and a disconnect with POLLERR; a plain file would always report POLLOUT, and libusb would never
// sleep.
#pragma once

#include <string>

namespace gearshift::test {

class HeldTerminal {
 public:
  HeldTerminal();  // starts as not writable; throws std::runtime_error
  ~HeldTerminal();
  HeldTerminal(const HeldTerminal&) = delete;
  HeldTerminal& operator=(const HeldTerminal&) = delete;

  const std::string& path() const noexcept { return path_; }
  void set_writable(bool writable) noexcept;
  void hang_up() noexcept;  // then poll() reports POLLERR to everyone who has the terminal open

 private:
  std::string path_;
  int master_ = -1, slave_ = -1;
  bool writable_ = true;
};

}  // namespace gearshift::test
