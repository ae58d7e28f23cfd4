// An XrPath is the number of a path string in its instance.
#include <algorithm>
#include <cstring>
#include <string_view>

#include "tests/support/xr_runtime/functions.h"
#include "tests/support/xr_runtime/state.h"

namespace gearshift::xr_test {
namespace {

bool is_well_formed_path(std::string_view path) {
  if (path.size() < 2 || path.size() >= XR_MAX_PATH_LENGTH || path[0] != '/') return false;
  while (!path.empty()) {
    path.remove_prefix(1);
    const std::string_view part = path.substr(0, path.find('/'));
    if (!is_path_part(part)) return false;
    path.remove_prefix(part.size());
  }
  return true;
}

}  // namespace

bool is_path_part(std::string_view part) {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '_' || c == '.';
  };
  const bool only_dots = part.find_first_not_of('.') == std::string_view::npos;
  return !part.empty() && !only_dots && std::all_of(part.begin(), part.end(), allowed);
}

const std::string& path_string(const InstanceObject& instance, XrPath path) {
  require(path >= 1 && path <= instance.paths.size(), "path_known", std::to_string(path));
  return instance.paths[path - 1];
}

int hand_of(XrPath path, const InstanceObject& instance) {
  const std::string& text = path_string(instance, path);
  return text.starts_with("/user/hand/left") ? 0 : text.starts_with("/user/hand/right") ? 1 : -1;
}

XrPath path_number(InstanceObject& instance, const std::string& text) {
  const auto known = std::find(instance.paths.begin(), instance.paths.end(), text);
  if (known != instance.paths.end()) return static_cast<XrPath>(known - instance.paths.begin()) + 1;
  instance.paths.push_back(text);
  return instance.paths.size();
}

XrResult fill_text(std::uint32_t capacity, std::uint32_t* count, char* buffer, const std::string& text) {
  return fill(capacity, count, buffer, std::string_view(text.c_str(), text.size() + 1));
}

namespace xr {

XrResult XRAPI_CALL StringToPath(XrInstance instance, const char* text, XrPath* path) {
  return call("xrStringToPath", [&](State&) {
    InstanceObject& object = live(instance);
    require(is_well_formed_path(text), "path_format", text);
    *path = path_number(object, text);
    return XR_SUCCESS;
  });
}

XrResult XRAPI_CALL PathToString(XrInstance instance, XrPath path, std::uint32_t capacity, std::uint32_t* count,
                                 char* buffer) {
  return call("xrPathToString",
              [&](State&) { return fill_text(capacity, count, buffer, path_string(live(instance), path)); });
}

}  // namespace xr
}  // namespace gearshift::xr_test
