#include "haptics/loop/replay.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

#include "haptics/files/file_error.h"
#include "haptics/files/printable.h"
#include "haptics/gate/gate_compiler.h"
#include "haptics/loop/haptic_loop.h"

namespace gearshift::haptics {

// Returns the recorded readings and ignores all writes.
class RecordedDevice final : public HapticDevice {
 public:
  explicit RecordedDevice(const DeviceSpec& spec) noexcept : spec_(spec) {}
  const DeviceSpec& spec() const noexcept override { return spec_; }
  LeverReading read(std::int64_t) noexcept override { return reading; }
  void write(glm::dvec2) noexcept override {}
  void release() noexcept override {}

  LeverReading reading;

 private:
  DeviceSpec spec_;
};

namespace {

constexpr std::size_t kShownName = 80;  // [bytes] longest part of a load's name shown in a message

struct NamedLeaf {
  std::string name;    // "reading.position.x"
  std::uint64_t bits;  // bits as stored in the file
  std::string text;
};

template <LeafField T>
std::string value_text(T value) {
  if constexpr (std::is_same_v<T, bool> || std::is_enum_v<T>) {
    return std::to_string(static_cast<int>(value));
  } else {
    char text[64];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
  }
}

// Calls visit("reading.position.x", leaf) for every leaf field. This is slow and allocates, so it is not used every
// cycle.
template <class T, class Visit>
void each_leaf(const T& value, const std::string& prefix, const Visit& visit) {
  each_field(value, [&](const char* name, const auto& member) {
    if constexpr (LeafField<std::remove_cvref_t<decltype(member)>>)
      visit(prefix + name, member);
    else
      each_leaf(member, prefix + name + ".", visit);
  });
}

std::vector<NamedLeaf> leaves_of(const TraceSample& sample) {
  std::vector<NamedLeaf> leaves;
  each_leaf(sample, "", [&](const std::string& name, auto value) {
    leaves.push_back({name, leaf_bits(value), value_text(value)});
  });
  return leaves;
}

std::optional<Difference> first_difference(const TraceSample& recorded, const TraceSample& replayed) {
  const std::vector<NamedLeaf> recorded_leaves = leaves_of(recorded), replayed_leaves = leaves_of(replayed);
  for (std::size_t i = 0; i < recorded_leaves.size(); ++i)
    if (recorded_leaves[i].bits != replayed_leaves[i].bits)
      return Difference{recorded.out.cycle, recorded_leaves[i].name, recorded_leaves[i].text, replayed_leaves[i].text};
  return std::nullopt;
}

bool has_same_bits(const HapticTuning& a, const HapticTuning& b) noexcept {
  std::array<std::byte, encoded_size<HapticTuning>()> left, right;
  FieldWriter(left.data()).put(a);
  FieldWriter(right.data()).put(b);
  return left == right;
}

// A load's name may contain a whole car file, so messages quote only its first line.
std::unique_ptr<LeverLoad> make_known_load(const std::string& name, const Gate& gate, const LoadFactory& make_load) {
  std::unique_ptr<LeverLoad> load;
  try {
    load = make_load(name, gate);
  } catch (const FileError& error) {
    throw std::invalid_argument(std::string("its car or lesson is invalid: ") + error.what());
  }
  if (load) return load;
  const std::string first_line = printable(name.substr(0, std::min<std::size_t>(name.find('\n'), kShownName)));
  throw std::invalid_argument("the lever load \"" + first_line + "\" is not known to this program");
}

}  // namespace

std::unique_ptr<LeverLoad> make_no_load(const std::string& name, const Gate&) {
  for (int gear = kReverseGear; gear <= kMaxGear; ++gear) {
    auto load = std::make_unique<NoLoad>(gear);
    if (name == load->replay_parameters()) return load;
  }
  return nullptr;
}

struct Replayer::Rig {
  Rig(const TraceHeader& header, const LoadFactory& make_load)
      : device(header.device),
        gate(compile_gate(parse_gate_layout(header.gate_text, header.gate_file), header.device.workspace,
                          header.device.yoke_radius > 0.0 ? header.device.yoke_radius : HUGE_VAL)),
        load(make_known_load(header.load, gate, make_load)),
        loop(header.config, gate, device, *load, inputs) {
    if (header.armed) loop.arm();
  }

  // Feeds the recorded inputs of one cycle to the loop.
  void feed(const TraceSample& recorded, bool new_tuning) noexcept {
    device.reading = recorded.reading;
    inputs.controls.write(recorded.controls);
    if (new_tuning) inputs.tuning.write(recorded.tuning);
    if (recorded.command != LoopCommand::none) inputs.commands.push(recorded.command);
  }

  const TraceSample& cycle(std::int64_t deadline_ns, std::int64_t skipped) noexcept {
    loop.cycle(deadline_ns, skipped);
    return loop.published();
  }

  RecordedDevice device;
  Gate gate;
  std::unique_ptr<LeverLoad> load;
  LoopInputs inputs;
  HapticLoop loop;
};

Replayer::Replayer(const TraceHeader& header, const std::string& file, const LoadFactory& make_load)
    : file_(file), period_(1e-9 * static_cast<double>(period_ns(header.config))), hash_(begin_hash(header)) {
  try {
    check_config(header.config);
    check_device(header.device);
    rig_ = std::make_unique<Rig>(header, make_load);
  } catch (const std::invalid_argument& error) {
    throw FileError(file, 0, std::string("the trace cannot be replayed, because ") + error.what());
  } catch (const FileError& error) {
    throw FileError(file, 0, std::string("the trace cannot be replayed, because its gate is invalid: ") + error.what());
  }
}

Replayer::~Replayer() = default;

bool Replayer::step(const TraceSample& recorded) {
  const bool is_first = result_.cycles == 0;
  if (is_first && recorded.out.cycle != 0)
    throw FileError(file_, 0,
                    "the trace cannot be replayed, because recording began in the middle of a run, at cycle " +
                        std::to_string(recorded.out.cycle));
  if (is_first) first_ns_ = recorded.deadline_ns;

  // The loop derives the tuning of the first cycle from the trace header. Feeding the recorded tuning to it would hide
  // an error in the header.
  rig_->feed(recorded, !is_first && !has_same_bits(recorded.tuning, last_.tuning));
  const TraceSample& replayed = rig_->cycle(recorded.deadline_ns, recorded.skipped);
  last_ = recorded;
  ++result_.cycles;

  const EncodedSample recorded_bytes = encode_sample(recorded);
  const EncodedSample replayed_bytes = encode_sample(replayed);
  hash_.add(outputs_of(replayed_bytes));
  if (recorded_bytes == replayed_bytes) return true;
  result_.first = first_difference(recorded, replayed);
  return false;
}

ReplayResult Replayer::finish(std::uint64_t recorded_hash) const {
  ReplayResult result = result_;
  result.recorded_hash = recorded_hash;
  result.replayed_hash = hash_.value();
  if (result.cycles > 0)
    result.seconds = 1e-9 * static_cast<double>(nanoseconds_between(first_ns_, last_.deadline_ns)) + period_;
  return result;
}

}  // namespace gearshift::haptics
