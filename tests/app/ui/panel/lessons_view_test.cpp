// The panel's tabs for lessons and past runs, operated by mouse and keyboard.
#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "app/ui/panel/palette.h"
#include "tests/app/ui/panel/coach_views.h"
#include "tests/app/ui/panel/drawn.h"
#include "tests/app/ui/panel/panel_rig.h"

using namespace gearshift;
using namespace gearshift::lessons;
using namespace gearshift::test;
using namespace gearshift::ui;

namespace {

constexpr int kEnter = 257;

struct LessonsRig : PanelRig {
  explicit LessonsRig(const CoachState& coach, const char* tab = "tab_lesson") {
    input.coach = coach;
    frame();
    click(tab);
    for (int i = 0; i < 3; ++i) frame();
  }
  PanelCommands write(const std::u32string& text) {
    events.steps.assign(text.begin(), text.end());
    PanelCommands all = frame();
    merge(all, frame());
    return all;
  }
};

}  // namespace

TEST_CASE("the lessons tab is open at the start, in teaching order, with a disc for each passed lesson") {
  LessonsRig rig(half_way());
  rig.point("lesson: start_and_stop");
  const std::string last = "lesson: " + std::string(kTeachingOrder.back());
  double before = 0.0;
  for (const std::string_view key : std::span(kTeachingOrder).first(14)) {
    const ControlRect at = rig.rect("lesson: " + std::string(key));
    CHECK(at.min.y > before);
    before = at.min.y;
  }
  CHECK_FALSE(rig.panel.control_rect(last).has_value());
  const std::vector<std::string> best_and_last{"9.0", "6.5"};
  CHECK(right_of("Stop and go") == best_and_last);
  CHECK(right_of("Reverse").empty());  // a lesson that was never tried has no grades
  std::vector<glm::dvec2> discs = drawn_in(ui::ink::kGood);
  std::erase_if(discs, [&](glm::dvec2 at) { return at.x < rig.panel.cabin_area().max.x; });  // plots, pedals
  const PixelBox green = box_of(discs);
  CHECK(green.min.y >= rig.rect("lesson: start_and_stop").min.y - 2.0);
  // Only the first four lessons of the list were passed. `stop_and_go` is the fourth.
  CHECK(green.max.y <= rig.rect("lesson: stop_and_go").max.y + 2.0);
  for (int i = 0; i < 50; ++i) {  // the other lessons are reached by the mouse wheel
    rig.events.steps = {engine::UiScroll{{0.0, -3.0}, rig.events.mouse}};
    rig.frame();
  }
  rig.frame();
  CHECK(rig.rect(last).max.y > rig.rect("lesson: another_gate").max.y);
}

TEST_CASE("a click offers a lesson, and a button the suggested one; neither works during a lesson") {
  LessonsRig rig(half_way());
  CHECK(value(rig.click("lesson: reverse"), &OfferLesson::key) == "reverse");
  CHECK(value(rig.click("lesson_suggested"), &OfferLesson::key) == "hill_start");
  CHECK(is_drawn(rig.input.coach.next_why));
  CHECK_FALSE(has<OfferLesson>(rig.frame()));
  rig.input.coach = driven();
  rig.frame();
  CHECK_FALSE(has<OfferLesson>(rig.click("lesson: reverse")));
  CHECK_FALSE(has<OfferLesson>(rig.click("lesson_suggested")));
}

TEST_CASE("the instructor can set the next lesson, and restore the suggested one") {
  LessonsRig rig(half_way());
  CHECK(value(rig.click("next: reverse"), &ChooseNextLesson::key) == "reverse");
  CHECK_FALSE(rig.panel.control_rect("next_as_suggested").has_value());
  rig.input.coach.next_by_instructor = true;
  rig.frame();
  rig.frame();
  CHECK(value(rig.click("next_as_suggested"), &ChooseNextLesson::key) == std::string());
}

TEST_CASE("a learner's name is typed and confirmed with Enter, chosen from the list, or empty") {
  LessonsRig rig(half_way());
  rig.click("learner");
  CHECK(rig.panel.has_keyboard());
  CHECK_FALSE(has<ChooseLearner>(rig.write(U"Dora")));  // before Enter, a typed name selects nobody
  CHECK(value(rig.press(kEnter), &ChooseLearner::name) == "Dora");
  rig.input.coach.learner = "Dora";
  rig.frame();
  rig.frame();
  CHECK_FALSE(rig.panel.has_keyboard());
  rig.click("learner");
  CHECK_FALSE(has<ChooseLearner>(rig.press(kEnter)));  // the name has not changed, so nothing is requested
  rig.click("learner_known");
  CHECK(value(rig.click("learner: Bert"), &ChooseLearner::name) == "Bert");
  rig.click("learner_known");
  CHECK(value(rig.click("learner: "), &ChooseLearner::name) == std::string());
}

// A learner who returns says so, and another person of the same name gets a name of their own. A name in another form is
// the same name.
TEST_CASE("a typed name that a learner has already is asked apart") {
  for (const char32_t* typed : {U"Bert", U"bert", U" BERT"}) {
    LessonsRig rig(half_way());
    rig.click("learner");
    rig.write(typed);
    CHECK_FALSE(has<ChooseLearner>(rig.press(kEnter)));
    rig.frame();
    CHECK(is_drawn("There is a learner named Bert already. Is this you?"));
    CHECK(value(rig.click("learner_same"), &ChooseLearner::name) == "Bert");
  }
  LessonsRig rig(half_way());
  rig.click("learner");
  rig.write(U"Bert");
  rig.press(kEnter);
  rig.frame();
  CHECK_FALSE(has<ChooseLearner>(rig.click("learner_other")));
  rig.frame();
  CHECK(rig.panel.has_keyboard());
  CHECK(is_begun("Bert is another learner"));
  CHECK_FALSE(has<ChooseLearner>(rig.press(kEnter)));  // the same name again is asked again
  rig.frame();
  CHECK(rig.panel.control_rect("learner_same").has_value());
  rig.click("learner_other");
  rig.frame();
  rig.write(U"Bert Smith");
  CHECK(value(rig.press(kEnter), &ChooseLearner::name) == "Bert Smith");
  // Control: the current learner's own name in another form asks and changes nothing.
  LessonsRig own(half_way());
  own.click("learner");
  own.write(U"ada example");
  CHECK_FALSE(has<ChooseLearner>(own.press(kEnter)));
  own.frame();
  CHECK_FALSE(own.panel.control_rect("learner_same").has_value());
}

TEST_CASE(
    "the list of learners renames the current one; another learner's name is refused, Escape keeps the old name") {
  LessonsRig rig(half_way());
  const auto rename = [&](const std::u32string& name) {
    rig.click("learner_known");
    rig.click("learner_rename");
    rig.frame();
    rig.frame();
    CHECK(rig.panel.has_keyboard());
    return rig.write(name);
  };
  rename(U"Ada Lovelace");
  const auto asked = find<RenameLearner>(rig.press(kEnter));
  REQUIRE(asked);
  CHECK(asked->name == "Ada Lovelace");
  rename(U"bert");
  CHECK_FALSE(has<RenameLearner>(rig.press(kEnter)));
  rig.frame();
  CHECK(is_begun("Bert is another learner"));
  rig.press(kEscape);
  rig.frame();
  CHECK(is_drawn("Ada Example"));
  rename(U"Zoe");
  CHECK_FALSE(has<RenameLearner>(rig.press(kEscape)));
  rig.click("learner");
  rig.write(U"Zoe");
  CHECK(value(rig.press(kEnter), &ChooseLearner::name) == "Zoe");  // no longer a new name for the current learner
  rig.input.coach.learner.clear();
  rig.frame();
  rig.click("learner_known");
  CHECK_FALSE(rig.panel.control_rect("learner_rename").has_value());
}

TEST_CASE("a field has the keyboard from the frame in which it was clicked") {
  LessonsRig rig(half_way());
  rig.point("learner");
  rig.frame();
  CHECK_FALSE(rig.panel.has_keyboard());
  rig.events.mouse_down[0] = true;
  rig.frame();
  CHECK(rig.panel.has_keyboard());
}

TEST_CASE("leaving the field by a click or Tab applies the name; Escape restores it; the rows below do not move") {
  LessonsRig rig(half_way());
  const double row = rig.rect("lesson: reverse").min.y;
  rig.click("learner");
  rig.write(U"Dora");
  CHECK(is_drawn("Press Enter to add this learner."));
  CHECK(rig.rect("lesson: reverse").min.y == row);
  PanelCommands asked = rig.click("lesson: reverse");
  CHECK(value(asked, &ChooseLearner::name) == "Dora");
  CHECK(value(asked, &OfferLesson::key) == "reverse");
  CHECK_FALSE(rig.panel.has_keyboard());
  CHECK(rig.rect("lesson: reverse").min.y == row);
  rig.input.coach.learner = "Dora";
  rig.frame();
  rig.click("learner");
  rig.write(U"Eve");
  constexpr int kTab = 258;
  CHECK(value(rig.press(kTab), &ChooseLearner::name) == "Eve");
  rig.input.coach.learner = "Eve";
  rig.press(kEscape);
  rig.press(kEscape);
  rig.click("learner");
  rig.write(U"Fay");
  CHECK_FALSE(has<ChooseLearner>(rig.press(kEscape)));
  CHECK(is_drawn("Eve"));
  CHECK_FALSE(is_drawn("Fay"));
}

TEST_CASE("the list of learners is as wide as the field") {
  LessonsRig rig(half_way());
  const ControlRect field = rig.rect("learner"), arrow = rig.rect("learner_known");
  rig.click("learner_known");
  const ControlRect entry = rig.rect("learner: Bert");
  CHECK(entry.min.x < field.min.x + 20.0);
  CHECK(entry.max.x > arrow.max.x - 20.0);
  CHECK(entry.max.x <= arrow.max.x + 1.0);
}

TEST_CASE("a note explains why nothing is saved") {
  CoachState coach = half_way();
  coach.is_saving = false;
  LessonsRig rig(coach);
  CHECK(is_drawn("Your history could not be opened, so nothing is being saved."));
  rig.input.coach.is_saving = true;
  rig.input.coach.learner.clear();
  rig.frame();
  CHECK(is_drawn("Enter a name to save your progress."));
  rig.input.is_automatic_hand = true;  // a note on the automatic hand replaces the note on the name
  rig.frame();
  CHECK_FALSE(is_drawn("Enter a name to save your progress."));
  const std::vector<DrawnText> texts = drawn_texts();
  CHECK(std::any_of(texts.begin(), texts.end(), [](const DrawnText& text) {
    return text.text.starts_with(without_blanks("The simulated driver is driving"));
  }));
}

TEST_CASE("a name with characters that the font lacks is accepted, with a note on how they are shown") {
  LessonsRig rig(half_way());
  const auto is_explained = [] {
    const std::vector<DrawnText> texts = drawn_texts();
    return std::any_of(texts.begin(), texts.end(), [](const DrawnText& text) {
      return text.text.find(without_blanks("shown as \"?\"")) != std::string::npos;
    });
  };
  rig.click("learner");
  rig.write(U"Zoë Ångström");
  CHECK_FALSE(is_explained());
  rig.press(kEscape);
  rig.click("learner");
  rig.write(U"李娜");
  CHECK(is_explained());
  CHECK(value(rig.press(kEnter), &ChooseLearner::name) == "李娜");
  rig.input.coach.learner = "李娜";
  rig.frame();
  rig.frame();
  CHECK(is_explained());  // the note stays while this learner is selected
}

TEST_CASE("a click opens a past run; its shifts can be replayed if they were recorded") {
  LessonsRig rig(with_history(), "tab_history");
  CHECK_FALSE(rig.panel.control_rect("look: 16 0").has_value());
  rig.click("run: 16");
  const auto asked = find<OpenShift>(rig.click("look: 16 1"));
  REQUIRE(asked);
  CHECK(asked->recording == "/tmp/hill.trace");
  CHECK(asked->begin == 19.5);
  CHECK(is_drawn("clutch released 0.08 s before the gear engaged; revs off by 239 rpm"));
  CHECK(is_drawn("blocked by the synchroniser for 0.31 s"));
  CHECK(is_drawn("The gears ground (12.4 J). (-0.5)"));
  CHECK(is_drawn("Wait for the synchroniser: push, do not hit."));
  rig.click("run: 16");
  CHECK_FALSE(rig.panel.control_rect("look: 16 0").has_value());
  rig.click("run: 15");  // this run was not recorded
  CHECK_FALSE(has<OpenShift>(rig.click("look: 15 0")));
  CHECK(is_drawn("No replay: this run was not recorded."));
}

TEST_CASE("each run shows its grade, or why it has none") {
  LessonsRig rig(with_history(), "tab_history");
  const std::vector<DrawnText> texts = drawn_texts();
  for (const char* words : {"9.0", "0.0", "guided", "left early", "cut off", "data lost"}) CHECK(is_drawn(words));
  // Newer runs are above older ones: run 16 (9.0) above run 15 (0.0), and run 14 (guided) above run 13 (left early).
  CHECK(the_text(texts, "9.0").box.min.y < the_text(texts, "0.0").box.min.y);
  CHECK(the_text(texts, "guided").box.min.y < the_text(texts, "left early").box.min.y);
}

TEST_CASE("the runs that are scrolled out of view are reached by the mouse wheel, also below an opened run") {
  CoachState coach = with_history();
  while (coach.runs.size() < kMaxRunsShown) {
    coach.runs.push_back(coach.runs.front());
    coach.runs.back().id = 10 - static_cast<std::int64_t>(coach.runs.size());
  }
  const std::string last = "run: " + std::to_string(coach.runs.back().id);
  LessonsRig rig(coach, "tab_history");
  rig.point("run: 15");
  const double pitch = rig.rect("run: 15").min.y - rig.rect("run: 16").min.y;
  CHECK_FALSE(rig.panel.control_rect(last).has_value());
  const auto scroll = [&](double lines) {
    for (int i = 0; i < 50; ++i) {
      rig.events.steps = {engine::UiScroll{{0.0, lines}, rig.events.mouse}};
      rig.frame();
    }
    rig.frame();
  };
  for (const bool is_opened : {false, true}) {
    CAPTURE(is_opened);
    if (is_opened) rig.click("run: 16");
    scroll(-3.0);
    const double bottom = rig.rect(last).max.y;
    CHECK(bottom > rig.rect(last).min.y + 0.5 * pitch);
    for (int above = 1; above < 5; ++above)
      CHECK(bottom - rig.rect("run: " + std::to_string(coach.runs.back().id + above)).max.y == above * pitch);
    scroll(3.0);
    CHECK(rig.rect("run: 16").min.y < rig.events.mouse.y);
  }
  CHECK(rig.rect("look: 16 0").min.y > rig.rect("run: 16").max.y);
}

TEST_CASE("an error costs points in a graded run, and none in a run that was left") {
  CoachState coach = with_history();
  LessonResult left = result_of("hill_start", some_errors());
  left.end = LessonEnd::left;
  grade_result(shipped_lesson("hill_start"), left);
  coach.runs[3].result = left;  // index 3 is the run with ID 13
  LessonsRig rig(coach, "tab_history");
  rig.click("run: 13");
  rig.frame();
  CHECK(is_drawn("The gears ground (12.4 J)."));
  for (const DrawnText& text : drawn_texts()) CHECK_FALSE(text.text.ends_with("(-0.5)"));
  rig.click("run: 13");
  rig.click("run: 16");
  rig.frame();
  CHECK(is_drawn("The gears ground (12.4 J). (-0.5)"));
}

TEST_CASE("a comment needs an author and a text, and is requested once") {
  LessonsRig rig(with_history(), "tab_history");
  rig.click("run: 16");
  rig.click("comment");
  rig.write(U"Well done");
  CHECK_FALSE(has<AddComment>(rig.press(kEnter)));  // no author has been entered yet
  rig.click("comment_author");
  CHECK(rig.panel.has_keyboard());
  rig.write(U"Ms Torque");
  rig.press(kEscape + 1);  // GLFW's code of the Enter key; Enter leaves the field
  const auto asked = find<AddComment>(rig.click("comment_add"));
  REQUIRE(asked);
  CHECK(asked->run == 16);
  CHECK(asked->author == "Ms Torque");
  CHECK(asked->text == "Well done");
  CHECK_FALSE(has<AddComment>(rig.click("comment_add")));
}

TEST_CASE("a comment can be edited, or deleted with a second click to confirm") {
  CoachState coach = with_history();
  coach.runs[0].comments[0].id = 7;
  LessonsRig rig(coach, "tab_history");
  rig.click("run: 16");
  rig.click("comment_edit: 7");
  rig.click("comment_text");
  rig.write(U" Well.");
  const auto edited = find<EditComment>(rig.click("comment_save"));
  REQUIRE(edited);
  CHECK(edited->run == 16);
  CHECK(edited->comment == 7);
  CHECK(edited->text.find("Wait for the synchroniser: push, do not hit.") != std::string::npos);
  CHECK(edited->text.find("Well.") != std::string::npos);
  CHECK(rig.click("comment_delete: 7").empty());
  CHECK(rig.click("comment_cancel").empty());
  rig.click("comment_delete: 7");
  const auto deleted = find<DeleteComment>(rig.click("comment_delete_sure"));
  REQUIRE(deleted);
  CHECK(deleted->run == 16);
  CHECK(deleted->comment == 7);
}

TEST_CASE("an invalid name is not requested, and the reason is below the field until the name changes") {
  LessonsRig rig(half_way());
  rig.click("learner");
  rig.write(U"Eve\u200b");
  CHECK_FALSE(has<ChooseLearner>(rig.press(kEnter)));
  const std::string why = user_text_problem(UserText::name, "a learner's name", "Eve\u200b");
  const std::vector<DrawnText> texts = drawn_texts();
  CHECK(std::any_of(texts.begin(), texts.end(), [&](const DrawnText& text) {
    return text.text.starts_with(without_blanks(why).substr(0, 16)) && text.box.min.y > rig.rect("learner").min.y;
  }));
  rig.click("learner");
  rig.write(U"Eve");
  CHECK(value(rig.press(kEnter), &ChooseLearner::name) == "Eve");
}

TEST_CASE("a learner deleted by another program is marked, and can be selected again by name") {
  CoachState coach = half_way();
  coach.learner_deleted = true;
  coach.is_saving = false;
  LessonsRig rig(coach);
  std::string note;
  for (const DrawnText& text : drawn_texts())
    if (text.colour == ui::ink::kWarn) note += text.text;
  // The note must name the field, because Enter starts a lesson if the field is not active.
  CHECK(note.find(without_blanks("Enter in this field")) != std::string::npos);
  rig.click("learner");
  CHECK(value(rig.press(kEnter), &ChooseLearner::name) == "Ada Example");
  rig.input.coach.learner_deleted = false;
  rig.frame();
  rig.click("learner");
  CHECK_FALSE(has<ChooseLearner>(rig.press(kEnter)));
}

TEST_CASE("each kind of error shows its advice only once") {
  CoachState coach = with_history();
  coach.runs[0].result.errors.push_back(make_driving_error(ErrorKind::jerk, Severity::minor, 15.0, 8.8, 0));
  LessonsRig rig(coach, "tab_history");
  rig.click("run: 16");
  const std::string advice = without_blanks(std::string(error_advice(ErrorKind::jerk))).substr(0, 16);
  const std::vector<DrawnText> texts = drawn_texts();
  const auto count_texts = [&](const std::string& begin) {
    return std::count_if(texts.begin(), texts.end(),
                         [&](const DrawnText& text) { return text.text.starts_with(begin); });
  };
  CHECK(count_texts("Thecarjerked") == 2);
  CHECK(count_texts(advice) == 1);
}

TEST_CASE("a different car is chosen from its list") {
  PanelRig rig;
  rig.click("car");
  CHECK(value(rig.click("car: diesel"), &ChooseCar::name) == "diesel");
}
