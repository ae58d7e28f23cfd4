// One run of HidPort::stream(): asynchronous transfers, and a loop that waits for a completed transfer, a wake-up or
// the next tick. The stream allocates nothing per report, but libusb 1.0 allocates URBs.
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

namespace gearshift::haptics {

class UsbStream {
 public:
  UsbStream(libusb_context& context, libusb_device_handle& handle, const UsbInterface& interface,
            const ReportDescriptor& reports, const StreamConfig& config, HidStream& stream);
  ~UsbStream();  // cancels all transfers and waits until they have ended
  UsbStream(const UsbStream&) = delete;
  UsbStream& operator=(const UsbStream&) = delete;

  void run();  // throws HidDisconnected, HidError

 private:
  using Arrival = void (UsbStream::*)(const libusb_transfer&) noexcept;

  // A reusable transfer.
  struct Slot {
    UsbStream* stream = nullptr;
    Arrival arrival = nullptr;
    UsbTransfer transfer;
    std::vector<unsigned char> bytes;
    bool pending = false;
  };
  struct Slots {
    std::array<Slot, 2> in;  // one transfer is pending in the controller while the other is processed
    Slot out, request;
    std::array<Slot*, 4> all{&in[0], &in[1], &out, &request};
  };
  // Errors of a pipe since its last successful transfer.
  struct PipeErrors {
    bool stalled = false;          // must be cleared
    bool resend = false;           // the transfer must be submitted again
    int stalls = 0;                // number of stalls cleared
    std::int64_t first_error = 0;  // [ns] time of the first bus error; 0: none
    std::int64_t retry = 0;        // [ns] earliest time of the next attempt
  };
  struct Failure {
    bool disconnected = false;
    const char* what = "";
  };

  void prepare(Slot& slot, std::size_t bytes, Arrival arrival);
  void fill_input(Slot& slot);
  void submit(Slot& slot) noexcept;
  void cancel_all() noexcept;
  bool any_pending() const noexcept;
  void fail(bool disconnected, const char* what) noexcept;  // only the first call has an effect
  void throw_failure() const;

  static void LIBUSB_CALL arrived(libusb_transfer* transfer) noexcept;
  void input_arrived(const libusb_transfer& transfer) noexcept;
  void output_arrived(const libusb_transfer& transfer) noexcept;
  void answer_arrived(const libusb_transfer& transfer) noexcept;
  void bus_error(PipeErrors& pipe, const char* what) noexcept;
  void deliver(std::span<const std::uint8_t> wire) noexcept;

  void service(std::int64_t now) noexcept;  // does all work that is due
  void service_input(std::int64_t now) noexcept;
  void service_output(std::int64_t now) noexcept;
  void offer_output(std::int64_t now) noexcept;
  void send(const HidBytes& report) noexcept;
  void request_if_silent(std::int64_t now) noexcept;
  bool clear(PipeErrors& pipe, std::uint8_t endpoint, const char* what) noexcept;

  void list_fds();
  std::int64_t next_service_ns(std::int64_t now) const noexcept;
  void wait(std::int64_t until);

  libusb_context& context_;
  libusb_device_handle& handle_;
  const UsbInterface& interface_;
  const ReportDescriptor& reports_;
  StreamConfig config_;
  HidStream& stream_;

  std::unique_ptr<Slots> slots_;
  std::size_t longest_input_ = 0;  // [bytes] size of the longest input report on the wire
  std::size_t lever_size_ = 0;     // [bytes] size of the lever report on the wire; 0: no such report
  PipeErrors in_, out_;
  std::optional<Failure> failure_;
  bool closing_ = false;

  std::int64_t lever_ns_ = 0;  // [ns] time of the last lever report, or of the last request for one
  int silent_stalls_ = 0, silent_timeouts_ = 0;
  std::int64_t output_ns_ = 0;  // [ns] when the last output was submitted
  std::int64_t polled_ns_ = 0;  // [ns] when next_output() was last called
  bool woken_ = false;

  std::vector<pollfd> fds_;
  bool fds_changed_ = true;
};

}  // namespace gearshift::haptics
