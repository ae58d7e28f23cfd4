#include "tests/support/usb/held_terminal.h"

#include <fcntl.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

#include <csignal>
#include <stdexcept>
#include <utility>

namespace gearshift::test {

HeldTerminal::HeldTerminal() {
  // libusb opens this pseudo-terminal without O_NOCTTY. If the process is a session leader without a terminal, this one
  // becomes its controlling terminal, and hang_up() would end the process by SIGHUP.
  std::signal(SIGHUP, SIG_IGN);
  master_ = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
  if (master_ < 0 || grantpt(master_) != 0 || unlockpt(master_) != 0) throw std::runtime_error("no pseudo-terminal");
  path_ = ptsname(master_);
  slave_ = open(path_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  if (slave_ < 0) throw std::runtime_error("cannot open " + path_);
  set_writable(false);
}

HeldTerminal::~HeldTerminal() {
  hang_up();
}

void HeldTerminal::set_writable(bool writable) noexcept {
  if (slave_ >= 0 && writable != std::exchange(writable_, writable)) tcflow(slave_, writable ? TCOON : TCOOFF);
}

void HeldTerminal::hang_up() noexcept {
  if (master_ < 0) return;
  close(std::exchange(slave_, -1));
  close(std::exchange(master_, -1));
}

}  // namespace gearshift::test
