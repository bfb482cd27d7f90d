#pragma once

#include "player/play.h"

#include <memory>
#include <string_view>
#include <vector>

namespace sinew::play {

/// A tool of the pointer. Tools live as long as the Play; a tool is busy between press and release.
class Tool {
  public:
    virtual ~Tool() = default;
    virtual std::string_view name() const = 0;
    virtual std::string_view key() const = 0;
    virtual std::string_view about() const = 0; ///< a line beginning with a verb
    virtual void press(Play& play) = 0;
    virtual void move(Play&) {}
    virtual void release(Play&) {}
    /// Draws over the scene, while the tool is busy.
    virtual void draw(const Play&, Picture&) const {}
    /// Draws over the scene as long as the tool is the chosen one.
    virtual void draw_idle(const Play&, Picture&) const {}
};

/// The list of tools, in the order of the toolbar. A new tool is a file with a factory function, and a word
/// here.
#define SINEW_TOOLS(X)                                                                                                 \
    X(grab)                                                                                                            \
    X(select) X(pin) X(cut) X(join) X(rope) X(polygon) X(cloth) X(spawn) X(wall) X(terrain) X(remove) X(measure)

namespace tool {
#define SINEW_DECLARE(name) std::unique_ptr<Tool> name();
SINEW_TOOLS(SINEW_DECLARE)
#undef SINEW_DECLARE
} // namespace tool

std::vector<std::unique_ptr<Tool>> all_tools();

} // namespace sinew::play
