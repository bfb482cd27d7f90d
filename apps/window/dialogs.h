#pragma once

#include "apps/window/look.h"
#include "player/play.h"

#include <array>
#include <string>

namespace sinew::window {

/// Dialogs over the scene: questions, path requests, problems, settings, the help.
class Dialogs {
  public:
    explicit Dialogs(play::Play& play) : play_(play) {}

    /// Shows the open dialog within an ImGui frame; size of the window in pixels.
    void show(const Look& look, const Fonts& fonts, float scale, int width, int height);

    double text_size = 1; ///< factor for all letters and bars, 1 by default
    bool is_open() const { return open_ != nullptr; }
    /// Consumes the key if a binding is being chosen; otherwise returns false.
    bool take_key(const std::string& key);

  private:
    bool begin(const char* title, float nominal_width);
    void end();
    void question();
    void path();
    void folder(const std::string& ending);
    void go_into(const std::string& name);
    void problem();
    void settings();
    void key_rows();
    void key_row(std::string_view name, std::string_view about);
    void help();
    void dim() const;
    void progress();

    play::Play& play_;
    const Look* look_ = nullptr;
    const Fonts* fonts_ = nullptr;
    float scale_ = 1, width_ = 0, height_ = 0;
    const char* open_ = nullptr;             ///< title of the modal shown last; null if none
    std::array<char, 1024> typed_{};         ///< the typed path
    bool typing_ = false;                    ///< typed_ belongs to the current request
    std::string rebinding_, rebind_problem_; ///< action whose key is being chosen; why the last choice failed
};

} // namespace sinew::window
