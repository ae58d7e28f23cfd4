// A file whose poll() events can be controlled: a pseudo-terminal whose output is stopped. usbfs signals a completed
// transfer with POLLOUT and a disconnect with POLLERR. A plain file is not suitable: it would always report POLLOUT, so
// libusb would never sleep.
#pragma once

#include <string>

namespace gearshift::test {

class HeldTerminal {
 public:
  HeldTerminal();  // not writable at first; throws std::runtime_error if there is no pseudo-terminal
  ~HeldTerminal();
  HeldTerminal(const HeldTerminal&) = delete;
  HeldTerminal& operator=(const HeldTerminal&) = delete;

  const std::string& path() const noexcept { return path_; }
  void set_writable(bool writable) noexcept;
  void hang_up() noexcept;  // poll() then reports POLLERR to every process that has the terminal open

 private:
  std::string path_;
  int master_ = -1, slave_ = -1;
  bool writable_ = true;
};

}  // namespace gearshift::test
