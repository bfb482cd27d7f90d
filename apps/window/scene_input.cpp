#include "apps/window/scene_input.h"

#include "apps/window/keyboard.h"

#include <imgui.h>
#include <optional>

namespace sinew::window {
namespace {

std::optional<play::Button> button_of(int number) {
    if (number == SDL_BUTTON_LEFT) return play::Button::left;
    if (number == SDL_BUTTON_MIDDLE) return play::Button::middle;
    if (number == SDL_BUTTON_RIGHT) return play::Button::right;
    return std::nullopt;
}

/// True for the mouse events that SDL makes of the first finger: meant for the panel, not for the scene.
bool is_a_finger(Uint32 mouse) {
    return mouse == SDL_TOUCH_MOUSEID;
}

} // namespace

void SceneInput::take(const SDL_Event& event) {
    switch (event.type) {
    case SDL_MOUSEMOTION:
        return take_motion(event.motion);
    case SDL_MOUSEBUTTONDOWN:
        return take_press(event.button);
    case SDL_MOUSEBUTTONUP:
        return take_release(event.button);
    case SDL_MOUSEWHEEL:
        return take_wheel(event.wheel);
    case SDL_FINGERDOWN:
    case SDL_FINGERMOTION:
    case SDL_FINGERUP:
        return take_finger(event.tfinger);
    case SDL_KEYDOWN:
        return take_key(event.key.keysym);
    case SDL_KEYUP:
        return play_.handle(play::KeyUp{name_of_key(event.key.keysym)});
    case SDL_WINDOWEVENT:
        if (event.window.event == SDL_WINDOWEVENT_LEAVE && !dragging_) play_.handle(play::Left{});
        return;
    default:
        return;
    }
}

void SceneInput::take_motion(const SDL_MouseMotionEvent& motion) {
    if (is_a_finger(motion.which)) return;
    if (is_free(motion.x, motion.y) || dragging_)
        play_.handle(play::Moved{in_scene(motion.x, motion.y)});
    else
        play_.handle(play::Left{});
}

/// Captures the mouse, so that a drag continues beyond the window's edge.
void SceneInput::take_press(const SDL_MouseButtonEvent& pressed) {
    if (!is_free(pressed.x, pressed.y) || is_a_finger(pressed.which)) return;
    play_.handle(play::Moved{in_scene(pressed.x, pressed.y)});
    const auto button = button_of(pressed.button);
    if (!button) return;
    dragging_ = true;
    SDL_CaptureMouse(SDL_TRUE);
    play_.handle(play::Pressed{*button});
}

void SceneInput::take_release(const SDL_MouseButtonEvent& released) {
    const auto button = button_of(released.button);
    if (is_a_finger(released.which) || !button || !dragging_) return;
    dragging_ = false;
    SDL_CaptureMouse(SDL_FALSE);
    play_.handle(play::Released{*button});
}

void SceneInput::take_wheel(const SDL_MouseWheelEvent& wheel) {
    int x = 0, y = 0;
    SDL_GetMouseState(&x, &y);
    if (is_free(x, y)) play_.handle(play::Scrolled{double(wheel.preciseY)});
}

/// Escape leaves a text field and closes the dialog around the field.
void SceneInput::take_key(const SDL_Keysym& key) {
    const bool typing = ImGui::GetIO().WantTextInput;
    const auto name = name_of_key(key);
    if (panel_.take_key(name) || (typing && name != "escape")) return;
    play_.handle(play::Key{name});
}

void SceneInput::take_finger(const SDL_TouchFingerEvent& finger) {
    const auto at = in_scene(finger);
    if (finger.type == SDL_FINGERUP)
        touch_.up(finger.fingerId);
    else if (finger.type == SDL_FINGERMOTION)
        touch_.move(finger.fingerId, at);
    else if (is_scene(at))
        touch_.down(finger.fingerId, at);
}

/// True if a pointer at this position is over the scene. Decided by the layout, not by ImGui's last frame: a pointer
/// that leaves a button and is pressed at once is already over the scene.
bool SceneInput::is_free(int x, int y) const {
    const double scale = screen_.pointer_scale();
    return panel_.leaves_to_scene(x * scale, y * scale);
}

/// Decided by the layout: fingers do not hover, so ImGui has not seen the pointer arrive.
bool SceneInput::is_scene(Vec2<double> at) const {
    const auto& area = panel_.scene();
    return panel_.leaves_to_scene(at[0] + area.left, at[1] + area.top);
}

Vec2<double> SceneInput::in_scene(int x, int y) const {
    const double scale = screen_.pointer_scale();
    const auto& area = panel_.scene();
    return {{x * scale - area.left, y * scale - area.top}};
}

Vec2<double> SceneInput::in_scene(const SDL_TouchFingerEvent& finger) const {
    const auto& area = panel_.scene();
    return {{double(finger.x) * screen_.width() - area.left, double(finger.y) * screen_.height() - area.top}};
}

} // namespace sinew::window
