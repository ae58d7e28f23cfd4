#include "app/ui/panel/loop_view.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "app/ui/panel/palette.h"
#include "app/ui/panel/table_rows.h"

namespace gearshift::ui {
namespace {

constexpr std::array<const char*, 8> kStages{"read", "estimate", "proxy", "coupling", "feel", "load", "guard", "write"};

std::string microseconds(double seconds) {
  return fmt::format("{:.0f} µs", 1e6 * seconds);
}

void draw_timing(const PanelInput& input) {
  const runtime::LoopHealth& health = input.health;
  const double period = health.rate > 0.0 ? 1.0 / health.rate : 0.0;
  if (!ImGui::BeginTable("timing", 2, ImGuiTableFlags_SizingStretchProp)) return;
  table_row("Rate", fmt::format("{:.0f} Hz, period {}", health.rate, microseconds(period)));
  table_row("Lateness median", microseconds(health.late_p50));
  table_row("Lateness p99", microseconds(health.late_p99), health.late_p99 > period ? ink::kWarn : ink::kText);
  table_row("Lateness max", microseconds(health.late_worst), health.late_worst > period ? ink::kWarn : ink::kText);
  table_row("Deadlines missed", fmt::format("{}", health.skipped), health.skipped > 0 ? ink::kWarn : ink::kText);
  table_row("Cycle overruns", fmt::format("{}", health.overruns), health.overruns > 0 ? ink::kWarn : ink::kText);
  table_row("Thread", health.realtime ? "real-time" : "not real-time", health.realtime ? ink::kGood : ink::kWarn);
  table_row("Cycle", fmt::format("{:.2f} µs, {:.2f} % of period", 1e-3 * health.cycle_ns,
                                 period > 0.0 ? 1e-7 * health.cycle_ns / period : 0.0));
  table_row("Force scale", fmt::format("{:.0f} % of real forces", 100.0 * input.car.force_scale));
  table_row("Frame", fmt::format("{:.1f} ms", input.frame_ms));
  table_row("Stiffness in use", fmt::format("{:.0f} N/m", input.now.wall_stiffness),
            input.now.wall_stiffness < 0.999 * input.admitted.tuning.wall_stiffness ? ink::kWarn : ink::kText);
  ImGui::EndTable();
  if (!health.not_realtime_reason.empty()) ImGui::TextWrapped("%s", health.not_realtime_reason.c_str());
}

void draw_stages(const runtime::LoopHealth& health) {
  const double max = std::max(1.0, *std::max_element(health.stage_ns.begin(), health.stage_ns.end()));
  if (!ImGui::BeginTable("stages", 3, ImGuiTableFlags_SizingStretchProp)) return;
  ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthFixed, 4.6f * engine::ui_em());
  ImGui::TableSetupColumn("cost", ImGuiTableColumnFlags_WidthFixed, 4.6f * engine::ui_em());
  ImGui::TableSetupColumn("bar");
  for (std::size_t i = 0; i < kStages.size(); ++i) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", kStages[i]);
    ImGui::TableNextColumn();
    ImGui::Text("%.0f ns", health.stage_ns[i]);
    ImGui::TableNextColumn();
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const float line = ImGui::GetTextLineHeight();
    const float width = ImGui::GetContentRegionAvail().x * static_cast<float>(health.stage_ns[i] / max);
    ImGui::GetWindowDrawList()->AddRectFilled({low.x, low.y + 0.2f * line}, {low.x + width, low.y + 0.85f * line},
                                              ink::kAccentDeep, 2.0f);
  }
  ImGui::EndTable();
}

}  // namespace

void draw_loop_view(const PanelInput& input) {
  draw_timing(input);
  ImGui::Spacing();
  ImGui::TextDisabled("Time per cycle stage");
  draw_stages(input.health);
}

}  // namespace gearshift::ui
