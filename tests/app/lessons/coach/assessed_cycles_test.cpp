// Coach::assess() assesses a single cycle, add() assesses many cycles at once. For the same drive both give the same
// result. The view has a result of assess() at once; the next add() ends the trial and saves it.
#include <stdexcept>

#include <doctest/doctest.h>

#include "app/lessons/coach/coach.h"
#include "tests/app/lessons/coach/coach_bench.h"

using namespace gearshift::lessons;
using namespace gearshift::test;
using namespace gearshift::vehicle;

TEST_CASE("a drive assessed cycle by cycle gives the same result as with add(), and ends only at the next add()") {
  const CoachBench bench;
  Coach judged(bench.config), added(bench.config);
  CHECK_THROWS_AS((void)judged.assess({}), std::logic_error);
  for (Coach* coach : {&judged, &added}) {
    coach->offer(bench.config.lessons[0]);
    bench.begin(*coach);
  }
  const std::vector<DriveSample> drive = bench_drive(Drive::pushed, added.guidance());
  added.add(drive);
  std::size_t cycles = 0;
  bool over = false;
  for (; cycles < drive.size() && !over; ++cycles) {
    over = judged.assess(drive[cycles]).is_over();
    if (cycles == 1600) {
      CHECK(judged.view().now->step > 0);
      judged.add({});
    }
  }
  CHECK(over);
  CHECK(judged.view().phase == LessonPhase::driving);
  judged.add({});
  CHECK(judged.view().phase == LessonPhase::over);
  const LessonResult &mine = *judged.view().result, &expected = *added.view().result;
  CHECK(mine.end == expected.end);
  CHECK(mine.grade == expected.grade);
  CHECK(mine.duration == expected.duration);
  CHECK(mine.slip_energy == expected.slip_energy);
  CHECK(mine.errors.size() == expected.errors.size());
  CHECK(mine.shifts.size() == expected.shifts.size());
  CHECK(judged.view().runs.size() == added.view().runs.size());
}
