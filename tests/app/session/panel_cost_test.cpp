// The memory that a frame of the panel allocates and copies does not grow with the learner's history.
#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <new>
#include <string>

#include <doctest/doctest.h>
#include <fmt/core.h>

#include "app/lessons/history/history.h"
#include "app/session/session.h"
#include "engine/ui/ui.h"
#include "tests/support/temp_folder.h"
#include "tests/support/variable.h"

using namespace gearshift::engine;
using namespace gearshift::lessons;
using namespace gearshift::runtime;
using namespace gearshift::session;
using namespace gearshift::test;
using namespace gearshift::ui;

namespace {

struct Cost {
  std::uint64_t allocations = 0, bytes = 0;  // calls of operator new, and the sum of the sizes asked for
  bool operator==(const Cost&) const = default;
};

constinit thread_local Cost total;  // of this thread since its start

void* counted(std::size_t size) {
  ++total.allocations;
  total.bytes += size;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}

template <class Work>
Cost cost_of(const Work& work) {
  const Cost before = total;
  work();
  return {total.allocations - before.allocations, total.bytes - before.bytes};
}

}  // namespace

// These replace the operators of the whole test program. Over-aligned types are not counted. The nothrow form is
// replaced too, because a sanitizer's own one would not match the operator delete below.
void* operator new(std::size_t size) {
  return counted(size);
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return std::malloc(size == 0 ? 1 : size);
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace {

static_assert(
    requires(const Session& session) { session.panel_input(); }, "the panel's input is read, not computed");

constexpr std::array kTabs{"tab_lesson", "tab_history", "tab_tuning", "tab_setup", "tab_loop", "tab_presets"};

// Runs of the same lesson with the same result, so that histories differ only in their length.
void add_runs(History& history, int runs) {
  const std::int64_t session = history.begin_session(history.find_or_add_learner("Ada"), "test 1.0");
  LessonResult result;
  result.lesson = result.task = "up_through_the_gears";
  result.end = LessonEnd::done;
  result.duration = 30.0;
  result.grade = 9.0;
  result.passed = true;
  result.errors = {make_driving_error(ErrorKind::jerk, Severity::minor, 14.2, 9.7, 0)};
  result.errors[0].points = 1.0;
  result.shifts.resize(3);
  for (int i = 0; i < 3; ++i) result.shifts[static_cast<std::size_t>(i)].number = i;
  for (int i = 0; i < runs; ++i) {
    const std::int64_t run = history.begin_run(session, result, "recordings/a_drive_with_a_long_name.trace");
    history.end_run(run, result);
    history.add_comment(run, "An instructor", "Wait for the synchroniser: push, do not hit.");
  }
}

// A session at rest whose learner has this many runs, and its panel. Only the panel's frames are measured.
struct PanelBench {
  TempFolder folder;
  Variable config{"XDG_CONFIG_HOME", folder.path().c_str()};
  Variable data{"XDG_DATA_HOME", folder.path().c_str()};
  UiContext ui;
  UiEvents events;
  Panel panel;
  Session session;

  explicit PanelBench(int runs) : session(choice(runs)) {
    for (int i = 0; i < 60; ++i) session.advance(1.0 / 60.0);
    REQUIRE(session.events().empty());
    REQUIRE(session.coach().view().runs.size() == static_cast<std::size_t>(runs));
    for (int i = 0; i < 3; ++i) frame();  // a control has a position after two frames
  }

  SessionChoice choice(int runs) const {
    SessionChoice choice;
    choice.lesson = kNoLesson;
    choice.learner = "Ada";
    choice.hand = "grip";
    choice.history = folder / "history.db";
    choice.clock = RuntimeClock::virtual_time;
    choice.sound = SoundOutput::none;
    History history(choice.history, [] { return std::int64_t{1'800'000'000}; });
    add_runs(history, runs);
    return choice;
  }

  Cost frame() {
    ui.feed(events);
    ui.begin({});
    const Cost cost = cost_of([&] { (void)panel.draw(session.panel_input()); });
    ui.end();
    return cost;
  }

  // Clicks the control and returns the cost of a frame once the panel no longer changes.
  Cost frame_after(const char* control) {
    const std::optional<ControlRect> at = panel.control_rect(control);
    REQUIRE(at.has_value());
    events.mouse = 0.5 * (at->min + at->max);
    for (const bool down : {false, true, false}) {
      events.mouse_down[0] = down;
      frame();
    }
    for (int i = 0; i < 20; ++i) frame();
    const Cost cost = frame();
    CHECK(frame() == cost);
    return cost;
  }

  Cost open_newest_run() {
    frame_after("tab_history");
    const std::vector<RunRow>& runs = session.coach().view().runs;
    return runs.empty() ? Cost{} : frame_after(fmt::format("run: {}", runs.front().id).c_str());
  }

  // Replays a recording of the lever at rest, which is in no run of the history.
  Cost replay() {
    session.apply(ToggleRecording{});
    session.advance(0.5);
    session.apply(PanelCommands{ToggleRecording{}, ReplayLastRecording{}});
    REQUIRE(session.is_replaying());
    session.set_message("");  // the message names the file
    session.advance(1.0 / 60.0);
    for (int i = 0; i < 3; ++i) frame();  // a note moves the tabs
    return frame_after("tab_lesson");
  }

  // Cost of a copy of the panel's input, with the strings and lists in it.
  Cost copy() {
    const PanelInput input = session.panel_input();
    Cost cost = cost_of([&] { [[maybe_unused]] const PanelInput copy(input); });
    cost.bytes += sizeof(PanelInput);
    return cost;
  }
};

}  // namespace

TEST_CASE("a frame of the panel costs the same for every length of the history") {
  PanelBench none(0), ten(10), half(25), all(50);
  std::string figures = "0, 10, 25 and 50 runs";
  const auto measure = [&](const std::string& what, const auto& cost_in) {
    const std::array costs{cost_in(none), cost_in(ten), cost_in(half), cost_in(all)};
    figures += "\n" + what + ":";
    for (const Cost& cost : costs) figures += fmt::format(" {}/{}", cost.allocations, cost.bytes);
    CAPTURE(what);
    // The history tab draws those runs that are visible, which are fewer than 25.
    const Cost& few = costs[what == "tab_history" || what == "opened run" ? 2 : 0];
    CHECK(costs[3].allocations == few.allocations);
    // Less than one byte per run. The text may be some bytes longer, because the Loop tab shows measured times.
    CHECK(costs[3].bytes < few.bytes + 25);
  };
  measure("copy of the input", [](PanelBench& bench) { return bench.copy(); });
  for (const char* tab : kTabs) measure(tab, [tab](PanelBench& bench) { return bench.frame_after(tab); });
  measure("opened run", [](PanelBench& bench) { return bench.open_newest_run(); });
  measure("replay", [](PanelBench& bench) { return bench.replay(); });
  MESSAGE(figures);
}
