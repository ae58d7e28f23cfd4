#include <algorithm>
#include <cmath>

#include "engine/ui/ui.h"
#include "engine/ui/ui_state.h"
#include "engine/ui/ui_style.h"

namespace gearshift::engine {

UiContext::UiContext() : state_(std::make_unique<State>()) {
  IMGUI_CHECKVERSION();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.LogFilename = nullptr;
  io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;  // allows more than 65536 vertices with 16-bit indices
  io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard | ImGuiConfigFlags_NavNoCaptureKeyboard;
}

UiContext::~UiContext() {
  ImGui::DestroyContext(state_->context);
}

void UiContext::feed(const UiEvents& events) {
  ImGui::SetCurrentContext(state_->context);
  state_->queue.push(events);
}

void UiContext::begin(const UiInput& input) {
  ImGui::SetCurrentContext(state_->context);
  const float scale = std::clamp(input.scale, 0.5f, 8.0f);
  if (std::abs(scale - state_->scale) > 0.005f) {
    apply_ui_style(scale);
    ImGui::GetIO().Fonts->SetTexID(font_texture());
    state_->scale = scale;
    ++state_->font_version;
  }
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {input.width, input.height};
  io.DeltaTime = std::max(input.seconds, 1e-5f);
  state_->queue.start_frame();
  ImGui::NewFrame();
}

void UiContext::end() {
  ImGui::SetCurrentContext(state_->context);
  ImGui::Render();
}

}  // namespace gearshift::engine
