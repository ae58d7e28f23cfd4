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

[[noreturn]] void wrong(const std::string& what) {
  throw std::runtime_error(what);
}

// A whole number is a number; nothing else is turned into another type.
template <class T>
std::optional<T> exactly(const toml::node& node) {
  if constexpr (std::is_floating_point_v<T>) return node.is_number() ? node.value<T>() : std::nullopt;
  return node.value_exact<T>();
}

// One table of the text. A key that nobody asked for is an error: half a script proves nothing.
class Words {
 public:
  explicit Words(const toml::table& table) : table_(table) {}
  Words(const Words&) = delete;
  Words& operator=(const Words&) = delete;

  const toml::node* find(const char* key) {
    asked_.insert(key);
    return table_.get(key);
  }
  template <class T>
  void read(const char* key, T& to) {
    const toml::node* const node = find(key);
    if (node == nullptr) return;
    using Stored = std::conditional_t<std::is_same_v<T, std::uint32_t> || std::is_same_v<T, int>, std::int64_t, T>;
    const auto value = exactly<Stored>(*node);
    if (!value) wrong(std::string(key) + " is of another type");
    to = static_cast<T>(*value);
  }
  template <class T>
  void read_list(const char* key, std::vector<T>& to) {
    const toml::node* const node = find(key);
    if (node == nullptr) return;
    if (!node->is_array()) wrong(std::string(key) + " is no list");
    to.clear();
    for (const toml::node& one : *node->as_array()) {
      using Stored = std::conditional_t<std::is_floating_point_v<T>, double, std::int64_t>;
      const auto value = exactly<Stored>(one);
      if (!value) wrong(std::string(key) + " is of another type");
      to.push_back(static_cast<T>(*value));
    }
  }
  // "a list of tables" or one table; nothing when it is not there.
  template <class Use>
  void each(const char* key, Use use) {
    const toml::node* const node = find(key);
    if (node == nullptr) return;
    if (const toml::table* const one = node->as_table()) return use_table(*one, use);
    if (!node->is_array()) wrong(std::string(key) + " is no table");
    for (const toml::node& one : *node->as_array()) {
      if (!one.is_table()) wrong(std::string(key) + " has something that is no table");
      use_table(*one.as_table(), use);
    }
  }
  void done() const {
    for (const auto& [key, node] : table_) {
      if (!asked_.contains(std::string_view(key))) wrong("unknown word: " + std::string(std::string_view(key)));
    }
  }

 private:
  template <class Use>
  static void use_table(const toml::table& table, Use use) {
    Words words(table);
    use(words);
    words.done();
  }

  const toml::table& table_;
  std::set<std::string, std::less<>> asked_;
};

// position [m]; yaw (to the left), pitch (up), roll (to the left) [degrees]
Pose read_pose(Words& words) {
  std::vector<double> position{0.0, 0.0, 0.0};
  double yaw = 0.0, pitch = 0.0, roll = 0.0;
  words.read_list("position", position);
  if (position.size() != 3) wrong("position has three numbers");
  words.read("yaw", yaw);
  words.read("pitch", pitch);
  words.read("roll", roll);
  const auto turn = [](double degrees, glm::dvec3 axis) { return glm::angleAxis(degrees * kDegree, axis); };
  return {{position[0], position[1], position[2]},
          turn(yaw, {0.0, 1.0, 0.0}) * turn(pitch, {1.0, 0.0, 0.0}) * turn(roll, {0.0, 0.0, 1.0})};
}

struct PoseKey {
  double at = 0.0;  // [s]
  Pose pose;
};

// Straight between the keys, still before the first and after the last.
Pose between(const std::vector<PoseKey>& keys, double t) {
  const auto next = std::find_if(keys.begin(), keys.end(), [&](const PoseKey& key) { return key.at > t; });
  if (next == keys.begin()) return keys.front().pose;
  if (next == keys.end()) return keys.back().pose;
  const PoseKey& last = *(next - 1);
  const double share = (t - last.at) / (next->at - last.at);
  return {last.pose.position * (1.0 - share) + next->pose.position * share,
          glm::slerp(last.pose.orientation, next->pose.orientation, share)};
}

void read_path(Words& words, const char* key, std::function<Pose(double)>& to) {
  std::vector<PoseKey> keys;
  words.each(key, [&](Words& one) {
    double at = 0.0;
    one.read("at", at);
    if (!keys.empty() && at <= keys.back().at) wrong(std::string(key) + ": times must grow");
    keys.push_back({at, read_pose(one)});
  });
  if (!keys.empty()) to = [keys](double t) { return between(keys, t); };
}

void read_hand(Words& words, const char* key, Hand& hand) {
  words.each(key, [&](Words& one) {
    read_path(one, "aim", hand.aim);
    read_path(one, "grip", hand.grip);
  });
}

// A value holds until the next one; before the first it is zero.
void read_input(Words& words, Script& script) {
  std::string path;
  std::vector<double> at, value;
  words.read("path", path);
  words.read_list("at", at);
  words.read_list("value", value);
  if (at.size() != value.size() || !std::is_sorted(at.begin(), at.end()))
    wrong("input: a value for each time, in order");
  script.inputs[path] = [at, value](double t) {
    const auto after = std::upper_bound(at.begin(), at.end(), t) - at.begin();
    return after == 0 ? 0.0 : value[static_cast<std::size_t>(after) - 1];
  };
}

Event::What event_word(const std::string& word) {
  using What = Event::What;
  static const std::map<std::string, What> words{{"focused", What::focused},
                                                 {"visible", What::visible},
                                                 {"synchronized", What::synchronized},
                                                 {"stopping", What::stopping},
                                                 {"ready", What::ready},
                                                 {"loss_pending", What::loss_pending},
                                                 {"instance_loss", What::instance_loss},
                                                 {"exit", What::exit},
                                                 {"space_change", What::space_change},
                                                 {"profile", What::profile},
                                                 {"hidden", What::hidden},
                                                 {"stall", What::stall}};
  const auto found = words.find(word);
  if (found == words.end()) wrong("event: " + word);
  return found->second;
}

void read_event(Words& words, Script& script) {
  Event event;
  std::string what, space = "local";
  words.read("at", event.at);
  words.read("what", what);
  event.what = event_word(what);
  words.read("space", space);
  if (space != "local" && space != "stage") wrong("space: local or stage");
  event.space = space == "stage" ? Space::stage : Space::local;
  event.pose = read_pose(words);
  words.read("frames_ahead", event.frames_ahead);
  words.read("profile", event.profile);
  words.read("span", event.span);
  words.read("periods", event.periods);
  script.timeline.push_back(event);
}

XrResult result_word(const std::string& word) {
#define GEARSHIFT_XR_RESULT(name, number) \
  if (word == #name) return name;
  XR_LIST_ENUM_XrResult(GEARSHIFT_XR_RESULT);
#undef GEARSHIFT_XR_RESULT
  wrong("result: " + word);
}

void read_failure(Words& words, Script& script) {
  Failure failure;
  std::string result = "XR_ERROR_RUNTIME_FAILURE";
  words.read("function", failure.function);
  words.read("result", result);
  words.read("nth", failure.nth);
  failure.result = result_word(result);
  script.failures.push_back(failure);
}

void read_size(Words& words, const char* key, std::uint32_t& width, std::uint32_t& height) {
  std::vector<std::uint32_t> size{width, height};
  words.read_list(key, size);
  if (size.size() != 2) wrong(std::string(key) + " is a width and a height");
  width = size[0];
  height = size[1];
}

void read_fov(Words& words, const char* eye, Fov& fov) {
  std::vector<double> degrees;
  words.read_list(eye, degrees);
  if (degrees.empty()) return;
  if (degrees.size() != 4) wrong("fov: left, right, up, down");
  fov = {degrees[0] * kDegree, degrees[1] * kDegree, degrees[2] * kDegree, degrees[3] * kDegree};
}

void read_headset(Words& words, Script& script) {
  words.read("headset", script.headset);
  words.read("vulkan_enable2", script.vulkan_enable2);
  words.read("composition_layer_depth", script.composition_layer_depth);
  words.read("convert_timespec_time", script.convert_timespec_time);
  words.read("stage", script.stage);
  words.each("stage_origin", [&](Words& one) { script.stage_origin = read_pose(one); });
  read_size(words, "recommended", script.recommended_width, script.recommended_height);
  read_size(words, "max", script.max_width, script.max_height);
  words.read("recommended_samples", script.recommended_samples);
  words.read("max_samples", script.max_samples);
  words.read("images", script.images);
  words.read_list("colour_formats", script.colour_formats);
  words.read_list("depth_formats", script.depth_formats);
  words.each("fov", [&](Words& one) {
    read_fov(one, "left", script.fov[0]);
    read_fov(one, "right", script.fov[1]);
  });
  words.read("eye_distance", script.eye_distance);
  words.read("period", script.period);
}

void read_play(Words& words, Script& script) {
  std::string pacing = "stepped";
  words.read("pacing", pacing);
  if (pacing != "stepped" && pacing != "real") wrong("pacing: stepped or real");
  script.pacing = pacing == "real" ? Pacing::real : Pacing::stepped;
  words.read("polls_before_ready", script.polls_before_ready);
  read_path(words, "head", script.head);
  words.each("tracking_gap", [&](Words& one) {
    Gap gap;
    one.read("from", gap.from);
    one.read("until", gap.until);
    one.read("valid", gap.valid);
    script.tracking_gaps.push_back(gap);
  });
  words.read("early_error", script.early_error);
  read_hand(words, "left", script.hands[0]);
  read_hand(words, "right", script.hands[1]);
  words.read("profile", script.profile);
  words.each("input", [&](Words& one) { read_input(one, script); });
  words.each("event", [&](Words& one) { read_event(one, script); });
  words.each("failure", [&](Words& one) { read_failure(one, script); });
  words.each("capture", [&](Words& one) {
    one.read("every", script.capture.every);
    one.read_list("only", script.capture.only);
    one.read("depth", script.capture.depth);
  });
}

}  // namespace

Script read_script(const std::filesystem::path& file) {
  const toml::table table = toml::parse_file(file.string());
  Words words(table);
  Script script;
  read_headset(words, script);
  read_play(words, script);
  words.done();
  return script;
}

}  // namespace gearshift::xr_test
