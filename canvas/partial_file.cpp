#include "canvas/partial_file.h"

#include "canvas/interrupt.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <system_error>
#include <unistd.h>

namespace sinew::canvas {
namespace {

namespace fs = std::filesystem;

/// Leaves room for the decoration within the 255 bytes that file systems allow a name.
constexpr std::size_t longest_stem = 200;

/// Where the file really lies: a link stays a link, and the file it points to is replaced.
fs::path behind_links(const fs::path& path) {
    std::error_code ignored;
    const fs::path real = fs::is_symlink(path, ignored) ? fs::canonical(path, ignored) : path;
    return real.empty() ? path : real;
}

fs::path folder_of(const fs::path& path) {
    return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

Failure create_folder(const fs::path& folder) {
    std::error_code error, ignored;
    fs::create_directories(folder, error);
    if (fs::is_directory(folder, ignored)) return {};
    if (!error || error == std::errc::file_exists || error == std::errc::not_a_directory)
        return folder.string() + " is not a folder";
    return "the folder " + folder.string() + " cannot be created: " + error.message();
}

Failure check_replaceable(const fs::path& target) {
    std::error_code ignored;
    const fs::file_status status = fs::status(target, ignored);
    if (!fs::exists(status)) return {};
    if (fs::is_directory(status)) return "it is a folder";
    if (!fs::is_regular_file(status)) return "it is not a regular file";
    if (access(target.c_str(), W_OK) != 0) return std::strerror(errno);
    return {};
}

fs::path partial_name(const fs::path& target, std::string_view scratch) {
    const std::string stem = target.stem().string().substr(0, longest_stem);
    const std::string ending = target.extension().string() + std::string(scratch);
    return folder_of(target) / ("." + stem + ".partial-" + std::to_string(getpid()) + ending);
}

} // namespace

Failure PartialFile::create(const fs::path& wanted, std::string_view scratch) {
    target = behind_links(wanted);
    if (auto failure = check_replaceable(target)) return failure;
    if (auto failure = create_folder(folder_of(target))) return failure;
    const fs::path name = partial_name(target, scratch);
    const int file = ::open(name.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (file < 0) return "the folder " + folder_of(target).string() + " takes no file: " + std::strerror(errno);
    ::close(file);
    partial = name;
    doom(partial.c_str());
    return {};
}

Failure PartialFile::commit() {
    if (std::rename(partial.c_str(), target.c_str()) != 0) return std::strerror(errno);
    spare(partial.c_str());
    partial.clear();
    return {};
}

void PartialFile::discard() {
    if (partial.empty()) return;
    unlink(partial.c_str());
    spare(partial.c_str());
    partial.clear();
}

} // namespace sinew::canvas
