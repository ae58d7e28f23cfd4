#include "haptics/hid/report_descriptor.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "haptics/hid/hid_error.h"

namespace gearshift::haptics {
namespace {

constexpr std::size_t kMaxFields = 4096, kMaxCollections = 4096;
constexpr std::size_t kMaxUsages = 1024;                 // maximum number stored per field; further usages are ignored
constexpr std::uint64_t kMaxReportBits = 8 * 0xffffULL;  // a report's length in bytes has 16 bits

// HID 1.11 section 6.2.2.2: an item has a type, a tag and up to four bytes of data.
enum class ItemType { main, global, local, reserved };

struct Item {
  ItemType type = ItemType::main;
  int tag = 0;
  std::uint32_t data = 0;
  int size = 0;        // [bytes] size of the data
  std::size_t at = 0;  // [bytes] offset of the item
};

[[noreturn]] void refuse(std::size_t at, const std::string& reason) {
  throw HidError("the report descriptor is invalid at byte " + std::to_string(at) + " (" + reason + ")");
}

// A minimum or maximum; whether it is signed depends on other items.
struct Limit {
  std::uint32_t data = 0;
  int size = 0;

  std::int64_t as_signed() const {
    if (size == 0) return 0;
    const std::int64_t half = std::int64_t{1} << (8 * size - 1);
    return data < half ? data : data - 2 * half;
  }
};

struct ValueRange {
  Limit min, max;

  std::int64_t low() const { return min.as_signed(); }
  // If the minimum is not negative, the maximum is unsigned: the Logical Maximum item 0x25 0xFF then means 255, not -1.
  std::int64_t high() const { return low() < 0 ? max.as_signed() : std::int64_t{max.data}; }
};

struct Globals {
  std::uint16_t page = 0;
  ValueRange logical, physical;
  std::uint32_t unit = 0, bits = 0, count = 0;
  int unit_exponent = 0;
  std::uint8_t report_id = 0;
};

struct LocalUsage {
  HidUsage usage;
  bool with_page = false;  // true for a 32-bit usage, which includes its page
};

struct Locals {
  std::vector<LocalUsage> usages;
  std::optional<LocalUsage> low, high;         // first and last usage of a range, once declared
  bool in_set = false, set_has_usage = false;  // state inside a delimited set of alternative usages
};

class Parser {
 public:
  explicit Parser(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  ReportDescriptor parse() {
    const auto last = std::find_if(bytes_.rbegin(), bytes_.rend(), [](std::uint8_t byte) { return byte != 0; });
    const auto end = static_cast<std::size_t>(bytes_.rend() - last);
    while (at_ < end) {
      if (skip_long_item()) continue;
      handle(next_item());
    }
    if (collection_ >= 0) {
      refuse(collection_start_[static_cast<std::size_t>(collection_)], "the collection that begins here never ends");
    }
    return std::move(result_);
  }

 private:
  bool skip_long_item() {
    constexpr std::uint8_t prefix = 0xfe;
    if (bytes_[at_] != prefix) return false;
    const std::size_t remaining = bytes_.size() - at_;
    if (remaining < 3 || remaining - 3 < bytes_[at_ + 1]) refuse(at_, "a long item is cut off");
    at_ += 3U + bytes_[at_ + 1];
    return true;
  }

  Item next_item() {
    const std::uint8_t prefix = bytes_[at_];
    Item item;
    item.at = at_;
    item.size = (prefix & 3) == 3 ? 4 : prefix & 3;
    item.type = static_cast<ItemType>(prefix >> 2 & 3);
    item.tag = prefix >> 4;
    const auto size = static_cast<std::size_t>(item.size);
    if (bytes_.size() - at_ - 1 < size) refuse(at_, "the last item is cut off");
    for (std::size_t i = 0; i < size; ++i) {
      item.data |= static_cast<std::uint32_t>(bytes_[at_ + 1 + i]) << (8 * i);
    }
    at_ += 1 + size;
    return item;
  }

  void handle(const Item& item) {
    switch (item.type) {
      case ItemType::main:
        return handle_main(item);
      case ItemType::global:
        return handle_global(item);
      case ItemType::local:
        return handle_local(item);
      case ItemType::reserved:
        return;
    }
  }

  void handle_main(const Item& item) {
    resolve_pages();
    switch (item.tag) {
      case 0x8:
        add_field(item, ReportKind::input);
        break;
      case 0x9:
        add_field(item, ReportKind::output);
        break;
      case 0xb:
        add_field(item, ReportKind::feature);
        break;
      case 0xa:
        begin_collection(item);
        break;
      case 0xc:
        end_collection(item);
        break;
      default:
        break;
    }
    locals_ = {};
  }

  void handle_global(const Item& item) {
    switch (item.tag) {
      case 0x0:
        globals_.page = static_cast<std::uint16_t>(item.data);
        break;
      case 0x1:
        globals_.logical.min = {item.data, item.size};
        break;
      case 0x2:
        globals_.logical.max = {item.data, item.size};
        break;
      case 0x3:
        globals_.physical.min = {item.data, item.size};
        break;
      case 0x4:
        globals_.physical.max = {item.data, item.size};
        break;
      // The exponent is a signed nibble: the Unit Exponent items 0x55 0x0D and 0x55 0xFD both mean -3.
      case 0x5:
        globals_.unit_exponent = (static_cast<int>(item.data & 0xf) ^ 8) - 8;
        break;
      case 0x6:
        globals_.unit = item.data;
        break;
      case 0x7:
        globals_.bits = item.data;
        break;
      case 0x8:
        set_report_id(item);
        break;
      case 0x9:
        globals_.count = item.data;
        break;
      case 0xa:
        pushed_.push_back(globals_);
        break;
      case 0xb:
        pop(item);
        break;
      default:
        break;
    }
  }

  void set_report_id(const Item& item) {
    if (item.data > 0xff) refuse(item.at, "report ID " + std::to_string(item.data) + " is above 255");
    globals_.report_id = static_cast<std::uint8_t>(item.data);
    result_.numbered = result_.numbered || globals_.report_id != 0;
  }

  void pop(const Item& item) {
    if (pushed_.empty()) refuse(item.at, "a Pop item has no matching Push item");
    globals_ = pushed_.back();
    pushed_.pop_back();
  }

  LocalUsage usage_of(const Item& item) const {
    const bool with_page = item.size == 4;
    const auto page = with_page ? static_cast<std::uint16_t>(item.data >> 16) : globals_.page;
    return {{page, static_cast<std::uint16_t>(item.data)}, with_page};
  }

  void handle_local(const Item& item) {
    constexpr int usage = 0x0, usage_low = 0x1, usage_high = 0x2, delimiter = 0xa;
    switch (item.tag) {
      case usage:
        add_usages(usage_of(item), usage_of(item));
        break;
      case usage_low:
        locals_.low = usage_of(item);
        break;
      case usage_high:
        locals_.high = usage_of(item);
        break;
      case delimiter:
        locals_.in_set = item.data != 0;
        locals_.set_has_usage = false;
        break;
      default:
        break;  // string and designator items are ignored
    }
    if (locals_.low && locals_.high) {
      add_usages(*locals_.low, *locals_.high);
      locals_.low = locals_.high = std::nullopt;
    }
  }

  // Only the first usage of a set of alternative usages counts (HID 1.11 section 6.2.2.8).
  void add_usages(LocalUsage low, LocalUsage high) {
    if (locals_.in_set && locals_.set_has_usage) return;
    locals_.set_has_usage = true;
    for (int id = low.usage.id; id <= high.usage.id && locals_.usages.size() < kMaxUsages; ++id) {
      low.usage.id = static_cast<std::uint16_t>(id);
      locals_.usages.push_back(low);
    }
  }

  // By HID 1.11 section 6.2.2.8, the usage page in effect at a main item applies to all usages declared before it. Here
  // it applies only to the usages after the last one that already has this page. So X and Y keep their page if a
  // throttle is declared under the next page.
  void resolve_pages() {
    for (auto usage = locals_.usages.rbegin(); usage != locals_.usages.rend(); ++usage) {
      if (usage->with_page) continue;
      if (usage->usage.page == globals_.page) return;
      usage->usage.page = globals_.page;
    }
  }

  void begin_collection(const Item& item) {
    if (result_.collections.size() == kMaxCollections) refuse(item.at, "more than 4096 collections");
    HidCollection collection;
    if (!locals_.usages.empty()) collection.usage = locals_.usages.front().usage;
    collection.type = static_cast<std::uint8_t>(item.data);
    collection.parent = collection_;
    collection_ = static_cast<int>(result_.collections.size());
    result_.collections.push_back(collection);
    collection_start_.push_back(item.at);
  }

  void end_collection(const Item& item) {
    if (collection_ < 0) refuse(item.at, "an End Collection item has no matching Collection item");
    collection_ = result_.collections[static_cast<std::size_t>(collection_)].parent;
  }

  void add_field(const Item& item, ReportKind kind) {
    if (globals_.bits == 0 || globals_.count == 0) return;
    if (result_.fields.size() == kMaxFields) refuse(item.at, "more than 4096 fields");
    std::uint64_t& end = ends_[static_cast<std::size_t>(kind)][globals_.report_id];
    const std::uint64_t length = std::uint64_t{globals_.bits} * globals_.count;
    if (length > kMaxReportBits - end) refuse(item.at, "the report is longer than 65535 bytes");
    HidField field = field_of(item.data, kind);
    field.offset = static_cast<int>(end);
    end += length;
    result_.fields.push_back(std::move(field));
  }

  HidField field_of(std::uint32_t flags, ReportKind kind) const {
    HidField field;
    field.kind = kind;
    field.report_id = globals_.report_id;
    field.bits = static_cast<int>(globals_.bits);
    field.count = static_cast<int>(globals_.count);
    field.constant = (flags & 1) != 0;
    field.array = (flags & 2) == 0;
    field.relative = (flags & 4) != 0;
    field.logical_min = globals_.logical.low();
    field.logical_max = globals_.logical.high();
    field.physical_min = globals_.physical.low();
    field.physical_max = globals_.physical.high();
    field.unit = globals_.unit;
    field.unit_exponent = globals_.unit_exponent;
    for (const LocalUsage& usage : locals_.usages) field.usages.push_back(usage.usage);
    field.collection = collection_;
    return field;
  }

  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
  Globals globals_;
  std::vector<Globals> pushed_;
  Locals locals_;
  int collection_ = -1;                                   // innermost open collection
  std::vector<std::size_t> collection_start_;             // [bytes] offset at which each collection begins
  std::array<std::array<std::uint64_t, 256>, 3> ends_{};  // [bits] current length of each report
  ReportDescriptor result_;
};

}  // namespace

HidUsage HidField::usage(int element) const noexcept {
  if (usages.empty()) return {};
  return usages[std::min(static_cast<std::size_t>(element), usages.size() - 1)];
}

std::size_t ReportDescriptor::report_size(ReportKind kind, std::uint8_t id) const noexcept {
  int bits = 0;
  for (const HidField& field : fields) {
    if (field.kind == kind && field.report_id == id) bits = std::max(bits, field.offset + field.bits * field.count);
  }
  return bits == 0 ? 0 : 1 + (static_cast<std::size_t>(bits) + 7) / 8;
}

bool ReportDescriptor::is_within(const HidField& field, HidUsage collection) const noexcept {
  for (int at = field.collection; at >= 0; at = collections[static_cast<std::size_t>(at)].parent) {
    if (collections[static_cast<std::size_t>(at)].usage == collection) return true;
  }
  return false;
}

ReportDescriptor parse_report_descriptor(std::span<const std::uint8_t> bytes) {
  return Parser(bytes).parse();
}

}  // namespace gearshift::haptics
