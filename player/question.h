#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

/// Questions to the player: a choice between answers, or a path.
namespace sinew::play {

struct Answer {
    std::string name;  ///< a word for scripts: "save"
    std::string label; ///< text of the button
    std::function<void()> act;
};

struct Question {
    std::string title, text;
    std::vector<Answer> answers; ///< the last changes nothing and is chosen by Escape
};

enum class Purpose { open, save, save_state, picture, film };

/// A request for the path of a file.
struct PathRequest {
    Purpose purpose{};
    std::filesystem::path suggested;
    std::function<void()> then; ///< continuation after the file is written; may be empty
};

} // namespace sinew::play
