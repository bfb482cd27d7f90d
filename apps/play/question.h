#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

/// What a game asks its player: a choice between answers, or a path.
namespace sinew::play {

struct Answer {
    std::string name;  ///< one word, as scripts say it: "save"
    std::string label; ///< on a button
    std::function<void()> act;
};

struct Question {
    std::string title, text;
    std::vector<Answer> answers; ///< the last changes nothing; Escape chooses it
};

enum class Purpose { open, save, save_state, picture, film };

/// Asks for the path of a file.
struct PathRequest {
    Purpose purpose{};
    std::filesystem::path suggested;
    std::function<void()> then; ///< what was meant to be done once the file is written; may be empty
};

} // namespace sinew::play
