#pragma once

#include "bindings/c/reading.h"
#include "bindings/c/simulation.h"
#include "player/play.h"
#include "player/touch.h"

#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::c {

/// True for actions of a player that concern its scene; files, panels and windows are the host's.
bool is_of_scene(std::string_view action);

/// A player, the scene it shows, and what was handed out.
struct Player {
    explicit Player(SceneFile file);
    Player(const Player&) = delete;
    Player& operator=(const Player&) = delete;
    ~Player();

    /// Opens another scene with the settings kept; false leaves the old one.
    bool open(SceneFile file);

    /// Handle of the pane's simulation, 0 if there are too many.
    std::uint32_t simulation_of(std::size_t pane);

    std::shared_ptr<const SceneFile> file;
    std::unique_ptr<play::Play> play;
    std::unique_ptr<play::Touch> touch;
    std::vector<std::uint32_t> simulations{}; ///< handles by pane
    Drawn drawn{};
    std::vector<Picture> panes{}; ///< of a split view, as drawn last
    std::deque<std::string> events{};
    std::string event{};
    std::array<std::string, 7> texts{}; ///< of the last state handed out
    bool is_busy = false;               ///< it advances: a callback of the caller's may be running
};

Handles<Player>& players();

} // namespace sinew::c
