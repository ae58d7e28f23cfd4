// Sliders for parameters that may change while the loop runs, each with its stable range.
//
// An admissible edit is applied at once. If an edit is not admissible, the running value stays active and the reason is
// shown.
#pragma once

#include <array>
#include <cstddef>

#include "app/ui/panel/panel.h"
#include "app/ui/panel/tuning_check.h"
#include "app/ui/panel/tuning_history.h"

namespace gearshift::ui {

class TuningView {
 public:
  enum class Step { undo, redo, reset, switch_slot };

  void apply_step(Step step, const PanelInput& input, PanelCommands& out);
  void draw(Controls& controls, const PanelInput& input, PanelCommands& out);

 private:
  void follow(const PanelInput& input);  // the running values may have changed
  TuningQuestion question(const PanelInput& input, const haptics::HapticTuning& tuning) const;
  const TuningAnswer& judged(const PanelInput& input) { return judge_.judge(question(input, edited_)); }
  bool is_refused(const PanelInput& input) { return edited_ != running_ && !judged(input).admissible; }
  void request(const haptics::HapticTuning& tuning, PanelCommands& out);
  void show(const haptics::HapticTuning& tuning, const PanelInput& input, PanelCommands& out);
  void edit(const haptics::HapticTuning& tuning, const PanelInput& input, PanelCommands& out);
  bool was_requested(const haptics::HapticTuning& tuning) const;

  void draw_steps(Controls& controls, const PanelInput& input, PanelCommands& out);
  void draw_field(std::size_t index, Controls& controls, const PanelInput& input, PanelCommands& out);
  void draw_verdict(Controls& controls, const PanelInput& input, PanelCommands& out);
  void draw_refusal(Controls& controls, const PanelInput& input, PanelCommands& out);

  TuningHistory history_;
  TuningJudge judge_;
  StableRanges ranges_{};  // stable ranges as last drawn
  haptics::HapticTuning edited_, running_;
  std::array<haptics::HapticTuning, 8> requested_{};  // newest requests: the caller may apply one some frames later
  std::size_t request_count_ = 0;
  bool same_drag_ = false;  // true after the first change in the current drag of a slider
  bool started_ = false;
};

}  // namespace gearshift::ui
