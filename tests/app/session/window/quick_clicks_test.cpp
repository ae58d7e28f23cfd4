// Clicks and keys that arrive between two frames, as on a slow machine: through a real window, its poll and the sharing
// of its input, to the controls of a user interface.
#include <imgui.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <string>
#include <thread>

#include <doctest/doctest.h>

#include "app/session/shared_input.h"
#include "tests/engine/window/x_server.h"

using namespace gearshift::engine;
using namespace gearshift::session;
using namespace gearshift::test;

namespace {

constexpr int kButtons = 4;

// Four buttons and a text field in one column, which is drawn once per poll of the window.
struct SlowForm {
  XServer server;
  gearshift::engine::Window window{400, 300, "form"};
  UiContext ui;
  gearshift::ui::Panel panel;  // not drawn: SharedInput asks it who has mouse and keys
  SharedInput shared{gearshift::ui::read_bindings(GEARSHIFT_ASSETS "/bindings/default.toml")};
  std::array<int, kButtons> presses{};
  char text[32] = "";

  SlowForm() {
    frame();
    server.move(server.find("form"), 0, 0);
    for (int i = 0; i < 100 && !window.poll().focused; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    frame();
  }

  void frame() {
    const WindowInput& input = window.poll();
    shared.update(
        input, 1.0, [](glm::dvec2 at) { return at; }, panel, ui);
    ui.begin({.width = 400.0f, .height = 300.0f, .seconds = 1.0f});
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize({200, 300});
    ImGui::Begin("form", nullptr, ImGuiWindowFlags_NoDecoration);
    for (int i = 0; i < kButtons; ++i) {
      ImGui::SetCursorPos({20.0f, 20.0f + 50.0f * static_cast<float>(i)});
      presses.at(static_cast<std::size_t>(i)) += ImGui::Button(std::to_string(i).c_str(), {100, 40}) ? 1 : 0;
    }
    ImGui::SetCursorPos({20.0f, 230.0f});
    ImGui::InputText("text", text, sizeof text);
    ImGui::End();
    ui.end();
  }

  std::string counts() const {
    std::string all;
    for (const int count : presses) all += std::to_string(count) + ' ';
    return all;
  }

  // Does what xdotool is told, all of it between two frames; then draws as many frames as the steps may need.
  void between_frames(const std::string& steps) {
    REQUIRE(std::system(("xdotool " + steps).c_str()) == 0);
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    for (int i = 0; i < 20; ++i) frame();
  }
};

}  // namespace

TEST_CASE("quick clicks between two frames all count, each where it was made") {
  SlowForm form;
  form.between_frames(
      "mousemove 70 40 click 1 mousemove 70 90 click 1 mousemove 70 140 click 1 mousemove 70 190 click 1");
  CHECK(form.counts() == "1 1 1 1 ");
  form.between_frames("mousemove 70 90 click 1 click 1 mousemove 300 250");  // the pointer ends beside the controls
  CHECK(form.counts() == "1 3 1 1 ");
}

TEST_CASE(
    "a click between two frames chooses the field that the text typed after it goes to, and ends the text before it") {
  SlowForm form;
  form.between_frames("mousemove 70 240 click 1 key a key b mousemove 70 40 click 1 key c");
  CHECK(std::string(form.text) == "ab");
  CHECK(form.counts() == "1 0 0 0 ");
}
