#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sinew::play {

class Play;

struct KeyAction {
    std::string_view name; ///< one word, as settings say it
    std::string_view key;  ///< unless the player chose another
    std::string_view about;
    void (*act)(Play&);
};

/// What keys do, beside choosing tools, in the order of the help. A new one is a line in keys.cpp.
std::span<const KeyAction> key_actions();

/// Which key does what: as actions and tools say, or as the player chose.
class Keys {
  public:
    /// By the name of an action or a tool.
    std::string of(std::string_view name) const;
    /// The action or tool that a key stands for; empty where it is none.
    std::string action_of(std::string_view key) const;
    /// Chooses a key; the name of the action that has it already is returned, and nothing is changed.
    std::string choose(std::string_view name, std::string_view key);
    void reset() { chosen.clear(); }

    std::vector<std::pair<std::string, std::string>> chosen; ///< keys by name, that are not as usual
};

void press_key(Play& play, std::string_view key);

} // namespace sinew::play
