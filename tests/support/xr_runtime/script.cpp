#include "tests/support/xr_runtime/script.h"

#include <openxr/openxr_reflection.h>

#include <algorithm>
#include <optional>
#include <set>
#include <stdexcept>
#include <string_view>
#include <type_traits>

#include <toml++/toml.h>

namespace gearshift::xr_test {
namespace {

[[noreturn]] void fail(const std::string& what) {
  throw std::runtime_error(what);
}

// Returns the value of the node; empty if it has another type. An integer is accepted as a floating-point number.
template <class T>
std::optional<T> exact_value(const toml::node& node) {
  if constexpr (std::is_floating_point_v<T>) return node.is_number() ? node.value<T>() : std::nullopt;
  return node.value_exact<T>();
}

// Reads one table of the script. A key that the reader does not know is an error, because a test whose script is
// partly ignored would prove nothing.
class TableReader {
 public:
  explicit TableReader(const toml::table& table) : table_(table) {}
  TableReader(const TableReader&) = delete;
  TableReader& operator=(const TableReader&) = delete;

  const toml::node* find(const char* key) {
    read_keys_.insert(key);
    return table_.get(key);
  }
  template <class T>
  void read(const char* key, T& to) {
    const toml::node* const node = find(key);
    if (node == nullptr) return;
    using Stored = std::conditional_t<std::is_same_v<T, std::uint32_t> || std::is_same_v<T, int>, std::int64_t, T>;
    const auto value = exact_value<Stored>(*node);
    if (!value) fail(std::string(key) + " has the wrong type");
    to = static_cast<T>(*value);
  }
  template <class T>
  void read_list(const char* key, std::vector<T>& to) {
    const toml::node* const node = find(key);
    if (node == nullptr) return;
    if (!node->is_array()) fail(std::string(key) + " is not a list");
    to.clear();
    for (const toml::node& one : *node->as_array()) {
      using Stored = std::conditional_t<std::is_floating_point_v<T>, double, std::int64_t>;
      const auto value = exact_value<Stored>(one);
      if (!value) fail(std::string(key) + " has the wrong type");
      to.push_back(static_cast<T>(*value));
    }
  }
  // Calls `use` for each table of a list, or for a single table; does nothing if the key is missing.
  template <class Function>
  void for_each(const char* key, Function use) {
    const toml::node* const node = find(key);
    if (node == nullptr) return;
    if (const toml::table* const one = node->as_table()) return use_table(*one, use);
    if (!node->is_array()) fail(std::string(key) + " is not a table");
    for (const toml::node& one : *node->as_array()) {
      if (!one.is_table()) fail(std::string(key) + " has something that is not a table");
      use_table(*one.as_table(), use);
    }
  }
  void check_complete() const {
    for (const auto& [key, node] : table_) {
      if (!read_keys_.contains(std::string_view(key))) fail("unknown key: " + std::string(std::string_view(key)));
    }
  }

 private:
  template <class Function>
  static void use_table(const toml::table& source, Function use) {
    TableReader table(source);
    use(table);
    table.check_complete();
  }

  const toml::table& table_;
  std::set<std::string, std::less<>> read_keys_;
};

// Reads position [m] and the angles yaw (positive to the left), pitch (up) and roll (to the left) [degrees].
Pose read_pose(TableReader& table) {
  std::vector<double> position{0.0, 0.0, 0.0};
  double yaw = 0.0, pitch = 0.0, roll = 0.0;
  table.read_list("position", position);
  if (position.size() != 3) fail("position has three numbers");
  table.read("yaw", yaw);
  table.read("pitch", pitch);
  table.read("roll", roll);
  const auto turn = [](double degrees, glm::dvec3 axis) { return glm::angleAxis(degrees * kDegree, axis); };
  return {{position[0], position[1], position[2]},
          turn(yaw, {0.0, 1.0, 0.0}) * turn(pitch, {1.0, 0.0, 0.0}) * turn(roll, {0.0, 0.0, 1.0})};
}

struct PoseKey {
  double at = 0.0;  // [s]
  Pose pose;
};

// Interpolates linearly between the keys. The pose is constant before the first key and after the last key.
Pose interpolate(const std::vector<PoseKey>& keys, double t) {
  const auto next = std::find_if(keys.begin(), keys.end(), [&](const PoseKey& key) { return key.at > t; });
  if (next == keys.begin()) return keys.front().pose;
  if (next == keys.end()) return keys.back().pose;
  const PoseKey& last = *(next - 1);
  const double fraction = (t - last.at) / (next->at - last.at);
  return {last.pose.position * (1.0 - fraction) + next->pose.position * fraction,
          glm::slerp(last.pose.orientation, next->pose.orientation, fraction)};
}

void read_path(TableReader& table, const char* key, std::function<Pose(double)>& to) {
  std::vector<PoseKey> keys;
  table.for_each(key, [&](TableReader& one) {
    double at = 0.0;
    one.read("at", at);
    if (!keys.empty() && at <= keys.back().at) fail(std::string(key) + ": times must grow");
    keys.push_back({at, read_pose(one)});
  });
  if (!keys.empty()) to = [keys](double t) { return interpolate(keys, t); };
}

void read_hand(TableReader& table, const char* key, Hand& hand) {
  table.for_each(key, [&](TableReader& one) {
    read_path(one, "aim", hand.aim);
    read_path(one, "grip", hand.grip);
  });
}

// Each value of an input applies until the time of the next value; before the first time the input is zero.
void read_input(TableReader& table, Script& script) {
  std::string path;
  std::vector<double> at, value;
  table.read("path", path);
  table.read_list("at", at);
  table.read_list("value", value);
  if (at.size() != value.size() || !std::is_sorted(at.begin(), at.end()))
    fail("input: a value for each time, in order");
  script.inputs[path] = [at, value](double t) {
    const auto after = std::upper_bound(at.begin(), at.end(), t) - at.begin();
    return after == 0 ? 0.0 : value[static_cast<std::size_t>(after) - 1];
  };
}

Event::Kind parse_event_kind(const std::string& text) {
  using Kind = Event::Kind;
  static const std::map<std::string, Kind> table{{"focused", Kind::focused},
                                                 {"visible", Kind::visible},
                                                 {"synchronized", Kind::synchronized},
                                                 {"stopping", Kind::stopping},
                                                 {"ready", Kind::ready},
                                                 {"loss_pending", Kind::loss_pending},
                                                 {"instance_loss", Kind::instance_loss},
                                                 {"exit", Kind::exit},
                                                 {"space_change", Kind::space_change},
                                                 {"profile", Kind::profile},
                                                 {"hidden", Kind::hidden},
                                                 {"stall", Kind::stall}};
  const auto found = table.find(text);
  if (found == table.end()) fail("event: " + text);
  return found->second;
}

void read_event(TableReader& table, Script& script) {
  Event event;
  std::string what, space = "local";
  table.read("at", event.at);
  table.read("what", what);
  event.kind = parse_event_kind(what);
  table.read("space", space);
  if (space != "local" && space != "stage") fail("space: local or stage");
  event.space = space == "stage" ? Space::stage : Space::local;
  event.pose = read_pose(table);
  table.read("frames_ahead", event.frames_ahead);
  table.read("profile", event.profile);
  table.read("span", event.span);
  table.read("periods", event.periods);
  script.timeline.push_back(event);
}

XrResult parse_result(const std::string& text) {
#define GEARSHIFT_XR_RESULT(name, number) \
  if (text == #name) return name;
  XR_LIST_ENUM_XrResult(GEARSHIFT_XR_RESULT);
#undef GEARSHIFT_XR_RESULT
  fail("result: " + text);
}

void read_failure(TableReader& table, Script& script) {
  Failure failure;
  std::string result = "XR_ERROR_RUNTIME_FAILURE";
  table.read("function", failure.function);
  table.read("result", result);
  table.read("nth", failure.nth);
  failure.result = parse_result(result);
  script.failures.push_back(failure);
}

void read_size(TableReader& table, const char* key, std::uint32_t& width, std::uint32_t& height) {
  std::vector<std::uint32_t> size{width, height};
  table.read_list(key, size);
  if (size.size() != 2) fail(std::string(key) + " is a width and a height");
  width = size[0];
  height = size[1];
}

void read_fov(TableReader& table, const char* eye, Fov& fov) {
  std::vector<double> degrees;
  table.read_list(eye, degrees);
  if (degrees.empty()) return;
  if (degrees.size() != 4) fail("fov: left, right, up, down");
  fov = {degrees[0] * kDegree, degrees[1] * kDegree, degrees[2] * kDegree, degrees[3] * kDegree};
}

void read_headset(TableReader& table, Script& script) {
  table.read("headset", script.headset);
  table.read("vulkan_enable2", script.vulkan_enable2);
  table.read("composition_layer_depth", script.composition_layer_depth);
  table.read("convert_timespec_time", script.convert_timespec_time);
  table.read("stage", script.stage);
  table.for_each("stage_origin", [&](TableReader& one) { script.stage_origin = read_pose(one); });
  read_size(table, "recommended", script.recommended_width, script.recommended_height);
  read_size(table, "max", script.max_width, script.max_height);
  table.read("recommended_samples", script.recommended_samples);
  table.read("max_samples", script.max_samples);
  table.read("images", script.images);
  table.read_list("colour_formats", script.colour_formats);
  table.read_list("depth_formats", script.depth_formats);
  table.for_each("fov", [&](TableReader& one) {
    read_fov(one, "left", script.fov[0]);
    read_fov(one, "right", script.fov[1]);
  });
  table.read("eye_distance", script.eye_distance);
  table.read("period", script.period);
}

void read_play(TableReader& table, Script& script) {
  std::string pacing = "stepped";
  table.read("pacing", pacing);
  if (pacing != "stepped" && pacing != "real") fail("pacing: stepped or real");
  script.pacing = pacing == "real" ? Pacing::real : Pacing::stepped;
  table.read("polls_before_ready", script.polls_before_ready);
  read_path(table, "head", script.head);
  table.for_each("tracking_gap", [&](TableReader& one) {
    Gap gap;
    one.read("from", gap.from);
    one.read("until", gap.until);
    one.read("valid", gap.valid);
    script.tracking_gaps.push_back(gap);
  });
  table.read("early_error", script.early_error);
  read_hand(table, "left", script.hands[0]);
  read_hand(table, "right", script.hands[1]);
  table.read("profile", script.profile);
  table.for_each("input", [&](TableReader& one) { read_input(one, script); });
  table.for_each("event", [&](TableReader& one) { read_event(one, script); });
  table.for_each("failure", [&](TableReader& one) { read_failure(one, script); });
  table.for_each("capture", [&](TableReader& one) {
    one.read("every", script.capture.every);
    one.read_list("only", script.capture.only);
    one.read("depth", script.capture.depth);
  });
}

}  // namespace

Script read_script(const std::filesystem::path& file) {
  const toml::table root = toml::parse_file(file.string());
  TableReader table(root);
  Script script;
  read_headset(table, script);
  read_play(table, script);
  table.check_complete();
  return script;
}

}  // namespace gearshift::xr_test
