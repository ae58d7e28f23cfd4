// Controllers of the OpenXR test runtime: bound inputs can be read, vibrated and located while the session is focused.
#include "tests/engine/xr/runtime_controls.h"

namespace gearshift::xr_test {
namespace {

XrPath current_profile(const Client& program, XrPath hand) {
  XrInteractionProfileState state{XR_TYPE_INTERACTION_PROFILE_STATE};
  REQUIRE(xrGetCurrentInteractionProfile(program.session, hand, &state) == XR_SUCCESS);
  return state.interactionProfile;
}

void aim_spaces(const Client& program, const Controls& controls, XrSpace (&spaces)[2]) {
  for (int hand = 0; hand < 2; ++hand) {
    const XrActionSpaceCreateInfo info{XR_TYPE_ACTION_SPACE_CREATE_INFO, nullptr, controls.aim, controls.hands[hand],
                                       kIdentity};
    REQUIRE(xrCreateActionSpace(program.session, &info, &spaces[hand]) == XR_SUCCESS);
  }
}

TEST_CASE("inputs reach the actions that are bound to them") {
  Control& xr = control();
  xr.start();
  xr.script.inputs["/user/hand/left/input/trigger/value"] = [](double t) { return t < 0.06 ? 0.25 : 0.75; };
  xr.script.inputs["/user/hand/left/input/squeeze/value"] = [](double) { return 0.9; };
  xr.script.inputs["/user/hand/left/input/thumbstick/x"] = [](double) { return -0.5; };
  xr.script.inputs["/user/hand/left/input/thumbstick/y"] = [](double) { return 0.125; };
  xr.script.hands[0].aim = [](double t) { return Pose{.position = {-0.2, t, 0.0}}; };
  xr.script.hands[1].grip = [](double) { return Pose{.position = {0.2, 0.0, -0.3}, .tracked = false}; };
  Client program;
  const Controls controls(program);
  REQUIRE(controls.suggest_all() == XR_SUCCESS);
  REQUIRE(controls.attach() == XR_SUCCESS);
  XrSpace aim[2];
  aim_spaces(program, controls, aim);
  program.begin_and_focus();
  CHECK_FALSE(controls.read_float(controls.pull, 0).isActive);
  REQUIRE(controls.sync() == XR_SUCCESS);
  CHECK(controls.read_float(controls.pull, 0).currentState == 0.25f);
  CHECK(controls.read_float(controls.pull, 1).currentState == 0.0f);
  CHECK(controls.read_float(controls.pull, 1).isActive);
  CHECK(controls.read_float(controls.pull, -1).currentState == 0.25f);
  CHECK(controls.read_bool(controls.press, 0).currentState);
  CHECK_FALSE(controls.read_bool(controls.press, 1).currentState);
  const XrActionStateGetInfo move = controls.get(controls.move, 0);
  XrActionStateVector2f stick{XR_TYPE_ACTION_STATE_VECTOR2F};
  REQUIRE(xrGetActionStateVector2f(program.session, &move, &stick) == XR_SUCCESS);
  CHECK(stick.currentState.x == -0.5f);
  CHECK(stick.currentState.y == 0.125f);

  program.run(3);
  CHECK(controls.read_float(controls.pull, 0).currentState == 0.25f);  // the old value remains until the next sync()
  REQUIRE(controls.sync() == XR_SUCCESS);
  const XrActionStateFloat pulled = controls.read_float(controls.pull, 0);
  CHECK(pulled.currentState == 0.75f);
  CHECK(pulled.changedSinceLastSync);
  CHECK(pulled.lastChangeTime == program.frame.predictedDisplayTime);

  XrSpaceVelocity velocity{XR_TYPE_SPACE_VELOCITY};
  XrSpaceLocation location{XR_TYPE_SPACE_LOCATION, &velocity, 0, {}};
  REQUIRE(xrLocateSpace(aim[0], program.local, program.frame.predictedDisplayTime, &location) == XR_SUCCESS);
  CHECK(location.pose.position.y == doctest::Approx(6.0 / 90.0));
  CHECK(velocity.linearVelocity.y == doctest::Approx(1.0).epsilon(1e-4));
  location.next = nullptr;
  REQUIRE(xrLocateSpace(aim[1], program.local, program.frame.predictedDisplayTime, &location) == XR_SUCCESS);
  CHECK(location.pose.position.z == -0.3f);
  CHECK((location.locationFlags & XR_SPACE_LOCATION_POSITION_TRACKED_BIT) == 0);

  REQUIRE(controls.pulse(0.5f, controls.buzz, 1) == XR_SUCCESS);
  REQUIRE(xr.record.pulses.size() == 1);
  CHECK(xr.record.pulses[0].hand == 1);
  CHECK(xr.record.pulses[0].seconds == doctest::Approx(0.05));
  for (const XrSpace space : aim) xrDestroySpace(space);
  CHECK(xr.record.violations.empty());
}

TEST_CASE("without focus no action is active; changed controllers appear with the next sync") {
  Control& xr = control();
  xr.start();
  xr.script.timeline = {visible(0.06), focused(0.08), change_profile(0.12, kSimpleController),
                        change_profile(0.16, "")};
  Client program;
  const Controls controls(program);
  REQUIRE(controls.suggest_all() == XR_SUCCESS);
  REQUIRE(controls.suggest(kSimpleController, {{controls.press, "/user/hand/left/input/select/click"}}) == XR_SUCCESS);
  REQUIRE(controls.attach() == XR_SUCCESS);
  int changes = 0;
  program.on_event = [&](const XrEventDataBuffer& event) {
    if (event.type == XR_TYPE_EVENT_DATA_INTERACTION_PROFILE_CHANGED) ++changes;
  };
  program.begin_and_focus();
  REQUIRE(controls.sync() == XR_SUCCESS);
  CHECK(current_profile(program, controls.hands[0]) == path(program.instance, kTouchController));
  program.run(3);
  CHECK(controls.sync() == XR_SESSION_NOT_FOCUSED);
  CHECK_FALSE(controls.read_float(controls.pull, 0).isActive);
  program.run(5);
  REQUIRE(controls.sync() == XR_SUCCESS);
  program.run(1);
  CHECK(current_profile(program, controls.hands[0]) == path(program.instance, kSimpleController));
  CHECK_FALSE(controls.read_float(controls.pull, 0).isActive);
  CHECK(controls.read_bool(controls.press, 0).isActive);
  program.run(4);
  REQUIRE(controls.sync() == XR_SUCCESS);
  program.run(1);
  CHECK(current_profile(program, controls.hands[0]) == XR_NULL_PATH);
  CHECK(changes == 3);
  CHECK(xr.record.violations.empty());
}

}  // namespace
}  // namespace gearshift::xr_test
