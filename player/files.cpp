#include "player/files.h"

#include "canvas/partial_file.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <memory>
#include <sstream>
#include <utility>
#include <vector>

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

std::function<canvas::Failure(std::span<const std::byte>)> append_to(const fs::path& path) {
    const auto name = path.string();
    const auto refused = [name](const std::string& reason) {
        return [failure = canvas::Failure("cannot write " + name + ": " + reason)](std::span<const std::byte>) {
            return failure;
        };
    };
    if (const auto failure = canvas::prepare_folder_of(path)) return refused(*failure);
    const std::shared_ptr<std::FILE> file(std::fopen(name.c_str(), "wb"), [](std::FILE* held) {
        if (held) std::fclose(held);
    });
    if (!file) return refused(std::strerror(errno));
    return [file, refused](std::span<const std::byte> bytes) -> canvas::Failure {
        const bool is_written =
            std::fwrite(bytes.data(), 1, bytes.size(), file.get()) == bytes.size() && std::fflush(file.get()) == 0;
        if (is_written) return std::nullopt;
        return refused(std::strerror(errno))(bytes);
    };
}

fs::path new_file_in(const fs::path& folder, const std::string& stem, const std::string& extension, std::size_t kept) {
    std::error_code failed;
    fs::create_directories(folder, failed);
    if (failed) return {};
    std::vector<std::pair<fs::file_time_type, fs::path>> old;
    for (const auto& entry : fs::directory_iterator(folder, failed))
        if (entry.path().extension() == extension) old.emplace_back(time_written(entry.path()), entry.path());
    std::sort(old.begin(), old.end());
    for (std::size_t i = 0; i + kept < old.size(); ++i) remove_file(old[i].second);
    return free_path(folder / (stem + extension));
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
