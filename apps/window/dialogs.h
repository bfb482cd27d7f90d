#pragma once

#include "apps/play/play.h"
#include "apps/window/look.h"

#include <array>
#include <string>

namespace sinew::window {

/// What lies over the scene until it is answered: questions, paths, problems, settings, the keys.
class Dialogs {
  public:
    explicit Dialogs(play::Play& play) : play_(play) {}

    /// Within an ImGui frame; the window's size in pixels.
    void show(const Look& look, const Fonts& fonts, float scale, int width, int height);

    double text_size = 1; ///< of all letters and bars; 1 is usual
    /// A key that was pressed while one was to be chosen is taken.
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
    void progress();

    play::Play& play_;
    const Look* look_ = nullptr;
    const Fonts* fonts_ = nullptr;
    float scale_ = 1, width_ = 0, height_ = 0;
    const char* open_ = nullptr;             ///< the modal that was shown last
    std::array<char, 1024> typed_{};         ///< a path
    bool typing_ = false;                    ///< typed_ is that of the present request
    std::string rebinding_, rebind_problem_; ///< the action whose key is chosen
};

} // namespace sinew::window
