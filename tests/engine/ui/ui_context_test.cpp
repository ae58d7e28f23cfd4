#include <string>

#include <doctest/doctest.h>

#include "engine/ui/ui.h"
#include "engine/ui/ui_style.h"

using namespace gearshift::engine;

namespace {

constexpr int kKeyDown = 264, kKeyUp = 265, kKeySpace = 32, kKeyA = 65;  // GLFW's key codes

// A window with a button and a text field.
struct Form {
  UiContext ui;
  UiInput screen;
  UiEvents events;
  char text[32] = "";
  int presses = 0;
  ImVec2 button{0, 0}, field{0, 0};

  void frame() {
    ui.feed(events);
    events.steps.clear();
    ui.begin(screen);
    ImGui::SetNextWindowPos({20, 20});
    ImGui::SetNextWindowSize({300, 200});
    ImGui::Begin("form");
    presses += ImGui::Button("press") ? 1 : 0;
    button = middle();
    ImGui::InputText("text", text, sizeof text);
    field = middle();
    ImGui::End();
    ui.end();
  }
  void click(ImVec2 at) {
    events.mouse = {static_cast<double>(at.x), static_cast<double>(at.y)};
    frame();
    events.mouse_down[0] = true;
    frame();
    events.mouse_down[0] = false;
    frame();
  }
  static ImVec2 middle() {
    const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
    return {0.5f * (low.x + high.x), 0.5f * (low.y + high.y)};
  }
};

}  // namespace

TEST_CASE("a click presses a button once, and only where the button is") {
  Form form;
  form.frame();
  form.click(form.button);
  CHECK(form.presses == 1);
  form.click({600, 500});
  CHECK(form.presses == 1);
  form.events.has_mouse = false;  // the mouse moves the lever, so the UI gets no mouse input
  form.events.mouse_down[0] = true;
  form.frame();
  form.events.mouse_down[0] = false;
  form.frame();
  CHECK(form.presses == 1);
}

TEST_CASE("clicks between two frames all count, each where it was made, and a scroll in between as well") {
  Form form;
  for (int i = 0; i < 3; ++i) form.frame();  // a new window accepts no clicks at first
  const auto at = [](ImVec2 place) { return glm::dvec2(place.x, place.y); };
  const glm::dvec2 button = at(form.button), field = at(form.field), outside(600, 500);
  form.events.steps = {UiButton{0, true, button},
                       UiButton{0, false, button},
                       UiButton{0, true, button},
                       UiScroll{{0, 1}, button},
                       UiButton{0, false, button},
                       UiButton{0, true, field},
                       UiButton{0, false, field},
                       U'x',
                       UiButton{0, true, outside},
                       UiButton{0, false, outside},
                       U'y'};
  form.events.mouse = outside;
  for (int i = 0; i < 20; ++i) form.frame();
  CHECK(form.presses == 2);
  CHECK(std::string(form.text) == "x");
}

TEST_CASE("text goes to the field that was clicked") {
  Form form;
  form.frame();
  form.click(form.button);
  form.click(form.field);
  form.frame();
  form.events.steps = {U'5', U'\u00b5'};
  form.frame();
  form.frame();
  CHECK(std::string(form.text) == "5\u00b5");
}

TEST_CASE("keys navigate and press: GLFW's key codes are mapped") {
  Form form;
  form.frame();
  const auto strike = [&form](int key) {
    form.events.steps = {UiKey{key, true}};
    form.frame();
    form.events.steps = {UiKey{key, false}};
    form.frame();
  };
  form.click(form.button);
  CHECK(form.presses == 1);
  strike(kKeyDown);
  strike(kKeyUp);
  strike(kKeySpace);
  CHECK(form.presses == 2);
  form.events.steps = {UiKey{9999, true}, UiKey{-1, true}, UiKey{kKeyA, true}};  // unknown key codes are ignored
  form.frame();
}

TEST_CASE("a key that goes down and up between two frames counts as pressed, as does a Ctrl shortcut before it") {
  constexpr int kControl = 341, kEnter = 257, kB = 66, kC = 67;
  Form form;
  form.frame();
  form.click(form.button);  // presses the button, where keyboard navigation then starts
  form.events.steps = {UiKey{kKeyDown, true}, UiKey{kKeyDown, false}, UiKey{kKeyUp, true}, UiKey{kKeyUp, false}};
  for (int i = 0; i < 5; ++i) form.frame();
  form.events.steps = {UiKey{kKeySpace, true}, UiKey{kKeySpace, false}};
  for (int i = 0; i < 3; ++i) form.frame();
  CHECK(form.presses == 2);
  form.click(form.field);
  // All input arrives in one poll, as in a slow frame: types "Bb", selects all, types "Ccc" over it, and deletes one
  // letter.
  constexpr int kBackspace = 259;
  form.events.steps = {UiKey{kB, true},
                       U'B',
                       UiKey{kB, false},
                       UiKey{kB, true},
                       U'b',
                       UiKey{kB, false},
                       UiKey{kControl, true},
                       UiKey{kKeyA, true},
                       UiKey{kKeyA, false},
                       UiKey{kControl, false},
                       UiKey{kC, true},
                       U'C',
                       UiKey{kC, false},
                       UiKey{kC, true},
                       U'c',
                       UiKey{kC, false},
                       UiKey{kC, true},
                       U'c',
                       UiKey{kC, false},
                       UiKey{kBackspace, true},
                       UiKey{kBackspace, false}};
  for (int i = 0; i < 8; ++i) form.frame();
  CHECK(std::string(form.text) == "Cc");
  form.events.steps = {UiKey{kEnter, true}, UiKey{kEnter, false}};
  form.frame();
  CHECK(ImGui::IsKeyDown(ImGuiKey_Enter));
  form.frame();
  CHECK_FALSE(ImGui::IsKeyDown(ImGuiKey_Enter));
}

TEST_CASE("queued keys are dropped when the window loses focus") {
  Form form;
  form.events.steps = {UiKey{kKeySpace, true}, UiKey{kKeySpace, false}, UiKey{kKeySpace, true}};
  form.frame();
  form.events.focused = false;
  for (int i = 0; i < 3; ++i) {
    form.frame();
    CHECK_FALSE(ImGui::IsKeyDown(ImGuiKey_Space));
  }
}

TEST_CASE("pressed keys are released when the window loses focus") {
  Form form;
  form.events.steps = {UiKey{kKeySpace, true}};
  form.frame();
  CHECK(ImGui::IsKeyDown(ImGuiKey_Space));
  form.events.focused = false;
  form.frame();
  CHECK_FALSE(ImGui::IsKeyDown(ImGuiKey_Space));
}

TEST_CASE("fonts and sizes follow the scale, and letters beyond ASCII have glyphs of their own") {
  UiContext ui;
  UiInput screen;
  ui.begin(screen);
  const float one = ui_em(), padding = ImGui::GetStyle().FramePadding.x;
  for (const ImWchar letter : {ImWchar(0xb5), ImWchar(0xd7), ImWchar(0xb7), ImWchar(0x2026), ImWchar(0x2264),
                               ImWchar(0x11e), ImWchar(0x3a9), ImWchar(0x416)})
    CHECK(ui_glyphs(ui_font(UiFont::body)).FindGlyphNoFallback(letter) != nullptr);
  ui.end();
  screen.scale = 3.0f;
  ui.begin(screen);
  CHECK(ui_em() == doctest::Approx(3.0 * static_cast<double>(one)).epsilon(0.01));
  CHECK(ImGui::GetStyle().FramePadding.x == doctest::Approx(3.0 * static_cast<double>(padding)).epsilon(0.01));
  ui.end();
}

TEST_CASE("two contexts do not affect each other") {
  Form one, other;
  one.frame();
  other.frame();
  one.click(one.button);
  other.frame();
  CHECK(one.presses == 1);
  CHECK(other.presses == 0);
}
