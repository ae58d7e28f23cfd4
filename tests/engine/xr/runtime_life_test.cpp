// Tests of the OpenXR test runtime: the life of a session, and a correct run that violates no rule.
#include "tests/engine/xr/runtime_client.h"

namespace gearshift::xr_test {
namespace {

using States = std::vector<XrSessionState>;

TEST_CASE("a correct program violates no rule and leaves no objects") {
  Control& xr = control();
  xr.start();
  xr.script.capture.only = {3};
  {
    Client program;
    CHECK(program.poll() == States{XR_SESSION_STATE_IDLE, XR_SESSION_STATE_READY});
    REQUIRE(program.begin() == XR_SUCCESS);
    States states;
    for (int i = 0; i < 4; ++i) {
      program.run_frame();
      for (const XrSessionState one : program.poll()) states.push_back(one);
    }
    CHECK(states == States{XR_SESSION_STATE_SYNCHRONIZED, XR_SESSION_STATE_VISIBLE, XR_SESSION_STATE_FOCUSED});
    REQUIRE(xrRequestExitSession(program.session) == XR_SUCCESS);
    CHECK(program.poll() == States{XR_SESSION_STATE_VISIBLE, XR_SESSION_STATE_SYNCHRONIZED, XR_SESSION_STATE_STOPPING});
    REQUIRE(xrEndSession(program.session) == XR_SUCCESS);
    CHECK(program.poll() == States{XR_SESSION_STATE_IDLE, XR_SESSION_STATE_EXITING});
    CHECK(xr.record.live["space"] == 1);
    CHECK(xr.record.live["swapchain"] == 3);
  }
  CHECK(xr.record.live_handles() == 0);
  CHECK(xr.record.leaks.empty());
  for (const Violation& broken : xr.record.violations) FAIL_CHECK(broken.rule << " " << broken.function);

  REQUIRE(xr.record.frames.size() == 4);
  CHECK_FALSE(xr.record.frames[1].should_render);
  CHECK(xr.record.frames[1].layers.empty());
  const FrameRecord& shown = xr.record.frames[3];
  CHECK(shown.should_render);
  CHECK(shown.time == doctest::Approx(3.0 / 90.0));
  CHECK(shown.locates == 1);
  REQUIRE(shown.projection() != nullptr);
  REQUIRE(shown.quad() != nullptr);
  const ViewRecord& left = shown.projection()->views[0];
  CHECK(left.pose.position.x == doctest::Approx(-0.0315));
  CHECK(left.fov.left == doctest::Approx(-50 * kDegree));
  REQUIRE(left.picture.rgba.size() == 4 * 64 * 48);
  const std::uint8_t* const pixel = left.picture.pixel(10, 10);
  CHECK(std::vector<int>(pixel, pixel + 4) == std::vector{255, 0, 188, 255});  // stored as sRGB
  CHECK(left.depth.near_z == 0.1f);
  REQUIRE(left.depth.values.size() == 64 * 48);
  CHECK(left.depth.values[100] == 0.25f);
  const ViewRecord& quad = shown.quad()->views[0];
  CHECK(quad.pose.position.z == -1.0);
  REQUIRE(!quad.picture.rgba.empty());
  const std::uint8_t* const green = quad.picture.pixel(0, 0);
  CHECK(std::vector<int>(green, green + 4) == std::vector{0, 255, 0, 128});  // RGBA, although the image stores BGRA
  CHECK(xr.record.frames[2].projection()->views[0].picture.rgba.empty());
}

}  // namespace
}  // namespace gearshift::xr_test
