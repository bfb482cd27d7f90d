#include "apps/window/gui_input.h"

#include <algorithm>
#include <backends/imgui_impl_sdl.h>
#include <cfloat>
#include <imgui.h>
#include <utility>

namespace sinew::window {

void GuiInput::begin() {
    for (const auto& event : std::exchange(late_releases_, {})) ImGui_ImplSDL2_ProcessEvent(&event);
    new_keys_.clear();
}

void GuiInput::take(const SDL_Event& event) {
    const bool is_new = event.type == SDL_KEYUP &&
                        std::find(new_keys_.begin(), new_keys_.end(), event.key.keysym.scancode) != new_keys_.end();
    if (is_new) return late_releases_.push_back(event);
    const bool is_tab = (event.type == SDL_KEYDOWN || event.type == SDL_KEYUP) && event.key.keysym.sym == SDLK_TAB;
    if (is_tab && !ImGui::GetIO().WantTextInput) return; // the panel's key; ImGui would go into a field as well
    if (event.type == SDL_KEYDOWN) new_keys_.push_back(event.key.keysym.scancode);
    ImGui_ImplSDL2_ProcessEvent(&event);
}

void GuiInput::measure(const Screen& screen) {
    auto& io = ImGui::GetIO();
    io.DisplaySize = {float(screen.width()), float(screen.height())};
    io.DisplayFramebufferScale = {1, 1};
    const auto scale = float(screen.pointer_scale());
    int x = 0, y = 0;
    const bool is_pressed = SDL_GetMouseState(&x, &y) != 0;
    const bool is_here = SDL_GetMouseFocus() == screen.window() || is_pressed;
    io.MousePos = is_here ? ImVec2{float(x) * scale, float(y) * scale} : ImVec2{-FLT_MAX, -FLT_MAX};
}

} // namespace sinew::window
