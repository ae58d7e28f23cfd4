#include "tests/support/usb/usb_gadget.h"

#include <cstddef>

namespace gearshift::test {

std::string StickGadget::string_descriptor(int index) const {
  const Bytes device = stick_.device_descriptor();
  const int at = device[13 + static_cast<std::size_t>(index)];  // iManufacturer, iProduct, iSerialNumber
  if (at == 0) return {};
  const Bytes descriptor = stick_.string_descriptor(at);
  std::string text;
  for (std::size_t i = 2; i + 1 < descriptor.size(); i += 2)
    text += static_cast<char>(descriptor[i]);  // ASCII in UTF-16
  return text;
}

void StickGadget::advance(std::int64_t now_ns) {
  constexpr std::int64_t kMaxStep = 4'000'000;  // [ns]
  if (last_ns_ != 0 && now_ns - last_ns_ > kMaxStep) stopped_ns_ += now_ns - last_ns_ - kMaxStep;
  last_ns_ = now_ns;
  stick_.advance(now_ns - stopped_ns_);
}

}  // namespace gearshift::test
