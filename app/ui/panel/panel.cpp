#include "app/ui/panel/panel.h"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "app/ui/panel/clip_meter.h"
#include "app/ui/panel/control_bar.h"
#include "app/ui/panel/controls_card.h"
#include "app/ui/panel/event_list.h"
#include "app/ui/panel/force_plots.h"
#include "app/ui/panel/gate_view.h"
#include "app/ui/panel/headset_tab.h"
#include "app/ui/panel/help_view.h"
#include "app/ui/panel/history_view.h"
#include "app/ui/panel/learner_view.h"
#include "app/ui/panel/lesson_card.h"
#include "app/ui/panel/lesson_text.h"
#include "app/ui/panel/lessons_view.h"
#include "app/ui/panel/loop_view.h"
#include "app/ui/panel/message_note.h"
#include "app/ui/panel/palette.h"
#include "app/ui/panel/panel_keys.h"
#include "app/ui/panel/panel_mouse.h"
#include "app/ui/panel/preset_view.h"
#include "app/ui/panel/replay_bar.h"
#include "app/ui/panel/setup_view.h"
#include "app/ui/panel/stick_text.h"
#include "app/ui/panel/text_lines.h"
#include "app/ui/panel/tuning_view.h"

namespace gearshift::ui {
namespace {

// Layout of the panel around the cabin: two columns and a bar. The left column is not shown if the cabin would become
// too narrow.
struct Layout {
  float bar, left, right;  // [px] sizes; 0: not shown
  ImVec2 screen;
};

constexpr float kMinMiddle = 14.0f;  // [em]

Layout make_layout() {
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  const float em = engine::ui_em();
  const float side = std::clamp(0.25f * screen.x, 20.5f * em, 30.0f * em);
  const bool both = screen.x >= 2.0f * side + kMinMiddle * em;
  return {4.6f * em, both ? side : 0.0f, std::min(side, screen.x), screen};
}

constexpr const char* kBarName = "Drive";

bool begin_part(const char* name, ImVec2 at, ImVec2 size) {
  constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                      ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus;
  ImGui::SetNextWindowPos(at);
  ImGui::SetNextWindowSize(size);
  return ImGui::Begin(name, nullptr, kFlags);
}

void title(const char* text) {
  const engine::WithFont bold(engine::UiFont::title);
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(text);
}

// Draws the button "Reset view" at the right end of the line.
void draw_view_reset(Controls& controls, PanelCommands& out) {
  const engine::WithFont small(engine::UiFont::small);
  constexpr const char* kLabel = "Reset view";
  const float width = ImGui::CalcTextSize(kLabel).x + 2.0f * ImGui::GetStyle().FramePadding.x;
  ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - width);
  if (controls.button("reset_view", kLabel)) out.push_back(ResetView{});
}

// The command line calls the simulated driver's hand "by itself".
std::string hand_label(std::string_view hand) {
  return std::string(hand == "by itself" ? "simulated driver" : hand);
}

struct Tab {
  const char* name;
  const char* label;
};
// The learner's tabs first, then the engineer's.
constexpr Tab kTabs[] = {{"tab_lesson", "Lessons"}, {"tab_history", "History"}, {"tab_tuning", "Tuning"},
                         {"tab_setup", "Setup"},    {"tab_loop", "Loop"},       {"tab_presets", "Presets"},
                         {"tab_headset", "XR"}};  // shown only while a headset is in use

std::span<const Tab> tabs_of(const PanelInput& input) {
  return std::span(kTabs).first(std::size(kTabs) - (input.headset ? 0 : 1));
}

bool tabs_fit(std::span<const Tab> tabs) {
  float room = ImGui::GetContentRegionAvail().x;
  for (const Tab& tab : tabs) room -= button_width(tab.label) + ImGui::GetStyle().ItemInnerSpacing.x + 1.0f;
  return room > 0.0f;
}

// Makes the tabs smaller and closer together, for a narrow column.
class TabStyle {
 public:
  explicit TabStyle(bool dense) : dense_(dense) {
    if (!dense_) return;
    const ImGuiStyle& style = ImGui::GetStyle();
    ImGui::PushFont(engine::ui_font(engine::UiFont::small));
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0.3f * style.FramePadding.x, 1.3f * style.FramePadding.y});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemInnerSpacing, {2.0f, style.ItemInnerSpacing.y});
  }
  ~TabStyle() {
    if (!dense_) return;
    ImGui::PopStyleVar(2);
    ImGui::PopFont();
  }
  TabStyle(const TabStyle&) = delete;
  TabStyle& operator=(const TabStyle&) = delete;

 private:
  bool dense_;
};

// Returns the gate of the replayed drive during a replay, otherwise the gate of the live lever.
const haptics::Gate& viewed_gate(const PanelInput& input) {
  return input.replay == nullptr ? input.gate : input.replay->drive().gate();
}

ShownPaths shown_paths(const PanelInput& input) {
  if (input.replay == nullptr || !input.replay->shift()) return {};
  const lessons::RecordedShift& shift = input.replay->drive().shifts()[*input.replay->shift()];
  return {shift.driven, shift.ideal};
}

// `open`: what ImGui::BeginTabItem() returned.
template <class Draw>
void draw_tab(Controls& controls, const Tab& tab, bool open, const Draw& draw) {
  controls.mark(tab.name);
  if (!open) return;
  begin_child(tab.name, {0.0f, 0.0f});
  draw();
  ImGui::EndChild();
  ImGui::EndTabItem();
}

}  // namespace

struct Panel::State {
  PanelView view = PanelView::engineer, shown = PanelView::engineer;  // `shown`: the last one that was not hidden
  bool lists_lessons = false;                                         // beside the learner's view
  bool help = false;
  std::string bindings;
  std::vector<TuningView::Step> steps;  // steps requested between two frames
  Controls controls;
  Trail trail;
  ForcePlots plots;
  ClipMeter clip;
  TuningView tuning;
  SetupView setup;
  PresetView presets;
  LessonsView lessons;
  HistoryView runs;
  LessonCard card;
  ReplayBar replay;
  EventList events;
  MessageNote note;
  bool message_fits = false;  // true if the status bar shows the whole message in this frame
  std::int64_t last_ns = -1;  // [ns] time of the newest snapshot of this run
  std::optional<std::uint64_t> run;
  haptics::GateDescription viewed;  // description of viewed_gate()
  ControlRect cabin_area, central_area;

  void follow(const PanelInput& input);
  void follow(const haptics::HapticSnapshot& snapshot);
  void draw_left(const Layout& layout, const PanelInput& input, PanelCommands& out);
  void draw_right(const Layout& layout, const PanelInput& input, PanelCommands& out);
  void draw_choices(const PanelInput& input, PanelCommands& out);
  void draw_tabs(const PanelInput& input, PanelCommands& out);
  void draw_lists(float bottom, const PanelInput& input, PanelCommands& out);
  void draw_learner(const PanelInput& input, PanelCommands& out);
  void draw_engineer(const PanelInput& input, PanelCommands& out);
  void draw_over_cabin(const PanelInput& input, PanelCommands& out);
  void draw_bar(const Layout& layout, const PanelInput& input, PanelCommands& out);
};

void Panel::State::follow(const haptics::HapticSnapshot& snapshot) {
  if (snapshot.time_ns <= last_ns) return;
  trail.push(snapshot);
  plots.push(snapshot);
  clip.push(snapshot);
  last_ns = snapshot.time_ns;
}

// Runs even while the panel is hidden, so that the plots are complete when it is shown again.
void Panel::State::follow(const PanelInput& input) {
  if (std::exchange(run, input.run) != input.run) {
    trail = Trail();
    plots.clear();
    clip = ClipMeter();
    last_ns = -1;
    viewed = haptics::describe_gate(viewed_gate(input));
  }
  // `now` may be newer than the end of the history. If it were added as well, the snapshots in between, which arrive in
  // the next frame, would be ignored as too old.
  for (const haptics::HapticSnapshot& snapshot : input.history) follow(snapshot);
  if (input.history.empty()) follow(input.now);
  events.add(input.events);
}

void Panel::State::draw_left(const Layout& layout, const PanelInput& input, PanelCommands& out) {
  if (begin_part("Lever", {0.0f, 0.0f}, {layout.left, layout.screen.y - layout.bar})) {
    title("Lever");
    plots.draw_axis_choice(controls);
    draw_view_reset(controls, out);
    const float spacing = ImGui::GetStyle().ItemSpacing.y;
    const float height = ImGui::GetContentRegionAvail().y - ClipMeter::height() - spacing;
    const float gate_height = 0.38f * height;
    const double max = std::max(input.device.max_force.x, input.device.max_force.y);
    const haptics::Gate& gate = viewed_gate(input);
    draw_gate_view({ImGui::GetContentRegionAvail().x, gate_height}, gate, viewed, input.now, trail, max,
                   shown_paths(input));
    plots.draw(controls, height - gate_height - spacing, gate, input.now, trail);
    clip.draw(controls, input.now, input.device);
  }
  ImGui::End();
}

void Panel::State::draw_choices(const PanelInput& input, PanelCommands& out) {
  const float label = 4.6f * engine::ui_em();
  if (input.replay != nullptr) put("Live settings, not the recording's:", ink::kWarn, engine::UiFont::small);
  const auto row = [&](const char* name, const char* caption, std::string_view current,
                       std::span<const std::string> options, auto command,
                       std::string (*text_of)(std::string_view) = nullptr) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("%s", caption);
    ImGui::SameLine(label);
    const auto chosen = controls.choice(name, current, options, ImGui::GetContentRegionAvail().x, text_of);
    if (!chosen) return;
    command.name = *chosen;
    out.push_back(command);
  };
  if (!input.cars.empty()) row("car", "Car", input.car_name, input.cars, ChooseCar{}, readable_name);
  row("gate", "Gate", input.gate_name, input.gates, ChooseGate{}, readable_name);
  row("preset", "Preset", input.preset_name, input.presets, ChoosePreset{});
  const auto fixed_row = [&](const char* caption, std::string_view value, ImU32 colour) {
    ImGui::TextDisabled("%s", caption);
    ImGui::SameLine(label);
    controls.line(value, ImGui::GetContentRegionAvail().x, colour);
  };
  if (input.hands.empty())
    fixed_row("Hand", input.hand_name, ink::kText);
  else
    row("hand", "Hand", input.hand_name, input.hands, ChooseHand{}, hand_label);
  fixed_row("Device", input.device_name, ink::kText);
  if (!input.controls.controllers.empty() && input.controls.setup == nullptr) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("Controls");
    ImGui::SameLine(label);
    if (controls.button("controls_setup", "Set up pedals and shifter")) out.push_back(StartControls{});
  }
  if (input.stick) fixed_row("", format_stick_state(*input.stick), input.stick->plugged_in ? ink::kSoft : ink::kBad);
}

void Panel::State::draw_tabs(const PanelInput& input, PanelCommands& out) {
  const bool dense = !tabs_fit(tabs_of(input));
  const auto bar = [&] {
    const TabStyle style(dense);
    return ImGui::BeginTabBar("parts");
  };
  const auto item = [&](const char* label) {
    const TabStyle style(dense);
    return ImGui::BeginTabItem(label);
  };
  const auto tab = [&](const Tab& which, const auto& draw_it) {
    draw_tab(controls, which, item(which.label), draw_it);
  };
  if (!bar()) return;
  tab(kTabs[0], [&] { lessons.draw(controls, input.coach, input.is_automatic_hand, out); });
  tab(kTabs[1], [&] { runs.draw(controls, input.coach, out); });
  tab(kTabs[2], [&] {
    tuning.draw(controls, input, out);
    events.draw(!input.device.measures_hand_force);
  });
  tab(kTabs[3], [&] { setup.draw(controls, input, out); });
  tab(kTabs[4], [&] { draw_loop_view(input); });
  tab(kTabs[5], [&] { presets.draw(controls, input, out); });
  if (input.headset) tab(kTabs[6], [&] { draw_headset_tab(controls, input, out); });
  ImGui::EndTabBar();
}

void Panel::State::draw_right(const Layout& layout, const PanelInput& input, PanelCommands& out) {
  if (begin_part("Haptics", {layout.screen.x - layout.right, 0.0f}, {layout.right, layout.screen.y - layout.bar})) {
    draw_choices(input, out);
    ImGui::Spacing();
    draw_tabs(input, out);
  }
  ImGui::End();
}

// Draws the parts that are shown even while the panel is hidden: note, replay bar and cards. During a replay the lesson
// card is hidden unless a lesson is being driven; it is hidden while controllers are set up. Bar and cards reduce the
// cabin's area.
void Panel::State::draw_over_cabin(const PanelInput& input, PanelCommands& out) {
  const ControlRect room = central_area = cabin_area;
  const bool has_card = input.coach.phase == lessons::LessonPhase::driving;
  const std::string_view to_do = input.reply.empty() || has_card ? stick_request(input) : input.reply;
  note.draw(input.message, message_fits, to_do, room);
  cabin_area.max.y = replay.draw(controls, input, room, out);
  const bool shows_lesson = input.replay == nullptr || input.coach.phase == lessons::LessonPhase::driving;
  if (shows_lesson && input.controls.setup == nullptr)
    cabin_area.max.y = card.draw(controls, input, view, cabin_area, out);
  cabin_area.max.y = draw_controls_card(controls, input, cabin_area, out);
}

void Panel::State::draw_bar(const Layout& layout, const PanelInput& input, PanelCommands& out) {
  if (begin_part(kBarName, {0.0f, layout.screen.y - layout.bar}, {layout.screen.x, layout.bar}))
    message_fits = draw_control_bar(controls, input, out);
  ImGui::End();
}

// Lessons and history in a column at the right, above the learner's strip.
void Panel::State::draw_lists(float bottom, const PanelInput& input, PanelCommands& out) {
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  const float width = std::min(std::clamp(0.3f * screen.x, 20.5f * engine::ui_em(), 30.0f * engine::ui_em()), screen.x);
  if (begin_part("Lists", {screen.x - width, 0.0f}, {width, bottom})) {
    if (ImGui::BeginTabBar("lists")) {
      const auto tab = [&](const Tab& which, const auto& draw_it) {
        draw_tab(controls, which, ImGui::BeginTabItem(which.label), draw_it);
      };
      tab(kTabs[0], [&] { lessons.draw(controls, input.coach, input.is_automatic_hand, out); });
      tab(kTabs[1], [&] { runs.draw(controls, input.coach, out); });
      ImGui::EndTabBar();
    }
  }
  ImGui::End();
  cabin_area.max.x = static_cast<double>(screen.x - width);
}

void Panel::State::draw_learner(const PanelInput& input, PanelCommands& out) {
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  const float height = learner_strip_height(screen);
  cabin_area.max.y = static_cast<double>(screen.y - height);
  if (lists_lessons) draw_lists(screen.y - height, input, out);
  if (begin_part(kBarName, {0.0f, screen.y - height}, {screen.x, height})) {
    const LearnerChoice chosen = draw_learner_strip(controls, input, viewed, lists_lessons, out);
    if (chosen.lessons) lists_lessons = !lists_lessons;
    if (chosen.engineer) view = shown = PanelView::engineer;
  }
  ImGui::End();
}

void Panel::State::draw_engineer(const PanelInput& input, PanelCommands& out) {
  const Layout layout = make_layout();
  cabin_area = {{layout.left, 0.0}, {layout.screen.x - layout.right, layout.screen.y - layout.bar}};
  if (layout.left > 0.0f) draw_left(layout, input, out);
  draw_right(layout, input, out);
  draw_bar(layout, input, out);
}

Panel::Panel() : state_(std::make_unique<State>()) {}
Panel::~Panel() = default;

PanelCommands Panel::draw(const PanelInput& input) {
  State& s = *state_;
  PanelCommands out;
  s.controls.begin_frame();
  update_keyboard_focus(kBarName, visible(), s.controls.tab_stops());
  s.follow(input);
  for (const TuningView::Step step : s.steps) s.tuning.apply_step(step, input, out);
  s.steps.clear();
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  s.message_fits = false;
  s.cabin_area = {{0.0, 0.0}, {screen.x, screen.y}};
  const PanelView view = s.view;
  if (view == PanelView::learner) s.draw_learner(input, out);
  if (view == PanelView::engineer) s.draw_engineer(input, out);
  s.draw_over_cabin(input, out);
  draw_help(s.help, s.bindings);
  return out;
}

void Panel::undo() {
  state_->steps.push_back(TuningView::Step::undo);
}
void Panel::redo() {
  state_->steps.push_back(TuningView::Step::redo);
}
ControlRect Panel::cabin_area() const noexcept {
  return state_->cabin_area;
}
ControlRect Panel::central_area() const noexcept {
  return state_->central_area;
}
bool Panel::covers(glm::dvec2 mouse) const {
  return panel_covers(mouse);
}
bool Panel::has_keyboard() const {
  return panel_has_keyboard();
}
void Panel::set_visible(bool on) noexcept {
  state_->view = on ? state_->shown : PanelView::hidden;
}
PanelView Panel::view() const noexcept {
  return state_->view;
}
void Panel::set_view(PanelView view) noexcept {
  state_->view = view;
  if (view != PanelView::hidden) state_->shown = view;
}
void Panel::toggle_lessons() noexcept {
  state_->lists_lessons = !state_->lists_lessons;
}
bool Panel::shows_help() const noexcept {
  return state_->help;
}
void Panel::show_help(bool on, const std::string& bindings_text) {
  state_->help = on;
  state_->bindings = bindings_text;
}
std::optional<ControlRect> Panel::control_rect(std::string_view name) const {
  return state_->controls.rect(name);
}
int Panel::shortened_texts() const noexcept {
  return state_->controls.shortened();
}

}  // namespace gearshift::ui
