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

/// Sets the members of a command from the arguments after the command's name. Returns false if help was requested, and
/// the command is not to be run. Throws CommandError on wrong usage.
bool parse(Command& command, std::span<const std::string> arguments);

/// Table of a command's options: a row with name and description each.
std::vector<std::vector<std::string>> option_rows(Command& command);

/// Words of a command line that are not options.
struct Words {
    std::vector<std::string> plain;  ///< scenes, names
    std::vector<Override> overrides; ///< key=value
};
struct SceneWords {
    std::string scene;
    std::vector<Override> overrides;
};

/// Accepts any number of words, sorted into key=value and others.
void declare_words(CLI::App& parser, Words& target);
/// As declare_words, with exactly one other word, the scene; anything else is wrong usage.
void declare_scene(CLI::App& parser, SceneWords& target);

/// Declares an option without a value.
void declare_flag(CLI::App& parser, const std::string& names, bool& target, const std::string& help);
/// Declares an option with any text but an empty one as the value.
void declare_text(CLI::App& parser, const std::string& names, std::string& target, const std::string& placeholder,
                  const std::string& help);
/// Declares an option with a number in a range as the value.
void declare_number(CLI::App& parser, const std::string& names, std::optional<double>& target, Range range,
                    const std::string& placeholder, const std::string& help);
/// Declares an option with a whole number in a range as the value.
void declare_whole(CLI::App& parser, const std::string& names, std::optional<int>& target, Range range,
                   const std::string& placeholder, const std::string& help);
/// Declares an option with two whole numbers as the value: 640x480.
void declare_pair(CLI::App& parser, const std::string& names, std::optional<std::array<int, 2>>& target,
                  const std::string& placeholder, const std::string& help);

/// Length of a run, seconds: up to thirty years.
inline constexpr Range possible_seconds{0, 1e9};

} // namespace sinew::cli
