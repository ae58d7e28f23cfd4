// Sliders for what may change while the loop runs, each with what is stable beside it.
//
// An edit is applied at once where it is admitted as it is. Otherwise the running value stays, and why is told.
#pragma once

#include <array>
#include <cstddef>

#include "app/panel/panel.h"
#include "app/panel/tuning_answer.h"
#include "app/panel/tuning_history.h"

namespace gearshift {

class TuningView {
 public:
  enum class Step { undo, redo, reset, other_slot };

  void follow(const PanelInput& input);  // once a frame, first: what runs may have been changed elsewhere
  void take(Step step, const PanelInput& input, PanelRequests& out);
  void draw(Controls& controls, const PanelInput& input, PanelRequests& out);

 private:
  TuningQuestion question(const PanelInput& input, const HapticTuning& tuning) const;
  const TuningAnswer& judged(const PanelInput& input) { return judge_.judge(question(input, edited_)); }
  bool is_refused(const PanelInput& input) { return edited_ != running_ && !judged(input).admissible; }
  void request(const HapticTuning& tuning, PanelRequests& out);
  void show(const HapticTuning& tuning, const PanelInput& input, PanelRequests& out);
  void edit(const HapticTuning& tuning, const PanelInput& input, PanelRequests& out);
  bool was_asked_for(const HapticTuning& tuning) const;

  void draw_steps(Controls& controls, const PanelInput& input, PanelRequests& out);
  void draw_field(std::size_t index, Controls& controls, const PanelInput& input, PanelRequests& out);
  void draw_verdict(Controls& controls, const PanelInput& input, PanelRequests& out);
  void draw_refusal(Controls& controls, const PanelInput& input, PanelRequests& out);

  TuningHistory history_;
  TuningJudge judge_;
  StableRanges ranges_{};  // as last drawn
  HapticTuning edited_, running_;
  std::array<HapticTuning, 8> asked_for_{};  // ring: a caller may be some frames late
  std::size_t asks_ = 0;
  bool goes_on_ = false;  // a change was made since the slider was grabbed
  bool started_ = false;
};

}  // namespace gearshift
