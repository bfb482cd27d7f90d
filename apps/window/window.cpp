#include "apps/window/window.h"

#include "apps/window/gl_painter.h"
#include "apps/window/keyboard.h"
#include "apps/window/panel.h"
#include "apps/window/screen.h"
#include "apps/window/settings.h"
#include "canvas/interrupt.h"
#include "player/touch.h"

#include <algorithm>
#include <backends/imgui_impl_opengl3.h>
#include <backends/imgui_impl_sdl.h>
#include <cfloat>
#include <chrono>
#include <epoxy/gl.h>
#include <imgui.h>
#include <utility>
#include <vector>

namespace sinew::window {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_between(Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double>(to - from).count();
}

class Window {
  public:
    explicit Window(play::Play& play) : play_(play), touch_(play), panel_(play) {}

    std::optional<std::string> run() {
        begin();
        if (auto problem = screen_.open("Sinew", settings_.width, settings_.height)) return problem;
        ImGui::CreateContext();
        ImGui::GetIO().IniFilename = nullptr;
        ImGui_ImplSDL2_InitForOpenGL(screen_.window(), screen_.context());
        if (auto problem = prepare()) return problem;
        auto last = Clock::now();
        while (!play_.quit && !canvas::interrupted()) {
            const auto now = Clock::now();
            frame(seconds_between(last, now));
            last = now;
            if (is_lost_ || screen_.lost())
                if (auto problem = start_anew()) {
                    play_.write_draft();
                    return problem;
                }
            is_lost_ = false;
            if (!play_.free_running) rest(now);
        }
        finish();
        return std::nullopt;
    }

  private:
    play::Play& play_;
    play::Touch touch_;
    Settings settings_;
    Screen screen_;
    Panel panel_;
    std::unique_ptr<GlPainter> painter_;
    std::vector<Picture> pictures_; ///< per pane
    Area area_;                     ///< area of the scene
    std::vector<SDL_Scancode> new_keys_;
    std::vector<SDL_Event> late_releases_;
    std::string title_;
    std::int64_t frames_ = 0;
    double shown_ = 0, stepping_ = 0, gathering_ = 0, painting_ = 0; ///< seconds, summed over all frames

    /// Applies the settings to the game.
    void begin() {
        settings_ = load_settings();
        play_.theme = settings_.theme;
        play_.panel = settings_.panel;
        play_.free_running = settings_.free_running;
        play_.hint = settings_.hint;
        play_.recent = settings_.recent;
        play_.keys.chosen = settings_.keys;
        panel_.set_text_size(settings_.text_size);
        play_.clipboard = [] {
            char* const text = SDL_GetClipboardText();
            const std::string copy = text ? text : "";
            SDL_free(text);
            return copy;
        };
        play_.set_clipboard = [](const std::string& text) { SDL_SetClipboardText(text.c_str()); };
        play_.keep_draft_in(draft_path());
        play_.offer_draft();
    }

    void save_settings() {
        int width = 0, height = 0;
        SDL_GetWindowSize(screen_.window(), &width, &height);
        const double scale = screen_.size_scale();
        settings_.theme = play_.theme;
        settings_.width = std::max(int(width / scale), 1), settings_.height = std::max(int(height / scale), 1);
        settings_.panel = play_.panel;
        settings_.free_running = play_.free_running;
        settings_.text_size = panel_.text_size();
        settings_.hint = settings_.hint && play_.hint;
        settings_.recent = play_.recent;
        settings_.keys = play_.keys.chosen;
        window::save_settings(settings_);
    }

    /// Creates the objects of the OpenGL context.
    std::optional<std::string> prepare() {
        painter_ = std::make_unique<GlPainter>();
        if (!painter_->problem().empty()) return painter_->problem();
        if (!ImGui_ImplOpenGL3_Init("#version 330 core")) return "OpenGL cannot draw the panel";
        return std::nullopt;
    }

    /// Creates all objects again in a new context after the old one was lost; the session is not affected.
    std::optional<std::string> start_anew() {
        ImGui_ImplOpenGL3_Shutdown();
        painter_.reset();
        panel_.forget_textures();
        if (auto problem = screen_.renew()) return problem;
        return prepare();
    }

    void finish() {
        const double each = frames_ > 0 ? 1000 / double(frames_) : 0;
        play_.tell("end", {{"hash", play_.hash()},
                           {"frames", frames_},
                           {"seconds_shown", shown_},
                           {"ms_step", stepping_ * each},
                           {"ms_gather", gathering_ * each},
                           {"ms_paint", painting_ * each}});
        save_settings();
        if (!play_.quit) play_.write_draft(); // interrupted, without a question about unsaved edits
        ImGui_ImplOpenGL3_Shutdown();
        ImGui_ImplSDL2_Shutdown();
        ImGui::DestroyContext();
        painter_.reset();
    }

    void frame(double passed) {
        const int width = screen_.width(), height = screen_.height();
        const double density = screen_.density();
        panel_.arrange(width, height, density);
        area_ = panel_.scene();
        play_.resize(area_.width, area_.height, density);
        for (const auto& event : std::exchange(late_releases_, {})) ImGui_ImplSDL2_ProcessEvent(&event);
        new_keys_.clear();
        for (SDL_Event event; SDL_PollEvent(&event);) {
            tell_gui(event);
            take(event);
        }
        if (screen_.minimized() || width < 1 || height < 1) { // invisible: simulated time stops
            SDL_Delay(50);
            return;
        }
        panel_.measure_frame(passed);
        const auto begin = Clock::now();
        step(passed);
        const auto stepped = Clock::now();
        play_.draw_panes(pictures_);
        const auto drawn = Clock::now();
        name_window();
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        glDisable(GL_SCISSOR_TEST); // panes of a split view may leave a column uncovered
        glClear(GL_COLOR_BUFFER_BIT);
        for (std::size_t i = 0; i < pictures_.size() && i < play_.pane_count(); ++i)
            painter_->paint(pictures_[i], area_.left + play_.pane_left(i), height - area_.top - area_.height);
        glViewport(0, 0, width, height);
        ImGui_ImplOpenGL3_NewFrame();
        ImGui_ImplSDL2_NewFrame();
        tell_gui_of_pixels();
        ImGui::NewFrame();
        panel_.show();
        ImGui::Render();
        ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
        screen_.wait_for_display(!play_.free_running);
        screen_.show();
        ++frames_;
        shown_ += passed;
        stepping_ += seconds_between(begin, stepped);
        gathering_ += seconds_between(stepped, drawn);
        painting_ += seconds_between(drawn, Clock::now());
    }

    /// ImGui's back-end asks the display server for the pointer, which on X11 returns an old position after a button
    /// was pressed; and the back-end counts in units of the window, the panel in pixels.
    void tell_gui_of_pixels() const {
        auto& io = ImGui::GetIO();
        io.DisplaySize = {float(screen_.width()), float(screen_.height())};
        io.DisplayFramebufferScale = {1, 1};
        const auto scale = float(screen_.pointer_scale());
        int x = 0, y = 0;
        const bool is_pressed = SDL_GetMouseState(&x, &y) != 0;
        const bool is_here = SDL_GetMouseFocus() == screen_.window() || is_pressed;
        io.MousePos = is_here ? ImVec2{float(x) * scale, float(y) * scale} : ImVec2{-FLT_MAX, -FLT_MAX};
    }

    /// Limits the rate to 250 pictures per second where the display does not make the program wait.
    static void rest(Clock::time_point begin) {
        constexpr double shortest = 1.0 / 250;
        const double left = shortest - seconds_between(begin, Clock::now());
        if (left > 0) SDL_Delay(Uint32(left * 1000));
    }

    /// Takes the steps that are due, for at most about 25 ms.
    void step(double passed) {
        constexpr double longest = 0.025; // seconds
        const auto begin = Clock::now();
        const auto before = play_.tape().now();
        const auto phases = std::make_shared<PhaseTimes>();
        play_.report({.times = phases, .preparing = {}});
        play_.advance(passed, [&] { return seconds_between(begin, Clock::now()) > longest; });
        panel_.measure_steps(seconds_between(begin, Clock::now()), play_.tape().now() - before, *phases);
    }

    void name_window() {
        const auto title = play_.scene_name() + (play_.is_edited() ? " * - Sinew" : " - Sinew");
        if (title == title_) return;
        title_ = title;
        SDL_SetWindowTitle(screen_.window(), title_.c_str());
    }

    Vec2<double> in_scene(int x, int y) const {
        const double scale = screen_.pointer_scale();
        return {{x * scale - area_.left, y * scale - area_.top}};
    }

    /// ImGui samples keys once per frame: if press and release fall into one frame, the release is passed on in the
    /// next.
    void tell_gui(const SDL_Event& event) {
        const bool is_new = event.type == SDL_KEYUP &&
                            std::find(new_keys_.begin(), new_keys_.end(), event.key.keysym.scancode) != new_keys_.end();
        if (is_new) return late_releases_.push_back(event);
        if (event.type == SDL_KEYDOWN) new_keys_.push_back(event.key.keysym.scancode);
        ImGui_ImplSDL2_ProcessEvent(&event);
    }

    void take(const SDL_Event& event) {
        const bool typing = ImGui::GetIO().WantTextInput;
        switch (event.type) {
        case SDL_QUIT:
            play_.ask_to_quit();
            break;
        case SDL_RENDER_DEVICE_RESET:
        case SDL_RENDER_TARGETS_RESET:
            is_lost_ = true;
            break;
        case SDL_DROPFILE:
            play_.open(event.drop.file);
            SDL_free(event.drop.file);
            break;
        case SDL_DROPTEXT:
            play_.open_text(event.drop.file, "dropped");
            SDL_free(event.drop.file);
            break;
        case SDL_MOUSEMOTION:
            if (is_a_finger(event.motion.which)) break;
            if (is_free(event.motion.x, event.motion.y) || dragging_)
                play_.handle(play::Moved{in_scene(event.motion.x, event.motion.y)});
            else
                play_.handle(play::Left{});
            break;
        case SDL_MOUSEBUTTONDOWN:
            if (!is_free(event.button.x, event.button.y) || is_a_finger(event.button.which)) break;
            play_.handle(play::Moved{in_scene(event.button.x, event.button.y)});
            if (const auto button = button_of(event.button.button)) press(*button);
            break;
        case SDL_MOUSEBUTTONUP:
            if (is_a_finger(event.button.which)) break;
            if (const auto button = button_of(event.button.button); button && dragging_) release(*button);
            break;
        case SDL_MOUSEWHEEL:
            if (is_free_now()) play_.handle(play::Scrolled{double(event.wheel.preciseY)});
            break;
        case SDL_FINGERDOWN:
            if (const auto at = under(event.tfinger); is_scene(at)) touch_.down(event.tfinger.fingerId, at);
            break;
        case SDL_FINGERMOTION:
            touch_.move(event.tfinger.fingerId, under(event.tfinger));
            break;
        case SDL_FINGERUP:
            touch_.up(event.tfinger.fingerId);
            break;
        case SDL_KEYDOWN:
            press_key(event.key.keysym, typing);
            break;
        case SDL_KEYUP:
            play_.handle(play::KeyUp{name_of_key(event.key.keysym)});
            break;
        case SDL_WINDOWEVENT:
            if (event.window.event == SDL_WINDOWEVENT_LEAVE && !dragging_) play_.handle(play::Left{});
            break;
        default:
            break;
        }
    }

    bool dragging_ = false, is_lost_ = false;

    /// True if a pointer at this position is over the scene. Decided by the layout, not by ImGui's last frame: a
    /// pointer that leaves a button and is pressed at once is already over the scene.
    bool is_free(int x, int y) const {
        const double scale = screen_.pointer_scale();
        return panel_.leaves_to_scene(x * scale, y * scale);
    }
    bool is_free_now() const {
        int x = 0, y = 0;
        SDL_GetMouseState(&x, &y);
        return is_free(x, y);
    }

    /// Escape leaves a text field and closes the dialog around the field.
    void press_key(const SDL_Keysym& key, bool typing) {
        const auto name = name_of_key(key);
        if (panel_.take_key(name) || (typing && name != "escape")) return;
        play_.handle(play::Key{name});
    }

    static std::optional<play::Button> button_of(int number) {
        if (number == SDL_BUTTON_LEFT) return play::Button::left;
        if (number == SDL_BUTTON_MIDDLE) return play::Button::middle;
        if (number == SDL_BUTTON_RIGHT) return play::Button::right;
        return std::nullopt;
    }

    /// Captures the mouse, so that a drag continues beyond the window's edge.
    void press(play::Button button) {
        dragging_ = true;
        SDL_CaptureMouse(SDL_TRUE);
        play_.handle(play::Pressed{button});
    }
    void release(play::Button button) {
        dragging_ = false;
        SDL_CaptureMouse(SDL_FALSE);
        play_.handle(play::Released{button});
    }

    /// True for the mouse events that SDL makes of the first finger: meant for the panel, not for the scene.
    static bool is_a_finger(Uint32 mouse) { return mouse == SDL_TOUCH_MOUSEID; }

    /// Decided by the layout: fingers do not hover, so ImGui has not seen the pointer arrive.
    bool is_scene(Vec2<double> at) const { return panel_.leaves_to_scene(at[0] + area_.left, at[1] + area_.top); }

    Vec2<double> under(const SDL_TouchFingerEvent& finger) const {
        return {{double(finger.x) * screen_.width() - area_.left, double(finger.y) * screen_.height() - area_.top}};
    }
};

} // namespace

std::optional<std::string> show(play::Play& play) {
    return Window(play).run();
}

} // namespace sinew::window
