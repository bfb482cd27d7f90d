#pragma once

#include "apps/play/play.h"
#include "apps/window/browser.h"
#include "apps/window/look.h"
#include "apps/window/statistics.h"

namespace sinew::window {

/// A part of the window, in pixels.
struct Area {
    int left = 0, top = 0, width = 1, height = 1;
};

/// All that is around the scene: tools at the left, time at the bottom, the panel at the right.
class Panel {
  public:
    explicit Panel(play::Play& play) : play_(play), browser_(play) {}

    void dress(double density);
    /// What is left for the scene.
    Area area(int width, int height);
    /// Within an ImGui frame.
    void show();

    /// The context that held them is gone.
    void forget_textures() { browser_.forget_textures(); }
    void measure_frame(double seconds) { statistics_.frame(seconds); }
    void measure_steps(double seconds, std::uint64_t steps, const PhaseTimes& phases) {
        statistics_.steps(seconds, steps, phases);
    }

  private:
    void side();
    void title();
    void problem();
    void help();
    void message();
    bool section(const char* name, bool open);

    play::Play& play_;
    Browser browser_;
    Statistics statistics_;
    Fonts fonts_;
    double density_ = 0;
    int width_ = 0, height_ = 0;
    std::string last_message_;
    double message_since_ = 0;
};

} // namespace sinew::window
