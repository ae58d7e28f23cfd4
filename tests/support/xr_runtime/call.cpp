// Code that runs in every OpenXR function: checks of handles, structures and rules; injected failures; the log.
#include <algorithm>
#include <cstring>

#include "tests/support/xr_runtime/rules.h"
#include "tests/support/xr_runtime/script.h"
#include "tests/support/xr_runtime/state.h"

namespace gearshift::xr_test {
namespace {

void restart(Control& control) {
  State& s = state();
  const std::lock_guard lock(s.mutex);
  control.record = {};
  s.events.clear();
  s.begin = 0;
  s.next_step = 0;
  s.hidden_until = -1.0;
  s.origins.clear();
  count_live();
}

template <class Handle, class Object>
Object& find_or_reject(const Table<Handle, Object>& table, Handle handle) {
  Object* const object = table.find(handle);
  if (object == nullptr) reject_call(XR_ERROR_HANDLE_INVALID);
  return *object;
}

struct Header {
  XrStructureType type;
  const void* next;
};

}  // namespace

State& state() {
  static State* const one = [] {
    auto* const created = new State;  // never deleted, because it must outlive the destructors of the loader
    created->control.rules = rules();
    created->control.restart = restart;
    created->control.read_script = [](const char* file) { return read_script(file); };
    read_flow_script(created->control);
    return created;
  }();
  return *one;
}

void reject_call(XrResult result) {
  throw CallRejected{result};
}

XrResult write_violation(const char* id, const std::string& detail) {
  State& s = state();
  const Rule& broken = rule(id);
  s.control.record.violations.push_back({id, s.function, detail});
  log_line(std::string("violation ") + id + " " + s.function + (detail.empty() ? "" : ": " + detail));
  return broken.result;
}

std::optional<XrResult> injected_failure(const char* function) {
  std::vector<Failure>& failures = state().control.script.failures;
  for (auto failure = failures.begin(); failure != failures.end(); ++failure) {
    if (failure->function != function || --failure->nth > 0) continue;
    const XrResult result = failure->result;
    failures.erase(failure);
    log_line(std::string("planted ") + function + " " + std::to_string(result));
    return result;
  }
  return std::nullopt;
}

void log_line(const std::string& line) {
  state().control.record.log.push_back(line);
  write_log(line);
}

void count_live() {
  State& s = state();
  s.control.record.live = {{"instance", s.instances.size()},     {"session", s.sessions.size()},
                           {"space", s.spaces.size()},           {"swapchain", s.swapchains.size()},
                           {"action set", s.action_sets.size()}, {"action", s.actions.size()}};
}

void leak(State& s, const char* kind, const char* parent) {
  s.control.record.leaks.push_back(std::string(kind) + " of " + parent);
  log_line("leak " + s.control.record.leaks.back());
}

InstanceObject& live(XrInstance handle) {
  InstanceObject& instance = find_or_reject(state().instances, handle);
  if (instance.lost) reject_call(XR_ERROR_INSTANCE_LOST);
  return instance;
}

SessionObject& live(XrSession handle) {
  SessionObject& session = find_or_reject(state().sessions, handle);
  live(session.instance);
  if (session.lost) reject_call(XR_ERROR_SESSION_LOST);
  return session;
}

SpaceObject& live(XrSpace handle) {
  SpaceObject& space = find_or_reject(state().spaces, handle);
  live(space.session);
  return space;
}

SwapchainObject& live(XrSwapchain handle) {
  SwapchainObject& swapchain = find_or_reject(state().swapchains, handle);
  live(swapchain.session);
  return swapchain;
}

ActionSetObject& live(XrActionSet handle) {
  ActionSetObject& set = find_or_reject(state().action_sets, handle);
  live(set.instance);
  return set;
}

ActionObject& live(XrAction handle) {
  ActionObject& action = find_or_reject(state().actions, handle);
  live(action.set);
  return action;
}

const void* find_chained(const void* value, XrStructureType type) {
  auto* next = static_cast<const Header*>(static_cast<const Header*>(value)->next);
  while (next != nullptr && next->type != type) next = static_cast<const Header*>(next->next);
  return next;
}

}  // namespace gearshift::xr_test

extern "C" __attribute__((visibility("default"))) gearshift::xr_test::Control* gearshift_xr_test_control() {
  return &gearshift::xr_test::state().control;
}
