#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace sinew::files {

/// Kind of figure or collider that an imported shape or mesh becomes.
enum class Role { solid, jelly, cloth, rope, collider, none };

struct RoleWord {
    std::string_view word;
    Role role;
    std::string_view about;
};

/// Words in ids, classes, layers and names that give a role; the first word of a role is also a value of --as.
inline constexpr std::array role_words = {
    RoleWord{"solid", Role::solid, "a stiff figure"},
    RoleWord{"crate", Role::solid, "the same"},
    RoleWord{"rigid", Role::solid, "the same"},
    RoleWord{"jelly", Role::jelly, "a soft figure"},
    RoleWord{"soft", Role::jelly, "the same"},
    RoleWord{"cloth", Role::cloth, "a cloth held by its highest points"},
    RoleWord{"flag", Role::cloth, "the same"},
    RoleWord{"rope", Role::rope, "a rope held by its first point"},
    RoleWord{"collider", Role::collider, "an obstacle that nothing moves"},
    RoleWord{"ground", Role::collider, "the same"},
    RoleWord{"floor", Role::collider, "the same"},
    RoleWord{"wall", Role::collider, "the same"},
    RoleWord{"static", Role::collider, "the same"},
    RoleWord{"terrain", Role::collider, "the same"},
    RoleWord{"ignore", Role::none, "left out"},
    RoleWord{"background", Role::none, "the same"},
};

/// Role named by a word of a text, which end at anything but a letter: "rope_3", "left-rope", "cloth big". Case is
/// ignored.
std::optional<Role> role_in(std::string_view text);
/// Role called exactly so.
std::optional<Role> role_called(std::string_view word);

} // namespace sinew::files
