// For flow tests, which run the whole program. Reads the script from a file, and writes log and pictures to a folder.
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tests/support/xr_runtime/script.h"
#include "tests/support/xr_runtime/state.h"

namespace gearshift::xr_test {
namespace {

const char* out_folder() {
  return std::getenv("GEARSHIFT_XR_OUT");
}

void write_picture(const FrameRecord& record, const std::string& what, const engine::Image& image) {
  if (image.rgba.empty()) return;
  std::array<char, 16> number{};
  std::snprintf(number.data(), number.size(), "%06llu", static_cast<unsigned long long>(record.index));
  engine::write_png(std::filesystem::path(out_folder()) / ("frame_" + std::string(number.data()) + "_" + what + ".png"),
                    image);
}

}  // namespace

void read_flow_script(Control& control) {
  const char* const file = std::getenv("GEARSHIFT_XR_SCRIPT");
  if (file == nullptr) return;
  try {
    control.script = read_script(file);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", file, error.what());
    std::abort();  // a test with an incomplete script would prove nothing
  }
}

void write_log(const std::string& line) {
  if (out_folder() == nullptr) return;
  // The file is closed after each line, so that no line is lost if the program crashes.
  std::ofstream(std::filesystem::path(out_folder()) / "log.txt", std::ios::app) << line << "\n";
}

void write_pictures(const FrameRecord& record) {
  if (out_folder() == nullptr) return;
  static constexpr const char* kEyes[] = {"left", "right"};
  int quads = 0;
  for (const LayerRecord& layer : record.layers) {
    if (layer.type == XR_TYPE_COMPOSITION_LAYER_QUAD) {
      write_picture(record, quads == 0 ? "quad" : "quad" + std::to_string(quads), layer.views[0].picture);
      ++quads;
      continue;
    }
    for (int eye = 0; eye < 2; ++eye)
      write_picture(record, kEyes[eye], layer.views[static_cast<std::size_t>(eye)].picture);
  }
}

}  // namespace gearshift::xr_test
