#include "apps/window/window.h"

#include "apps/window/gl_painter.h"
#include "apps/window/gui_input.h"
#include "apps/window/panel.h"
#include "apps/window/scene_input.h"
#include "apps/window/screen.h"
#include "apps/window/settings.h"
#include "canvas/interrupt.h"

#include <algorithm>
#include <backends/imgui_impl_opengl3.h>
#include <backends/imgui_impl_sdl.h>
#include <chrono>
#include <epoxy/gl.h>
#include <imgui.h>
#include <vector>

namespace sinew::window {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_between(Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double>(to - from).count();
}

/// Seconds of all frames so far, by their cause.
struct FrameTimes {
    std::int64_t frames = 0;
    double shown = 0, stepping = 0, gathering = 0, painting = 0;

    json::Object means() const {
        const double each = frames > 0 ? 1000 / double(frames) : 0;
        return {{"frames", frames},
                {"seconds_shown", shown},
                {"ms_step", stepping * each},
                {"ms_gather", gathering * each},
                {"ms_paint", painting * each}};
    }
};

class Window {
  public:
    explicit Window(play::Play& play) : play_(play), panel_(play), input_(play, screen_, panel_) {}

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
    Settings settings_;
    Screen screen_;
    Panel panel_;
    SceneInput input_;
    GuiInput gui_input_;
    std::unique_ptr<GlPainter> painter_;
    std::vector<Picture> pictures_; ///< per pane
    Area area_;                     ///< area of the scene
    std::string title_;
    bool is_lost_ = false; ///< an event has reported lost textures
    FrameTimes times_;

    /// Applies the settings to the game.
    void begin() {
        settings_ = load_settings();
        play_.theme = settings_.theme;
        play_.panel = settings_.panel;
        play_.free_running = settings_.free_running;
        if (settings_.hint) play_.tour.begin();
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
        play_.record_in(recordings_path());
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
        settings_.hint = false;
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
        auto told = times_.means();
        told.insert(told.begin(), {"hash", play_.hash()});
        play_.tell("end", std::move(told));
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
        gui_input_.begin();
        for (SDL_Event event; SDL_PollEvent(&event);) {
            gui_input_.take(event);
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
        paint_scene(height);
        glViewport(0, 0, width, height);
        paint_panel();
        screen_.wait_for_display(!play_.free_running);
        screen_.show();
        ++times_.frames;
        times_.shown += passed;
        times_.stepping += seconds_between(begin, stepped);
        times_.gathering += seconds_between(stepped, drawn);
        times_.painting += seconds_between(drawn, Clock::now());
    }

    void paint_scene(int height) {
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        glDisable(GL_SCISSOR_TEST); // panes of a split view may leave a column uncovered
        glClear(GL_COLOR_BUFFER_BIT);
        for (std::size_t i = 0; i < pictures_.size() && i < play_.pane_count(); ++i)
            painter_->paint(pictures_[i], area_.left + play_.pane_left(i), height - area_.top - area_.height);
    }

    void paint_panel() {
        ImGui_ImplOpenGL3_NewFrame();
        ImGui_ImplSDL2_NewFrame();
        GuiInput::measure(screen_);
        ImGui::NewFrame();
        panel_.show();
        ImGui::Render();
        ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
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
        const auto before = play_.timeline().now();
        const auto phases = std::make_shared<PhaseTimes>();
        play_.report({.times = phases, .preparing = {}});
        play_.advance(passed, [&] { return seconds_between(begin, Clock::now()) > longest; });
        panel_.measure_steps(seconds_between(begin, Clock::now()), play_.timeline().now() - before, *phases);
    }

    void name_window() {
        const auto title = play_.scene_name() + (play_.is_edited() ? " * - Sinew" : " - Sinew");
        if (title == title_) return;
        title_ = title;
        SDL_SetWindowTitle(screen_.window(), title_.c_str());
    }

    void take(const SDL_Event& event) {
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
        default:
            input_.take(event);
        }
    }
};

} // namespace

std::optional<std::string> show(play::Play& play) {
    return Window(play).run();
}

} // namespace sinew::window
