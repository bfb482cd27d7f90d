#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sinew::play {

class Play;

struct KeyAction {
    std::string_view name; ///< a word, as in settings
    std::string_view key;  ///< default key
    std::string_view about;
    void (*act)(Play&);
};

/// Actions with a key, apart from tools, in the order of the help. A new action is a line in keys.cpp.
std::span<const KeyAction> key_actions();

/// Key bindings: the defaults of actions and tools, and the player's changes.
class Keys {
  public:
    /// Key of an action or tool, by name.
    std::string of(std::string_view name) const;
    /// Name of the action or tool bound to a key; empty if none.
    std::string action_of(std::string_view key) const;
    /// Binds a key. If another action has the key already, nothing changes and that action's name is returned.
    std::string choose(std::string_view name, std::string_view key);
    void reset() { chosen.clear(); }

    std::vector<std::pair<std::string, std::string>> chosen; ///< changed bindings: name, key
};

void press_key(Play& play, std::string_view key);

} // namespace sinew::play
