#pragma once

#include "sinew/session/session.h"

#include <filesystem>
#include <optional>
#include <string>

namespace sinew::cli {

/// A session and the word that the user called it by.
struct Compared {
    const Session& session;
    std::string label;
};

/// Draws two sessions beside each other into a file, with a ring around the particle of a row in both. Throws
/// CommandError.
void draw_difference(const std::filesystem::path& path, const Compared& first, const Compared& second,
                     std::optional<Row> row);

} // namespace sinew::cli
