#pragma once

#include "sinew/scene/document.h"
#include "sinew/scene/units.h"

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace sinew::cli {

class Command;

/// Sets the members of a command from its arguments, its name not among them. Whether it is to be run: not so where
/// help was asked for.
bool parse(Command& command, std::span<const std::string> arguments);

/// The options of a command and what they do, a row each.
std::vector<std::vector<std::string>> option_rows(Command& command);

/// What a command line says beside its options.
struct Words {
    std::vector<std::string> plain;  ///< scenes, names
    std::vector<Override> overrides; ///< key=value
};
struct SceneWords {
    std::string scene;
    std::vector<Override> overrides;
};

/// Any number of words, sorted into those that look like key=value and others.
void declare_words(CLI::App& parser, Words& target);
/// The same, where exactly one of the others is the scene: anything else is wrong usage.
void declare_scene(CLI::App& parser, SceneWords& target);

/// An option that is there or not.
void declare_flag(CLI::App& parser, const std::string& names, bool& target, const std::string& help);
/// An option that takes any text but an empty one.
void declare_text(CLI::App& parser, const std::string& names, std::string& target, const std::string& placeholder,
                  const std::string& help);
/// An option that takes a number in a range.
void declare_number(CLI::App& parser, const std::string& names, std::optional<double>& target, Range range,
                    const std::string& placeholder, const std::string& help);
/// An option that takes a whole number in a range.
void declare_whole(CLI::App& parser, const std::string& names, std::optional<int>& target, Range range,
                   const std::string& placeholder, const std::string& help);
/// An option that takes two whole numbers: 640x480.
void declare_pair(CLI::App& parser, const std::string& names, std::optional<std::array<int, 2>>& target,
                  const std::string& placeholder, const std::string& help);

/// How long a scene can be run at once, in seconds: thirty years.
inline constexpr Range possible_seconds{0, 1e9};

} // namespace sinew::cli
