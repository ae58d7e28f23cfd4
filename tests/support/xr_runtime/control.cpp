// Gives the test access to the runtime's control object.
#include "tests/support/xr_runtime/control.h"

#include <dlfcn.h>
#include <stdlib.h>

#include <stdexcept>

namespace gearshift::xr_test {

Control& control() {
  static Control* const loaded = [] {
    setenv("XR_RUNTIME_JSON", GEARSHIFT_XR_TEST_MANIFEST, 1);
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

}  // namespace gearshift::xr_test
