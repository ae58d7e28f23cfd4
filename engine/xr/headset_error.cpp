#include <string>

#include "engine/xr/openxr.h"

namespace gearshift::engine {
namespace {

#define GEARSHIFT_XR_CASE(name, value) \
  case value:                          \
    return #name;

// Used instead of xrResultToString, which needs an OpenXR instance, because there may be no instance here.
const char* to_string(XrResult result) {
  switch (result) {
    XR_LIST_ENUM_XrResult(GEARSHIFT_XR_CASE);
    default:
      return "an unknown error";
  }
}

#undef GEARSHIFT_XR_CASE

}  // namespace

void check(XrResult result, const char* what) {
  if (XR_SUCCEEDED(result)) return;
  const std::string sentence = std::string(what) + " failed: " + to_string(result);
  switch (result) {
    case XR_ERROR_SESSION_LOST:
    case XR_ERROR_INSTANCE_LOST:
    case XR_ERROR_RUNTIME_FAILURE:
      throw HeadsetLost(sentence);
    case XR_ERROR_FORM_FACTOR_UNAVAILABLE:
      throw HeadsetAbsent(sentence);
    default:
      throw HeadsetError(sentence);
  }
}

}  // namespace gearshift::engine
