#include "apps/cli/session_file.h"

#include "apps/cli/command.h"
#include "apps/cli/console.h"
#include "apps/cli/scene_file.h"
#include "apps/cli/scrap.h"
#include "player/files.h"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

namespace sinew::cli {
namespace {

namespace fs = std::filesystem;

/// Absolute path of a scene's file; empty for standard input.
std::string absolute_scene_path(const std::string& word) {
    const auto path = scene_path(word);
    std::error_code unknown;
    return path.empty() ? std::string() : fs::absolute(path, unknown).string();
}

SessionFile read_session(const std::string& path) {
    const auto text = read_text(path, std::numeric_limits<std::size_t>::max() - 1);
    SnapshotError error;
    std::string from;
    const auto open = [&](const std::string& scene, const std::string& file) {
        from = file;
        return opener_for(path)(scene, file);
    };
    auto session = session_of(std::as_bytes(std::span(text)), open, error);
    if (!session) refuse(path, error.text());
    return {std::move(*session), from};
}

} // namespace

std::vector<std::byte> head_of(const std::string& path) {
    constexpr std::size_t size = 8;
    std::error_code unknown;
    if (path == "-" || !fs::is_regular_file(path, unknown)) return {};
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
    std::vector<std::byte> head(size);
    head.resize(file ? std::fread(head.data(), 1, size, file.get()) : 0);
    return head;
}

bool is_snapshot_file(const std::string& path) {
    const auto head = head_of(path);
    return is_snapshot(head);
}

SceneOpener opener_for(const std::string& name) {
    return [name](const std::string& scene, const std::string& from) {
        return std::optional(open_text(scene, name + ": scene", fs::path(from).parent_path()));
    };
}

SessionFile open_session(const SceneWords& words) {
    if (!is_snapshot_file(words.scene))
        return {Session(open_file(words.scene, words.overrides)), absolute_scene_path(words.scene)};
    if (!words.overrides.empty())
        usage_error("key=value is for scenes: a snapshot goes on as it was saved", "change the scene, and run it anew");
    return read_session(words.scene);
}

void save_session(const Session& session, const std::string& from, const fs::path& to) {
    const auto bytes = save(session, from);
    const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    settle(play::write_file(to, text));
}

} // namespace sinew::cli
