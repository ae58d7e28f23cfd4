// Script files of the OpenXR test runtime.
#include <filesystem>
#include <fstream>
#include <sstream>

#include <doctest/doctest.h>

#include "tests/support/temp_folder.h"
#include "tests/support/xr_runtime/control.h"

namespace gearshift::xr_test {
namespace {

Script read_text(const std::string& text) {
  const test::TempFolder folder;
  const std::filesystem::path file = folder.path() / "script.toml";
  std::ofstream(file) << text;
  return control().read_script(file.c_str());
}

constexpr const char* kScript = R"(
stage_origin = {position = [0, -1, 0], yaw = 90}
head = [{at = 0, position = [0, 1, 0]}, {at = 1, position = [2, 1, 0], yaw = 90}]
right = [{position = [1, 2, 3]}]
capture_every = 5
[[event]]
at = 0.1
what = "stall"
periods = 7
[[input]]
path = "/user/hand/left/input/trigger/value"
at = [0.5, 1]
value = [0.25, 0]
[[failure]]
function = "xrEndFrame"
result = "XR_ERROR_SESSION_LOST"
nth = 3
)";

}  // namespace

TEST_CASE("script keys set the control's fields, and an unknown key is rejected") {
  const Script script = read_text(kScript);
  CHECK(script.head(0.5).position.x == 1.0);
  CHECK(glm::angle(script.head(0.5).orientation) == doctest::Approx(45 * kDegree));
  CHECK(script.head(7.0).position.x == 2.0);
  CHECK(script.aim[1](0.0).position.z == 3.0);
  CHECK(script.capture_every == 5);
  REQUIRE(script.timeline.size() == 1);
  CHECK(script.timeline[0].kind == Event::Kind::stall);
  CHECK(script.timeline[0].periods == 7);
  const auto& pull = script.inputs.at("/user/hand/left/input/trigger/value");
  CHECK(pull(0.4) == 0.0);
  CHECK(pull(0.5) == 0.25);
  CHECK(pull(3.0) == 0.0);
  REQUIRE(script.failures.size() == 1);
  CHECK(script.failures[0].result == XR_ERROR_SESSION_LOST);
  for (const char* const wrong :
       {"headsets = true", "event = {at = 1, what = 'exits'}", "headset = 1", "head = 3", "pacing = 'x'",
        "failure = {function = 'xrEndFrame', result = 'XR_NONSENSE'}", "tracking_gap = {form = 1}", "= 1"}) {
    CAPTURE(wrong);
    CHECK_THROWS_AS(read_text(wrong), std::runtime_error);
  }
}

TEST_CASE("the script in the runtime's README is valid") {
  std::ostringstream readme;
  readme << std::ifstream(std::filesystem::path(GEARSHIFT_TEST_DATA) / "../support/xr_runtime/README.md").rdbuf();
  const std::string text = readme.str(), fence = "```toml\n";
  const std::size_t start = text.find(fence) + fence.size();
  const Script script = read_text(text.substr(start, text.find("```", start) - start));
  CHECK(script.aim[0](0.0).position.z == -0.4);
  CHECK(script.failures.size() == 1);
  CHECK(script.tracking_gaps.size() == 1);
}

}  // namespace gearshift::xr_test
