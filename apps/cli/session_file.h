#pragma once

#include "sinew/session/session_snapshot.h"

#include "apps/cli/arguments.h"

#include <filesystem>
#include <string>
#include <vector>

namespace sinew::cli {

/// A session, and the file of its scene, to which the paths of images and models are relative; empty for standard
/// input.
struct SessionFile {
    Session session;
    std::string from{};
};

/// The session of a scene at its start, or of a snapshot where it was saved: a file that `sinew run --save` wrote.
/// Throws CommandError.
SessionFile open_session(const SceneWords& words);

/// Builds the scene of a file `name` that is no scene file: a snapshot or a recording. Throws CommandError.
SceneOpener opener_for(const std::string& name);

/// The first bytes of a regular file; fewer where the file has fewer, or is none.
std::vector<std::byte> head_of(const std::string& path);
/// True for a file that begins like a snapshot.
bool is_snapshot_file(const std::string& path);
/// Writes a snapshot of a session of the scene in the file `from`. The file appears complete, or not at all. Throws
/// CommandError.
void save_session(const Session& session, const std::string& from, const std::filesystem::path& to);

} // namespace sinew::cli
