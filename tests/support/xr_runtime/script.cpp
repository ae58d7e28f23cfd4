// Reads script files, which are TOML: README.md.
#include <openxr/openxr_reflection.h>

#include <algorithm>
#include <optional>
#include <set>
#include <stdexcept>
#include <string_view>
#include <type_traits>

#include <toml++/toml.h>

#include "tests/support/xr_runtime/state.h"

namespace gearshift::xr_test {
namespace {

[[noreturn]] void fail(const std::string& what) {
  throw std::runtime_error(what);
}

// Returns the value of the node; throws if it has another type. An integer is accepted as a floating-point number.
template <class T>
T value_of_node(const toml::node& node, const char* key) {
  std::optional<T> value;
  if constexpr (std::is_same_v<T, double>) {
    if (node.is_number()) value = node.value<double>();
  } else {
    value = node.value_exact<T>();
  }
  if (!value) fail(std::string(key) + " has the wrong type");
  return *value;
}

// Reads one table of the script. A key that the reader does not know is an error, because a test whose script is
// partly ignored would prove nothing.
class TableReader {
 public:
  explicit TableReader(const toml::table& table) : table_(table) {}
  TableReader(const TableReader&) = delete;
  TableReader& operator=(const TableReader&) = delete;

  template <class T>
  void read(const char* key, T& to) {
    using Stored = std::conditional_t<std::is_same_v<T, int>, std::int64_t, T>;
    if (const toml::node* const node = find(key)) to = static_cast<T>(value_of_node<Stored>(*node, key));
  }
  std::vector<double> numbers(const char* key) {
    std::vector<double> list;
    const toml::node* const node = find(key);
    if (node == nullptr) return list;
    if (!node->is_array()) fail(std::string(key) + " is not a list");
    for (const toml::node& one : *node->as_array()) list.push_back(value_of_node<double>(one, key));
    return list;
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
  const toml::node* find(const char* key) {
    read_keys_.insert(key);
    return table_.get(key);
  }
  template <class Function>
  static void use_table(const toml::table& source, Function use) {
    TableReader table(source);
    use(table);
    table.check_complete();
  }

  const toml::table& table_;
  std::set<std::string, std::less<>> read_keys_;
};

// Reads position [m] and the angles yaw (positive to the left) and pitch (up) [degrees].
Pose read_pose(TableReader& table) {
  const std::vector<double> position = table.numbers("position");
  if (!position.empty() && position.size() != 3) fail("position has three numbers");
  double yaw = 0.0, pitch = 0.0;
  table.read("yaw", yaw);
  table.read("pitch", pitch);
  const auto turn = [](double degrees, glm::dvec3 axis) { return glm::angleAxis(degrees * kDegree, axis); };
  return {position.empty() ? glm::dvec3(0.0) : glm::dvec3(position[0], position[1], position[2]),
          turn(yaw, {0.0, 1.0, 0.0}) * turn(pitch, {1.0, 0.0, 0.0})};
}

using PoseKey = std::pair<double, Pose>;  // time [s], pose

// Interpolates linearly between the keys. The pose is constant before the first key and after the last key.
Pose interpolate(const std::vector<PoseKey>& keys, double t) {
  const auto next = std::find_if(keys.begin(), keys.end(), [&](const PoseKey& key) { return key.first > t; });
  if (next == keys.begin()) return keys.front().second;
  if (next == keys.end()) return keys.back().second;
  const auto& [last, from] = *(next - 1);
  const auto& [then, to] = *next;
  const double fraction = (t - last) / (then - last);
  return {from.position * (1.0 - fraction) + to.position * fraction,
          glm::slerp(from.orientation, to.orientation, fraction)};
}

void read_path(TableReader& table, const char* key, std::function<Pose(double)>& to) {
  std::vector<PoseKey> keys;
  table.for_each(key, [&](TableReader& one) {
    double at = 0.0;
    one.read("at", at);
    if (!keys.empty() && at <= keys.back().first) fail(std::string(key) + ": times must grow");
    keys.push_back({at, read_pose(one)});
  });
  if (!keys.empty()) to = [keys](double t) { return interpolate(keys, t); };
}

// Each value of an input applies until the time of the next value; before the first time the input is zero.
void read_input(TableReader& table, Script& script) {
  std::string path;
  table.read("path", path);
  const std::vector<double> at = table.numbers("at"), value = table.numbers("value");
  if (at.size() != value.size() || !std::is_sorted(at.begin(), at.end()))
    fail("input: a value for each time, in order");
  script.inputs[path] = [at, value](double t) {
    const auto after = std::upper_bound(at.begin(), at.end(), t) - at.begin();
    return after == 0 ? 0.0 : value[static_cast<std::size_t>(after) - 1];
  };
}

void read_event(TableReader& table, Script& script) {
  static constexpr std::string_view kKinds[] = {
      "focused", "visible",      "synchronized", "stopping", "ready",   "loss_pending", "instance_loss",
      "exit",    "space_change", "hidden",       "absent",   "present", "stall"};  // as in Event::Kind
  Event event;
  std::string what, space = "local";
  table.read("at", event.at);
  table.read("what", what);
  const auto* const kind = std::find(std::begin(kKinds), std::end(kKinds), what);
  if (kind == std::end(kKinds)) fail("event: " + what);
  event.kind = static_cast<Event::Kind>(kind - std::begin(kKinds));
  table.read("space", space);
  if (space != "local" && space != "stage") fail("space: local or stage");
  event.space = space == "stage" ? Space::stage : Space::local;
  event.pose = read_pose(table);
  table.read("span", event.span);
  table.read("periods", event.periods);
  script.timeline.push_back(event);
}

void read_failure(TableReader& table, Script& script) {
  Failure failure;
  std::string result;
  table.read("function", failure.function);
  table.read("result", result);
  table.read("nth", failure.nth);
  bool known = false;
#define GEARSHIFT_XR_RESULT(name, number) \
  if (result == #name) failure.result = (name), known = true;
  XR_LIST_ENUM_XrResult(GEARSHIFT_XR_RESULT);
#undef GEARSHIFT_XR_RESULT
  if (!known) fail("result: " + result);
  script.failures.push_back(failure);
}

void read_hang(TableReader& table, Script& script) {
  Hang hang;
  table.read("function", hang.function);
  table.read("at", hang.at);
  table.read("span", hang.span);
  script.hangs.push_back(hang);
}

}  // namespace

Script read_script(const char* file) {
  const toml::table root = toml::parse_file(file);
  TableReader table(root);
  Script script;
  table.read("headset", script.headset);
  table.read("prints", script.prints);
  table.read("user_presence", script.user_presence);
  table.for_each("stage_origin", [&](TableReader& one) { script.stage_origin = read_pose(one); });
  if (const std::vector<double> size = table.numbers("recommended"); size.size() == 2) {
    script.recommended_width = static_cast<std::uint32_t>(size[0]);
    script.recommended_height = static_cast<std::uint32_t>(size[1]);
  }
  std::string pacing = "stepped";
  table.read("pacing", pacing);
  if (pacing != "stepped" && pacing != "real") fail("pacing: stepped or real");
  script.pacing = pacing == "real" ? Pacing::real : Pacing::stepped;
  read_path(table, "head", script.head);
  read_path(table, "left", script.aim[0]);
  read_path(table, "right", script.aim[1]);
  table.for_each("tracking_gap", [&](TableReader& one) {
    Gap gap;
    one.read("from", gap.from);
    one.read("until", gap.until);
    script.tracking_gaps.push_back(gap);
  });
  table.for_each("input", [&](TableReader& one) { read_input(one, script); });
  table.for_each("event", [&](TableReader& one) { read_event(one, script); });
  table.for_each("failure", [&](TableReader& one) { read_failure(one, script); });
  table.for_each("hang", [&](TableReader& one) { read_hang(one, script); });
  table.read("capture_every", script.capture_every);
  table.check_complete();
  return script;
}

}  // namespace gearshift::xr_test
