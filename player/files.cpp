#include "player/files.h"

#include "canvas/partial_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <sstream>

namespace sinew::play {

namespace fs = std::filesystem;

fs::file_time_type time_written(const fs::path& path) {
    std::error_code unknown;
    const auto time = path.empty() ? fs::file_time_type{} : fs::last_write_time(path, unknown);
    return unknown ? fs::file_time_type{} : time;
}

canvas::Failure write_file(const fs::path& path, const std::string& text) {
    const auto explained = [&](const canvas::Failure& reason) {
        return reason ? canvas::Failure("cannot write " + path.string() + ": " + *reason) : std::nullopt;
    };
    canvas::PartialFile partial;
    if (auto failure = partial.create(path)) return explained(failure);
    auto* file = std::fopen(partial.path().c_str(), "wb");
    if (!file) return explained(std::strerror(errno));
    const bool whole = std::fwrite(text.data(), 1, text.size(), file) == text.size();
    const int reason = errno;
    if (std::fclose(file) != 0 || !whole) return explained(std::strerror(whole ? errno : reason));
    return explained(partial.commit());
}

void remove_file(const fs::path& path) {
    std::error_code unknown;
    fs::remove(path, unknown);
}

fs::path free_path(const fs::path& wanted) {
    auto path = wanted;
    std::error_code unknown;
    for (int number = 2; fs::exists(path, unknown); ++number) {
        path = wanted;
        path.replace_filename(wanted.stem().string() + "-" + std::to_string(number) + wanted.extension().string());
    }
    return path;
}

std::optional<std::string> read_file(const fs::path& path, std::size_t max) {
    std::error_code unknown;
    if (!fs::is_regular_file(path, unknown) || fs::file_size(path, unknown) > max) return std::nullopt;
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return file ? std::optional(text.str()) : std::nullopt;
}

std::string full_path(const fs::path& path) {
    std::error_code unknown;
    auto full = fs::absolute(path, unknown);
    return (unknown ? path : full).lexically_normal().string();
}

} // namespace sinew::play
