#include "app/ui/panel/tuning_history.h"

#include <random>
#include <vector>

#include <doctest/doctest.h>

using namespace gearshift::haptics;
using namespace gearshift::ui;

namespace {

HapticTuning stiff(double stiffness) {
  HapticTuning tuning;
  tuning.wall_stiffness = stiffness;
  return tuning;
}

}  // namespace

TEST_CASE("undo and redo step through the history, and a change drops the undone steps") {
  TuningHistory history(stiff(1.0));
  CHECK_FALSE(history.can_undo());
  history.undo();
  history.redo();
  CHECK(history.current() == stiff(1.0));
  history.change(stiff(2.0));
  history.change(stiff(3.0));
  history.undo();
  CHECK(history.current() == stiff(2.0));
  history.redo();
  CHECK(history.current() == stiff(3.0));
  history.undo();
  history.undo();
  CHECK(history.current() == stiff(1.0));
  history.change(stiff(4.0));
  CHECK_FALSE(history.can_redo());
  history.undo();
  CHECK(history.current() == stiff(1.0));
}

TEST_CASE("each drag is one step") {
  TuningHistory history(stiff(1.0));
  for (int i = 0; i < 50; ++i) history.change(stiff(10.0 + i), i > 0);
  for (int i = 0; i < 50; ++i) history.change(stiff(100.0 + i), i > 0);
  CHECK(history.current() == stiff(149.0));
  history.undo();
  CHECK(history.current() == stiff(59.0));
  history.undo();
  CHECK(history.current() == stiff(1.0));
}

TEST_CASE("setting an equal value is no step") {
  TuningHistory history(stiff(1.0));
  history.change(stiff(1.0));
  CHECK_FALSE(history.can_undo());
}

TEST_CASE("A and B have separate histories, and switching is no step") {
  TuningHistory history(stiff(1.0));
  history.change(stiff(2.0));
  history.switch_slot();
  CHECK(history.slot() == TuningSlot::b);
  CHECK(history.current() == stiff(1.0));
  CHECK_FALSE(history.can_undo());
  history.change(stiff(9.0));
  history.switch_slot();
  CHECK(history.current() == stiff(2.0));
  history.undo();
  history.switch_slot();
  CHECK(history.current() == stiff(9.0));
}

TEST_CASE("reset returns to the start and can be undone; a restart cannot") {
  TuningHistory history(stiff(1.0));
  history.change(stiff(2.0));
  history.reset();
  CHECK(history.current() == stiff(1.0));
  history.undo();
  CHECK(history.current() == stiff(2.0));
  history.restart(stiff(7.0));
  CHECK(history.current() == stiff(7.0));
  CHECK_FALSE(history.can_undo());
  CHECK(history.slot() == TuningSlot::a);
}

TEST_CASE("any sequence behaves like a list with a position") {
  std::mt19937 random(5);
  std::vector<double> list{0.0};
  std::size_t place = 0;
  TuningHistory history(stiff(0.0));
  for (int i = 1; i < 3000; ++i) {
    switch (random() % 3) {
      case 0:
        list.resize(place + 1);
        list.push_back(i);
        ++place;
        history.change(stiff(i));
        break;
      case 1:
        place -= place > 0 ? 1 : 0;
        history.undo();
        break;
      default:
        place += place + 1 < list.size() ? 1 : 0;
        history.redo();
    }
    REQUIRE(history.current() == stiff(list[place]));
    REQUIRE(history.can_undo() == (place > 0));
    REQUIRE(history.can_redo() == (place + 1 < list.size()));
  }
}
