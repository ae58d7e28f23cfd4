#include "haptics/usb/usb_stream.h"

#include <sys/prctl.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <string>
#include <utility>

#include "haptics/rt/monotonic_clock.h"
#include "haptics/usb/hid_request.h"

namespace gearshift::haptics {
namespace {

constexpr std::int64_t kMaxErrorTime = 250'000'000;  // [ns] tolerated error time; hubs may report disconnects this late
constexpr std::int64_t kMaxCancelTime = kSecondNs;   // [ns] longest wait for cancelled transfers
constexpr std::size_t kSetup = LIBUSB_CONTROL_SETUP_SIZE;

// Sets the thread's timer slack to 1 ns (default 50 us), so that sleeps end on time.
class FineSleep {
 public:
  FineSleep() : slack_(prctl(PR_GET_TIMERSLACK, 0, 0, 0, 0)) { prctl(PR_SET_TIMERSLACK, 1, 0, 0, 0); }
  ~FineSleep() {
    if (slack_ > 0) prctl(PR_SET_TIMERSLACK, slack_, 0, 0, 0);
  }
  FineSleep(const FineSleep&) = delete;
  FineSleep& operator=(const FineSleep&) = delete;

 private:
  int slack_;  // [ns]
};

std::size_t longest_report(const ReportDescriptor& reports, ReportKind kind) {
  std::size_t longest = 0;
  for (const HidField& field : reports.fields) {
    if (field.kind == kind) longest = std::max(longest, reports.report_size(kind, field.report_id));
  }
  return std::min(longest, HidBytes::kMaxSize);
}

// Notes that the context's file descriptors have changed and must be listed again.
void LIBUSB_CALL fd_added(int, short, void* changed) {
  *static_cast<bool*>(changed) = true;
}
void LIBUSB_CALL fd_removed(int, void* changed) {
  *static_cast<bool*>(changed) = true;
}

void fill_control(std::vector<unsigned char>& bytes, const HidRequest& request, std::size_t length) {
  libusb_fill_control_setup(bytes.data(), request.type, request.request, request.value, request.index,
                            static_cast<std::uint16_t>(length));
}

}  // namespace

UsbStream::UsbStream(libusb_context& context, libusb_device_handle& handle, const UsbInterface& interface,
                     const ReportDescriptor& reports, const StreamConfig& config, HidStream& stream)
    : context_(context),
      handle_(handle),
      interface_(interface),
      reports_(reports),
      config_(config),
      stream_(stream),
      slots_(std::make_unique<Slots>()) {
  const std::size_t offset = wire_offset(reports_);
  longest_input_ = std::max(longest_report(reports_, ReportKind::input), offset) - offset;
  const std::size_t lever = std::min(reports_.report_size(ReportKind::input, config_.lever_report), HidBytes::kMaxSize);
  lever_size_ = std::max(lever, offset) - offset;
  // A multiple of the packet size, so that a report longer than declared is received in full and can be rejected.
  const std::size_t packet = std::max<std::size_t>(interface_.in_packet, 1);
  const std::size_t buffer_size = std::max<std::size_t>((longest_input_ + packet - 1) / packet, 1) * packet;
  for (Slot& slot : slots_->in) prepare(slot, buffer_size, &UsbStream::input_arrived);
  prepare(slots_->out, kSetup + HidBytes::kMaxSize, &UsbStream::output_arrived);
  prepare(slots_->request, kSetup + lever_size_, &UsbStream::answer_arrived);
  libusb_set_pollfd_notifiers(&context_, &fd_added, &fd_removed, &fds_changed_);
}

UsbStream::~UsbStream() {
  closing_ = true;
  const std::int64_t end = monotonic_ns() + kMaxCancelTime;
  cancel_all();
  while (any_pending() && monotonic_ns() < end) {
    timeval wait{0, 20'000};
    libusb_handle_events_timeout_completed(&context_, &wait, nullptr);
  }
  libusb_set_pollfd_notifiers(&context_, nullptr, nullptr, nullptr);
  if (!any_pending()) return;
  // The controller has not returned all transfers and may still write to their memory, so it must never be freed.
  for (Slot* slot : slots_->all) slot->stream = nullptr;
  static_cast<void>(slots_.release());
}

void UsbStream::run() {
  const FineSleep fine_sleep;
  const HidRequest idle = set_idle(interface_.number);
  libusb_control_transfer(&handle_, idle.type, idle.request, idle.value, idle.index, nullptr, 0, kUsbTimeout);
  if (interface_.in == 0) fail(false, "has no interrupt endpoint for input reports");
  lever_ns_ = monotonic_ns();
  for (Slot& slot : slots_->in) {
    if (!failure_) fill_input(slot);
  }
  while (!stream_.should_end()) {
    const std::int64_t now = monotonic_ns();
    service(now);
    if (failure_) throw_failure();
    wait(next_service_ns(now));
    if (failure_) throw_failure();
  }
}

// ------------------------------------------------------------------------------------------------------- transfers

void UsbStream::prepare(Slot& slot, std::size_t bytes, Arrival arrival) {
  slot.stream = this;
  slot.arrival = arrival;
  slot.transfer.reset(libusb_alloc_transfer(0));
  if (slot.transfer == nullptr) throw HidError("there is not enough memory for a USB transfer");
  slot.bytes.resize(bytes);
}

void UsbStream::fill_input(Slot& slot) {
  libusb_fill_interrupt_transfer(slot.transfer.get(), &handle_, interface_.in, slot.bytes.data(),
                                 static_cast<int>(slot.bytes.size()), &UsbStream::arrived, &slot, 0);
  submit(slot);
}

void UsbStream::submit(Slot& slot) noexcept {
  const int code = libusb_submit_transfer(slot.transfer.get());
  slot.pending = code == LIBUSB_SUCCESS;
  if (code == LIBUSB_ERROR_NO_DEVICE) {
    fail(true, "was unplugged");
  } else if (code != LIBUSB_SUCCESS) {
    fail(false, "accepts no more transfers");
  }
}

void UsbStream::cancel_all() noexcept {
  for (Slot* slot : slots_->all) {
    if (slot->pending) libusb_cancel_transfer(slot->transfer.get());
  }
}

bool UsbStream::any_pending() const noexcept {
  return std::any_of(slots_->all.begin(), slots_->all.end(), [](const Slot* slot) { return slot->pending; });
}

void UsbStream::fail(bool disconnected, const char* what) noexcept {
  if (!failure_) failure_ = Failure{disconnected, what};
}

void UsbStream::throw_failure() const {
  const std::string sentence = usb_name(interface_.identity) + " " + failure_->what;
  if (failure_->disconnected) throw HidDisconnected(sentence);
  throw HidError(sentence);
}

// ----------------------------------------------------------------------------------------------- completed transfers

void LIBUSB_CALL UsbStream::arrived(libusb_transfer* transfer) noexcept {
  Slot& slot = *static_cast<Slot*>(transfer->user_data);
  slot.pending = false;
  UsbStream* const self = slot.stream;
  if (self == nullptr || self->closing_) return;
  if (transfer->status == LIBUSB_TRANSFER_NO_DEVICE) {
    self->fail(true, "was unplugged");
  } else if (transfer->status != LIBUSB_TRANSFER_CANCELLED) {
    (self->*slot.arrival)(*transfer);
  }
}

void UsbStream::input_arrived(const libusb_transfer& transfer) noexcept {
  switch (transfer.status) {
    case LIBUSB_TRANSFER_COMPLETED:
      in_ = {};
      deliver({transfer.buffer, static_cast<std::size_t>(transfer.actual_length)});
      submit(*static_cast<Slot*>(transfer.user_data));
      break;
    case LIBUSB_TRANSFER_STALL:
      in_.stalled = true;
      break;
    default:  // includes overflow: the report is longer than declared
      bus_error(in_, "sends reports that are incomplete or too long");
  }
}

void UsbStream::output_arrived(const libusb_transfer& transfer) noexcept {
  switch (transfer.status) {
    case LIBUSB_TRANSFER_COMPLETED:
      out_ = {};
      stream_.on_sent(monotonic_ns());
      break;
    case LIBUSB_TRANSFER_STALL:
      out_.stalled = true;
      break;
    case LIBUSB_TRANSFER_TIMED_OUT:
      fail(false, "accepts no more reports");
      break;
    default:
      out_.resend = true;
      bus_error(out_, "can no longer be reached");
  }
}

void UsbStream::answer_arrived(const libusb_transfer& transfer) noexcept {
  switch (transfer.status) {
    case LIBUSB_TRANSFER_COMPLETED:
      silent_stalls_ = 0;
      deliver({transfer.buffer + kSetup, static_cast<std::size_t>(transfer.actual_length)});
      break;
    case LIBUSB_TRANSFER_STALL:
      ++silent_stalls_;
      break;
    case LIBUSB_TRANSFER_TIMED_OUT:
      if (++silent_timeouts_ == 2) fail(false, "no longer responds");
      break;
    default:  // requested again if the lever report is still missing
      break;
  }
}

void UsbStream::bus_error(PipeErrors& pipe, const char* what) noexcept {
  const std::int64_t now = monotonic_ns();
  if (pipe.first_error == 0) pipe.first_error = now;
  pipe.retry = now + config_.tick_ns;
  if (now - pipe.first_error > kMaxErrorTime) fail(false, what);
}

void UsbStream::deliver(std::span<const std::uint8_t> wire) noexcept {
  if (wire.empty() || wire.size() > longest_input_) return;
  HidBytes report;
  const std::size_t offset = wire_offset(reports_);
  std::copy(wire.begin(), wire.end(), report.bytes.begin() + static_cast<std::ptrdiff_t>(offset));
  report.size = wire.size() + offset;
  const std::int64_t now = monotonic_ns();
  silent_timeouts_ = 0;
  if (report.id() == config_.lever_report) lever_ns_ = now;
  stream_.on_input(report.view(), now);
}

// --------------------------------------------------------------------------------------------------------- servicing

void UsbStream::service(std::int64_t now) noexcept {
  service_input(now);
  service_output(now);
  offer_output(now);
  request_if_silent(now);
}

// Clears a stalled pipe. If the pipe stalls again before a successful transfer, it has failed; the stall is cleared
// anyway for the next program that uses the device.
bool UsbStream::clear(PipeErrors& pipe, std::uint8_t endpoint, const char* what) noexcept {
  pipe.stalled = false;
  if (endpoint != 0 && libusb_clear_halt(&handle_, endpoint) == LIBUSB_ERROR_NO_DEVICE) {
    fail(true, "was unplugged");
  } else if (++pipe.stalls > 1) {
    fail(false, what);
  }
  return !failure_;
}

void UsbStream::service_input(std::int64_t now) noexcept {
  if (in_.stalled) {
    // The endpoint may only be reset while no transfer is pending.
    bool waiting = false;
    for (Slot& slot : slots_->in) {
      if (!slot.pending) continue;
      libusb_cancel_transfer(slot.transfer.get());
      waiting = true;
    }
    if (waiting || !clear(in_, interface_.in, "has stopped sending data. Unplug it and plug it in again.")) return;
  }
  if (now < in_.retry) return;
  for (Slot& slot : slots_->in) {
    if (!slot.pending && !failure_) submit(slot);
  }
}

void UsbStream::service_output(std::int64_t now) noexcept {
  Slot& slot = slots_->out;
  if (out_.stalled) {
    if (!clear(out_, interface_.out, "has stopped accepting data. Unplug it and plug it in again.")) return;
    out_.resend = true;  // resends the report that was not accepted
  }
  if (!out_.resend || slot.pending || now < out_.retry) return;
  out_.resend = false;
  submit(slot);
}

void UsbStream::offer_output(std::int64_t now) noexcept {
  if (slots_->out.pending || out_.resend || failure_ || now < next_service_ns(now)) return;
  woken_ = false;
  polled_ns_ = now;
  const HidBytes report = stream_.next_output(now);
  if (report.size == 0) return;
  output_ns_ = now;
  send(report);
}

void UsbStream::send(const HidBytes& report) noexcept {
  HidBytes sent = report;
  const std::span<std::uint8_t> wire = on_the_wire(sent, reports_);
  Slot& slot = slots_->out;
  if (interface_.out != 0) {
    std::copy(wire.begin(), wire.end(), slot.bytes.begin());
    libusb_fill_interrupt_transfer(slot.transfer.get(), &handle_, interface_.out, slot.bytes.data(),
                                   static_cast<int>(wire.size()), &UsbStream::arrived, &slot, kUsbTimeout);
  } else {
    fill_control(slot.bytes, set_report(HidReportType::output, report.id(), interface_.number), wire.size());
    std::copy(wire.begin(), wire.end(), slot.bytes.begin() + kSetup);
    libusb_fill_control_transfer(slot.transfer.get(), &handle_, slot.bytes.data(), &UsbStream::arrived, &slot,
                                 kUsbTimeout);
  }
  submit(slot);
}

void UsbStream::request_if_silent(std::int64_t now) noexcept {
  Slot& slot = slots_->request;
  if (slot.pending || failure_ || lever_size_ == 0 || silent_stalls_ >= 2) return;
  if (now < lever_ns_ + config_.silence_ns) return;
  lever_ns_ = now;
  fill_control(slot.bytes, get_report(HidReportType::input, config_.lever_report, interface_.number), lever_size_);
  libusb_fill_control_transfer(slot.transfer.get(), &handle_, slot.bytes.data(), &UsbStream::arrived, &slot,
                               kUsbTimeout);
  submit(slot);
}

// ----------------------------------------------------------------------------------------------------------- waiting

std::int64_t UsbStream::next_service_ns(std::int64_t now) const noexcept {
  if (slots_->out.pending || out_.resend) return now + config_.tick_ns;  // a completed transfer also ends the wait
  const std::int64_t free = output_ns_ + config_.tick_ns;
  return woken_ ? free : std::max(free, polled_ns_ + config_.tick_ns);
}

void UsbStream::list_fds() {
  fds_changed_ = false;
  fds_.assign(1, {config_.wake_fd, POLLIN, 0});
  const libusb_pollfd** list = libusb_get_pollfds(&context_);
  for (const libusb_pollfd** each = list; each != nullptr && *each != nullptr; ++each) {
    fds_.push_back({(*each)->fd, (*each)->events, 0});
  }
  libusb_free_pollfds(list);
}

void UsbStream::wait(std::int64_t until) {
  if (fds_changed_) list_fds();
  const std::int64_t remaining = std::max<std::int64_t>(until - monotonic_ns(), 0);
  const timespec wait{remaining / kSecondNs, remaining % kSecondNs};
  if (ppoll(fds_.data(), fds_.size(), &wait, nullptr) > 0 && (fds_[0].revents & POLLIN) != 0) {
    std::uint64_t count = 0;
    woken_ = read(config_.wake_fd, &count, sizeof count) == sizeof count || woken_;
  }
  timeval none{0, 0};
  libusb_handle_events_timeout_completed(&context_, &none, nullptr);
}

}  // namespace gearshift::haptics
