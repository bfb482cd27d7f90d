#pragma once

#include "apps/window/arrangement.h"
#include "apps/window/browser.h"
#include "apps/window/dialogs.h"
#include "apps/window/look.h"
#include "apps/window/statistics.h"
#include "player/play.h"

namespace sinew::window {

/// Everything around the scene: menu at the top, tools at the left, time at the bottom, panel at the right.
class Panel {
  public:
    explicit Panel(play::Play& play) : play_(play), browser_(play), dialogs_(play) {}

    /// Lays out a window; width and height in pixels.
    void arrange(int width, int height, double density);
    const Area& scene() const { return layout_.scene; }
    /// True if a window pixel belongs to the scene, with nothing open over the scene.
    bool leaves_to_scene(double x, double y) const;
    /// Draws within an ImGui frame.
    void show();
    /// True if the panel has consumed the key, so that the game must ignore it.
    bool take_key(const std::string& key);

    double text_size() const { return dialogs_.text_size; }
    void set_text_size(double size) { dialogs_.text_size = size; }

    /// Drops textures and fonts whose OpenGL context is gone.
    void forget_textures() { browser_.forget_textures(); }
    void forget_fonts() { dressed_scale_ = 0; }
    void measure_frame(double seconds) { statistics_.frame(seconds); }
    void measure_steps(double seconds, std::uint64_t steps, const PhaseTimes& phases) {
        statistics_.steps(seconds, steps, phases);
    }

  private:
    const Look& look() const { return look_called(play_.shown_theme()); }
    void menu();
    void side();
    void title();
    void message();
    void tour();
    void write_over_scene(const std::string& text, float share, float alpha);
    bool section(const char* name, const char* help, bool open);

    play::Play& play_;
    Browser browser_;
    Statistics statistics_;
    Dialogs dialogs_;
    Fonts fonts_;
    Arrangement layout_;
    float scale_ = 1;          ///< pixels per nominal pixel of the bars
    double dressed_scale_ = 0; ///< scale for which the fonts were made
    int width_ = 0, height_ = 0;
    bool drawer_ = false;     ///< the panel is shown although not docked
    bool popup_open_ = false; ///< a menu, a list or a question is open
    bool close_menus_ = false;
    std::string last_message_;
    double message_since_ = 0;
};

} // namespace sinew::window
