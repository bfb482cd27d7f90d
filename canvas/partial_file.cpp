#include "canvas/partial_file.h"

#include "canvas/interrupt.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <sys/file.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace sinew::canvas {
namespace {

namespace fs = std::filesystem;

/// Bytes: leaves room for the decoration within the 255 bytes a file name may have.
constexpr std::size_t longest_stem = 200;

/// Target of a symbolic link: the link stays, and the file behind the link is replaced.
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

/// Separator between the file's name and the writing process's id.
constexpr std::string_view decoration = ".partial-";

fs::path partial_name(const fs::path& target, std::string_view scratch) {
    const std::string stem = target.stem().string().substr(0, longest_stem);
    const std::string ending = target.extension().string() + std::string(scratch);
    return folder_of(target) / ("." + stem + std::string(decoration) + std::to_string(getpid()) + ending);
}

/// Id of the process writing a partial file, from the file's name; 0 for any other name.
pid_t writer_of(std::string_view name) {
    const auto at = name.rfind(decoration);
    if (!name.starts_with('.') || at == std::string_view::npos) return 0;
    const auto digits = name.substr(at + decoration.size());
    pid_t process = 0;
    const auto [end, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), process);
    const bool ended = end == digits.data() + digits.size() || *end == '.';
    return problem == std::errc() && ended && process > 0 ? process : 0;
}

bool is_gone(pid_t process) {
    return kill(process, 0) != 0 && errno == ESRCH;
}

/// True if no process holds the lock. A process of another container holds the lock although the process id is unknown
/// here.
bool is_abandoned(const fs::path& path) {
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (file < 0) return false;
    const bool abandoned = flock(file, LOCK_EX | LOCK_NB) == 0;
    ::close(file);
    return abandoned;
}

/// Removes partial files of killed processes from a folder; failures are ignored.
void sweep(const fs::path& folder) {
    std::error_code ignored;
    for (fs::directory_iterator entry(folder, ignored), end; !ignored && entry != end; entry.increment(ignored)) {
        const auto process = writer_of(entry->path().filename().native());
        std::error_code unknown;
        if (process == 0 || !is_gone(process) || !fs::is_regular_file(entry->symlink_status(unknown))) continue;
        if (is_abandoned(entry->path())) fs::remove(entry->path(), unknown);
    }
}

} // namespace

Failure prepare_folder_of(const fs::path& target) {
    if (auto failure = check_replaceable(target)) return failure;
    if (auto failure = create_folder(folder_of(target))) return failure;
    sweep(folder_of(target));
    return {};
}

Failure PartialFile::create(const fs::path& wanted, std::string_view scratch) {
    target = behind_links(wanted);
    if (auto failure = prepare_folder_of(target)) return failure;
    const fs::path name = partial_name(target, scratch);
    const int file = ::open(name.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (file < 0) return "the folder " + folder_of(target).string() + " takes no file: " + std::strerror(errno);
    flock(file, LOCK_EX | LOCK_NB); // held until the descriptor is closed, also by a kill
    held = file;
    partial = name;
    doom(partial.c_str());
    return {};
}

Failure PartialFile::commit() {
    if (std::rename(partial.c_str(), target.c_str()) != 0) return std::strerror(errno);
    let_go();
    return {};
}

void PartialFile::discard() {
    if (partial.empty()) return;
    unlink(partial.c_str());
    let_go();
}

void PartialFile::let_go() {
    spare(partial.c_str());
    partial.clear();
    ::close(std::exchange(held, -1));
}

std::string reason_told(const std::string& reason, const std::string& called) {
    for (const int full : {ENOSPC, EDQUOT, EFBIG})
        if (reason.find(std::strerror(full)) != std::string::npos) return std::strerror(full);
    constexpr std::string_view around = " \t\n'\":,()[]"; // delimiters before and behind a file name
    std::string told;
    for (std::size_t begin = 0; begin < reason.size();) {
        const auto end = std::min(std::min(reason.find_first_of(around, begin), reason.size() - 1) + 1, reason.size());
        const auto word = std::string_view(reason).substr(begin, end - begin);
        const bool partial = word.find(decoration) != std::string_view::npos;
        const bool mark = around.find(word.back()) != std::string_view::npos;
        told += partial ? called : std::string(word.substr(0, word.size() - mark));
        if (mark) told += word.back();
        begin = end;
    }
    return told;
}

} // namespace sinew::canvas
