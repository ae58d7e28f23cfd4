// Runs the OpenXR test runtime in a separate program. The script and the results are passed in files.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/engine/xr/runtime_client.h"
#include "tests/support/temp_folder.h"

namespace gearshift::xr_test {
namespace {

void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file) << text;
}

std::string read_text(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

constexpr const char* kFlow = R"(
early_error = 0.5
period = 0.01
stage_origin = {position = [0, -1, 0], yaw = 90}
head = [{at = 0, position = [0, 1, 0]}, {at = 1, position = [2, 1, 0], yaw = 90}]
fov = {left = [-45, 40, 41, -42]}
capture = {only = [5], depth = false}
[[event]]
at = 0.1
what = "exit"
[[input]]
path = "/user/hand/left/input/trigger/value"
at = [0.5, 1]
value = [0.25, 0]
[[failure]]
function = "xrStopHapticFeedback"
result = "XR_ERROR_SESSION_LOST"
nth = 3
)";

// The test case below runs this one in a separate process, with an environment variable that names the script.
TEST_CASE("a flow's program" * doctest::skip()) {
  Client program;
  program.poll();
  REQUIRE(program.begin() == XR_SUCCESS);
  while (program.state != XR_SESSION_STATE_STOPPING) program.run(1);
  REQUIRE(xrEndSession(program.session) == XR_SUCCESS);
  program.poll();
}

TEST_CASE("a program unaware of the script plays it, and leaves a log and pictures") {
  const test::TempFolder folder;
  const std::filesystem::path& out = folder.path();
  write_text(out / "flow.toml", kFlow);
  const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
  const std::string command = "GEARSHIFT_XR_SCRIPT=" + (out / "flow.toml").string() +
                              " GEARSHIFT_XR_OUT=" + out.string() + " " + self +
                              " --no-skip --test-case=\"a flow's program\" > /dev/null";
  REQUIRE(std::system(command.c_str()) == 0);
  const std::string log = read_text(out / "log.txt");
  CAPTURE(log);
  for (const char* const line :
       {"state FOCUSED\n", "frame 5 t=0.050000 shown layers=2 locates=1 projection+depth quad\n", "state STOPPING\n",
        "state EXITING\n"}) {
    CHECK(log.find(line) != std::string::npos);
  }
  CHECK(log.find("violation") == std::string::npos);
  CHECK(log.find("leak") == std::string::npos);
  const engine::Image left = engine::read_png(out / "frame_000005_left.png");
  CHECK(left.width == 64);
  CHECK(left.pixel(0, 0)[0] == 255);
  CHECK(engine::read_png(out / "frame_000005_quad.png").pixel(0, 0)[1] == 255);
  CHECK(std::filesystem::exists(out / "frame_000005_right.png"));
  CHECK_FALSE(std::filesystem::exists(out / "frame_000004_left.png"));
}

TEST_CASE("script keys set the control's fields, and an unknown key is rejected") {
  const test::TempFolder folder;
  const std::string file = (folder.path() / "script.toml").string();
  write_text(file, kFlow);
  const Script script = control().read_script(file.c_str());
  CHECK(script.early_error == 0.5);
  CHECK(script.head(0.5).position.x == 1.0);
  CHECK(glm::angle(script.head(0.5).orientation) == doctest::Approx(45 * kDegree));
  CHECK(script.head(7.0).position.x == 2.0);
  CHECK(script.fov[0].up == doctest::Approx(41 * kDegree));
  CHECK(script.fov[1].up == doctest::Approx(44 * kDegree));
  REQUIRE(script.timeline.size() == 1);
  CHECK(script.timeline[0].kind == Event::Kind::exit);
  const auto& pull = script.inputs.at("/user/hand/left/input/trigger/value");
  CHECK(pull(0.4) == 0.0);
  CHECK(pull(0.5) == 0.25);
  CHECK(pull(3.0) == 0.0);
  REQUIRE(script.failures.size() == 1);
  CHECK(script.failures[0].result == XR_ERROR_SESSION_LOST);
  CHECK_FALSE(script.capture.depth);
  for (const char* const wrong :
       {"headsets = true", "event = {at = 1, what = 'exits'}", "headset = 1", "head = 3", "period = 'x'",
        "failure = {function = 'xrEndFrame', result = 'XR_NONSENSE'}", "capture = {ever = 1}", "= 1"}) {
    CAPTURE(wrong);
    write_text(file, wrong);
    CHECK_THROWS_AS(control().read_script(file.c_str()), std::runtime_error);
  }
}

TEST_CASE("the script in the runtime's README is valid") {
  const test::TempFolder folder;
  const std::string file = (folder.path() / "script.toml").string();
  const std::string readme = read_text(std::filesystem::path(GEARSHIFT_TEST_DATA) / "../support/xr_runtime/README.md");
  const std::string fence = "```toml\n";
  const std::size_t start = readme.find(fence) + fence.size();
  write_text(file, readme.substr(start, readme.find("```", start) - start));
  const Script script = control().read_script(file.c_str());
  CHECK(script.hands[0].aim(0.0).position.z == -0.4);
  CHECK(script.failures.size() == 1);
  CHECK(script.tracking_gaps.size() == 1);
}

}  // namespace
}  // namespace gearshift::xr_test
