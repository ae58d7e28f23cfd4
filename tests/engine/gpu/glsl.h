// Compiles shaders whose source text is in the test.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tests/support/temp_folder.h"

namespace gearshift::test {

// Compiles GLSL to SPIR-V with glslangValidator, which the build requires anyway. `stage`: "vert" or "frag".
inline std::vector<std::uint32_t> compile_glsl(const std::string& stage, const std::string& source) {
  const TempFolder folder;
  const std::string in = (folder / ("shader." + stage)).string();
  const std::string out = (folder / "shader.spv").string();
  std::ofstream(in) << source;
  const std::string command = "glslangValidator -V --quiet --target-env vulkan1.3 -o " + out + " " + in;
  REQUIRE(std::system(command.c_str()) == 0);
  std::ifstream file(out, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  std::vector<std::uint32_t> words(bytes.size() / 4);
  bytes.copy(reinterpret_cast<char*>(words.data()), bytes.size());
  return words;
}

}  // namespace gearshift::test
