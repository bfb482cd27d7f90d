#pragma once

#include "apps/play/play.h"
#include "apps/window/browser.h"
#include "apps/window/dialogs.h"
#include "apps/window/layout.h"
#include "apps/window/look.h"
#include "apps/window/statistics.h"

namespace sinew::window {

/// All that is around the scene: the menu at the top, tools at the left, time at the bottom, the panel at the right.
class Panel {
  public:
    explicit Panel(play::Play& play) : play_(play), browser_(play), dialogs_(play) {}

    /// Works out where everything is in a window of that size, in pixels.
    void arrange(int width, int height, double density);
    const Area& scene() const { return layout_.scene; }
    /// Whether a pointer there (pixels of the window) is over the scene and nothing lies over it.
    bool leaves_to_scene(double x, double y) const;
    /// Within an ImGui frame.
    void show();
    bool take_key(const std::string& key) { return dialogs_.take_key(key); }

    double text_size() const { return dialogs_.text_size; }
    void set_text_size(double size) { dialogs_.text_size = size; }

    /// The context that held them is gone.
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
    void hint();
    void write_over_scene(const std::string& text, float share, float alpha);
    bool section(const char* name, bool open);

    play::Play& play_;
    Browser browser_;
    Statistics statistics_;
    Dialogs dialogs_;
    Fonts fonts_;
    Layout layout_;
    float scale_ = 1;          ///< pixels a nominal pixel of bars has
    double dressed_scale_ = 0; ///< for which fonts were made
    int width_ = 0, height_ = 0;
    bool drawer_ = false;     ///< a panel that is not docked is shown
    bool popup_open_ = false; ///< a menu, a list or a question lies over the scene
    std::string last_message_;
    double message_since_ = 0;
};

} // namespace sinew::window
