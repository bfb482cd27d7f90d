#pragma once

#include "apps/window/look.h"
#include "apps/window/thumbnails.h"
#include "player/play.h"

#include <array>

namespace sinew::window {

/// The catalogue: a search field, and a thumbnail of every scene.
class Browser {
  public:
    explicit Browser(play::Play& play) : play_(play), thumbnails_(play.library()) {}
    void show(const Look& look, const Fonts& fonts, float scale);

    void forget_textures() { thumbnails_.forget(); }

  private:
    void card(const std::string& name, float width, const Look& look, const Fonts& fonts);

    play::Play& play_;
    Thumbnails thumbnails_;
    std::array<char, 64> search_{};
};

} // namespace sinew::window
