// A GPU device for tests: the software driver with core and synchronization validation. Any validation message fails
// the test.
#pragma once

#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "engine/gpu/gpu.h"

namespace gearshift::test {

// Selects the software driver on every machine, because tests compare pictures. Variables that are already set stay
// unchanged.
inline void choose_software_driver() {
  const std::filesystem::path drivers = "/usr/share/vulkan/icd.d";
  if (std::filesystem::is_directory(drivers)) {
    for (const auto& file : std::filesystem::directory_iterator(drivers)) {
      const std::string name = file.path().filename().string();
      if (name.rfind("lvp_icd.", 0) == 0) setenv("VK_ICD_FILENAMES", file.path().c_str(), 0);
    }
  }
  const std::string folder =
      (std::filesystem::temp_directory_path() / ("gearshift_runtime_" + std::to_string(getuid()))).string();
  mkdir(folder.c_str(), 0700);  // without this folder, lavapipe floods stderr
  setenv("XDG_RUNTIME_DIR", folder.c_str(), 0);
}

class GpuFixture {
 public:
  explicit GpuFixture(engine::GpuConfig config = {}) {
    choose_software_driver();
    config.validation = true;
    config.on_validation = [this](std::string_view message) { messages_.emplace_back(message); };
    gpu_ = std::make_unique<engine::Gpu>(config);
    REQUIRE_MESSAGE(gpu_->validates(), "the package vulkan-validationlayers is not installed");
  }
  ~GpuFixture() {
    gpu_.reset();  // now, because the validation layer then reports objects that outlive the device
    for (const std::string& message : messages_) FAIL_CHECK(message);
  }
  GpuFixture(const GpuFixture&) = delete;
  GpuFixture& operator=(const GpuFixture&) = delete;

  engine::Gpu& gpu() { return *gpu_; }
  bool silent() const { return messages_.empty(); }
  // Returns and clears the validation messages so far. The returned messages do not fail the test.
  std::vector<std::string> take_messages() { return std::exchange(messages_, {}); }

 private:
  std::vector<std::string> messages_;
  std::unique_ptr<engine::Gpu> gpu_;
};

}  // namespace gearshift::test
