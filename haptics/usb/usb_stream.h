// One run of HidPort::stream(): transfers in flight, and the loop that waits for whatever comes first of a transfer that
// is done, a wake-up, and the next tick. Nothing is allocated for a report by us; libusb 1.0 allocates its URBs.
#pragma once

#include <poll.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "haptics/hid/hid_port.h"
#include "haptics/hid/report_descriptor.h"
#include "haptics/usb/usb_interface.h"

namespace gearshift {

class UsbStream {
 public:
  UsbStream(libusb_context& context, libusb_device_handle& handle, const UsbInterface& interface,
            const ReportDescriptor& reports, const StreamConfig& config, HidStream& stream);
  ~UsbStream();  // every transfer cancelled and taken back
  UsbStream(const UsbStream&) = delete;
  UsbStream& operator=(const UsbStream&) = delete;

  void run();  // throws HidGone, HidError

 private:
  using Arrival = void (UsbStream::*)(const libusb_transfer&) noexcept;

  // A transfer that is used again and again.
  struct Slot {
    UsbStream* stream = nullptr;
    Arrival arrival = nullptr;
    UsbTransfer transfer;
    std::vector<unsigned char> bytes;
    bool pending = false;
  };
  struct Slots {
    std::array<Slot, 2> in;  // one is always waiting in the controller while the other is looked at
    Slot out, ask;
    std::array<Slot*, 4> all{&in[0], &in[1], &out, &ask};
  };
  // What a pipe did wrong since it last did something right.
  struct Trouble {
    bool stalled = false;          // it waits for being cleared
    bool again = false;            // it is to be tried again
    int stalls = 0;                // cleared since
    std::int64_t first_error = 0;  // [ns] since when there are bus errors; 0: none
    std::int64_t retry = 0;        // [ns] not before
  };
  struct Failure {
    bool gone = false;
    const char* what = "";
  };

  void prepare(Slot& slot, std::size_t bytes, Arrival arrival);
  void fill_input(Slot& slot);
  void submit(Slot& slot) noexcept;
  void cancel_all() noexcept;
  bool any_pending() const noexcept;
  void fail(bool gone, const char* what) noexcept;  // the first one counts
  void throw_failure() const;

  static void LIBUSB_CALL arrived(libusb_transfer* transfer) noexcept;
  void input_arrived(const libusb_transfer& transfer) noexcept;
  void output_arrived(const libusb_transfer& transfer) noexcept;
  void answer_arrived(const libusb_transfer& transfer) noexcept;
  void bus_error(Trouble& pipe, const char* what) noexcept;
  void deliver(std::span<const std::uint8_t> wire) noexcept;

  void look(std::int64_t now) noexcept;  // at all that may be due
  void tend_input(std::int64_t now) noexcept;
  void tend_output(std::int64_t now) noexcept;
  void offer_output(std::int64_t now) noexcept;
  void send(const HidBytes& report) noexcept;
  void ask_if_silent(std::int64_t now) noexcept;
  bool clear(Trouble& pipe, std::uint8_t endpoint, const char* what) noexcept;

  void list_fds();
  std::int64_t next_look(std::int64_t now) const noexcept;
  void wait(std::int64_t until);

  libusb_context& context_;
  libusb_device_handle& handle_;
  const UsbInterface& interface_;
  const ReportDescriptor& reports_;
  StreamConfig config_;
  HidStream& stream_;

  std::unique_ptr<Slots> slots_;
  std::size_t longest_input_ = 0;  // [bytes] on the wire
  std::size_t lever_size_ = 0;     // [bytes] on the wire; 0: there is no such report
  Trouble in_, out_;
  std::optional<Failure> failure_;
  bool leaving_ = false;

  std::int64_t lever_ns_ = 0;  // when the lever was last heard of or asked for
  int silent_stalls_ = 0, silent_timeouts_ = 0;
  std::int64_t output_ns_ = 0;  // when the last output was submitted
  std::int64_t look_ns_ = 0;    // when the stream was last asked for one
  bool woken_ = false;

  std::vector<pollfd> fds_;
  bool fds_changed_ = true;
};

}  // namespace gearshift
