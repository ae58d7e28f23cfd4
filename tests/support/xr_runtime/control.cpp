// Gives the test access to the runtime's control object, and to the messages of Khronos' validation layer.
#include "tests/support/xr_runtime/control.h"

#include <dlfcn.h>
#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

namespace gearshift::xr_test {
namespace {

constexpr const char* kLayer = "XR_APILAYER_LUNARG_core_validation";

void require_layer() {
  std::uint32_t count = 0;
  xrEnumerateApiLayerProperties(0, &count, nullptr);
  std::vector<XrApiLayerProperties> layers(count, {XR_TYPE_API_LAYER_PROPERTIES, nullptr, {}, {}, {}, {}});
  xrEnumerateApiLayerProperties(count, &count, layers.data());
  const auto is_wanted = [](const auto& layer) { return std::strcmp(layer.layerName, kLayer) == 0; };
  if (std::none_of(layers.begin(), layers.end(), is_wanted)) {
    throw std::runtime_error(std::string("tests of the headset need the OpenXR layer ") + kLayer +
                             " (Debian: openxr-layer-corevalidation)");
  }
}

// The validation layer creates this file when it has something to report.
const std::string& layer_file() {
  static const std::string file =
      std::filesystem::temp_directory_path() / ("gearshift_xr_" + std::to_string(getpid()) + ".txt");
  return file;
}

}  // namespace

Control& control() {
  static Control* const loaded = [] {
    require_layer();
    setenv("XR_RUNTIME_JSON", GEARSHIFT_XR_TEST_MANIFEST, 1);
    setenv("XR_ENABLE_API_LAYERS", kLayer, 1);
    setenv("XR_CORE_VALIDATION_EXPORT_TYPE", "text", 1);
    setenv("XR_CORE_VALIDATION_FILE_NAME", layer_file().c_str(), 1);
    // The OpenXR loader will open the same library. So the test and the tested program share one runtime.
    void* const library = dlopen(GEARSHIFT_XR_TEST_RUNTIME, RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) throw std::runtime_error(dlerror());
    using Get = Control* (*)();
    const auto get = reinterpret_cast<Get>(dlsym(library, "gearshift_xr_test_control"));
    if (get == nullptr) throw std::runtime_error(dlerror());
    return get();
  }();
  return *loaded;
}

std::string complaints() {
  std::ostringstream text;
  std::ifstream messages(layer_file());
  for (std::string line; std::getline(messages, line);)
    if (line.find("VALID_DEBUG") == std::string::npos) text << line << "\n";  // not a complaint: the layer has started
  std::filesystem::remove(layer_file());
  Record& record = control().record;
  for (const std::string& violation : record.violations) text << violation << "\n";
  record.violations.clear();
  return text.str();
}

}  // namespace gearshift::xr_test
