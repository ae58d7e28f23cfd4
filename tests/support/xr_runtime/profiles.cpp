#include "tests/support/xr_runtime/profiles.h"

namespace gearshift::xr_test {
namespace {

struct Component {
  const char* profile;
  const char* hands;  // controllers that have the path: "l", "r" or "lr"
  const char* path;
};
constexpr const char* kSimple = "/interaction_profiles/khr/simple_controller";
constexpr const char* kTouch = "/interaction_profiles/oculus/touch_controller";
constexpr Component kComponents[] = {
    {kSimple, "lr", "input/select/click"},    {kSimple, "lr", "input/menu/click"},
    {kSimple, "lr", "input/grip/pose"},       {kSimple, "lr", "input/aim/pose"},
    {kSimple, "lr", "output/haptic"},         {kTouch, "l", "input/x/click"},
    {kTouch, "l", "input/x/touch"},           {kTouch, "l", "input/y/click"},
    {kTouch, "l", "input/y/touch"},           {kTouch, "l", "input/menu/click"},
    {kTouch, "r", "input/a/click"},           {kTouch, "r", "input/a/touch"},
    {kTouch, "r", "input/b/click"},           {kTouch, "r", "input/b/touch"},
    {kTouch, "r", "input/system/click"},      {kTouch, "lr", "input/squeeze/value"},
    {kTouch, "lr", "input/trigger/value"},    {kTouch, "lr", "input/trigger/touch"},
    {kTouch, "lr", "input/thumbstick/x"},     {kTouch, "lr", "input/thumbstick/y"},
    {kTouch, "lr", "input/thumbstick/click"}, {kTouch, "lr", "input/thumbstick/touch"},
    {kTouch, "lr", "input/thumbrest/touch"},  {kTouch, "lr", "input/grip/pose"},
    {kTouch, "lr", "input/aim/pose"},         {kTouch, "lr", "output/haptic"},
};

bool matches(std::string_view path, std::string_view component) {
  return path == component || (component.starts_with(path) && component.substr(path.size(), 1) == "/" &&
                               path.find('/') != std::string_view::npos);
}

}  // namespace

bool knows_profile(std::string_view profile) {
  return profile == kSimple || profile == kTouch;
}

bool has_source(std::string_view profile, std::string_view path) {
  const std::string_view left = "/user/hand/left/", right = "/user/hand/right/";
  const char hand = path.starts_with(left) ? 'l' : path.starts_with(right) ? 'r' : '?';
  if (hand == '?') return false;
  const std::string_view part = path.substr(hand == 'l' ? left.size() : right.size());
  for (const Component& one : kComponents) {
    if (profile != one.profile || std::string_view(one.hands).find(hand) == std::string_view::npos) continue;
    if (matches(part, one.path)) return true;
  }
  return false;
}

float read_scalar(const Script& script, const std::string& path, double t) {
  for (const char* const component : {"", "/value", "/click"}) {
    const auto input = script.inputs.find(path + component);
    if (input != script.inputs.end()) return static_cast<float>(input->second(t));
  }
  return 0.0f;
}

}  // namespace gearshift::xr_test
