#include "canvas/ffmpeg.h"

#include "canvas/interrupt.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

namespace sinew::canvas {
namespace {

/// Number of ffmpeg's last lines quoted in a message. The first error is usually the cause, and rarely far up.
constexpr std::size_t quoted_lines = 6;

void close_and_forget(int& descriptor) {
    if (descriptor >= 0) close(descriptor);
    descriptor = -1;
}

/// Moves a descriptor above 2. In a process started with a standard stream closed, new descriptors take numbers up to
/// 2, and wiring up the child would overwrite them.
int above_standard_streams(int descriptor) {
    if (descriptor < 0 || descriptor > STDERR_FILENO) return descriptor;
    const int moved = fcntl(descriptor, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    close(descriptor);
    return moved;
}

std::string describe_end(int status) {
    if (WIFSIGNALED(status)) return std::string("ended by a signal: ") + strsignal(WTERMSIG(status));
    return "exit code " + std::to_string(WEXITSTATUS(status));
}

/// The last lines of a text, each indented.
std::string tail(const std::string& text) {
    std::vector<std::string> lines;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        if (end > begin) lines.push_back("\n    " + text.substr(begin, end - begin));
        begin = end + 1;
    }
    std::string result;
    for (std::size_t i = lines.size() - std::min(lines.size(), quoted_lines); i < lines.size(); ++i) result += lines[i];
    return result;
}

/// Attributes of a child process: the three standard streams, default signal handlers, a process group of its own.
class SpawnPlan {
  public:
    SpawnPlan(int input, int errors) {
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
        posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
        posix_spawn_file_actions_adddup2(&actions, errors, STDERR_FILENO);
        posix_spawn_file_actions_addclosefrom_np(&actions, STDERR_FILENO + 1);

        sigset_t every, none;
        sigfillset(&every);
        sigemptyset(&none);
        posix_spawnattr_init(&attributes);
        posix_spawnattr_setsigdefault(&attributes, &every);
        posix_spawnattr_setsigmask(&attributes, &none);
        posix_spawnattr_setpgroup(&attributes, 0);
        posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
    }
    SpawnPlan(const SpawnPlan&) = delete;
    SpawnPlan& operator=(const SpawnPlan&) = delete;
    ~SpawnPlan() {
        posix_spawn_file_actions_destroy(&actions);
        posix_spawnattr_destroy(&attributes);
    }

    int run(pid_t& child, std::vector<char*>& arguments) const {
        return posix_spawnp(&child, arguments[0], &actions, &attributes, arguments.data(), environ);
    }

  private:
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
};

} // namespace

Failure Ffmpeg::start(const std::vector<std::string>& arguments, const std::string& purpose) {
    abandon();
    // A socket rather than a pipe: MSG_NOSIGNAL suppresses SIGPIPE after the reader has gone.
    int ends[2] = {-1, -1};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
        return std::string("ffmpeg cannot be started: ") + std::strerror(errno);
    socket = above_standard_streams(ends[0]);
    int input = above_standard_streams(ends[1]);
    words = above_standard_streams(memfd_create("ffmpeg", MFD_CLOEXEC));
    Failure failure = spawn(arguments, purpose, input);
    close_and_forget(input);
    if (failure) abandon();
    return failure;
}

Failure Ffmpeg::spawn(const std::vector<std::string>& arguments, const std::string& purpose, int input) {
    std::vector<std::string> texts{"ffmpeg", "-nostdin", "-hide_banner", "-loglevel", "error", "-xerror", "-y"};
    texts.insert(texts.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    for (std::string& text : texts) pointers.push_back(text.data());
    pointers.push_back(nullptr);

    pid_t started = 0;
    const int error = SpawnPlan(input, words).run(started, pointers);
    if (error == ENOENT)
        return "ffmpeg is needed for " + purpose +
               "; install it with: apt-get install ffmpeg (.png, .svg and .pdf need nothing)";
    if (error != 0) return std::string("ffmpeg cannot be started: ") + std::strerror(error);
    child = started;
    doom(child);
    return {};
}

Failure Ffmpeg::send(std::span<const std::byte> bytes) {
    while (!bytes.empty() && !interrupted()) {
        const ssize_t sent = ::send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (sent > 0)
            bytes = bytes.subspan(std::size_t(sent));
        else if (sent < 0 && errno != EINTR) {
            const int status = reap();
            return "ffmpeg stopped before the end (" + describe_end(status) + ")" + last_words();
        }
    }
    return {};
}

Failure Ffmpeg::finish() {
    const int status = reap();
    if (status == 0 || interrupted()) return {};
    return "ffmpeg failed (" + describe_end(status) + ")" + last_words();
}

void Ffmpeg::abandon() {
    if (running()) kill(-child, SIGKILL);
    reap();
    close_and_forget(words);
}

/// Closes the input, waits for the child to end, and returns the exit status. An interruption kills the child.
int Ffmpeg::reap() {
    close_and_forget(socket);
    if (!running()) return 0;
    // WNOWAIT: the process id is not reused before spare() removes the child from the kill list of the second signal.
    if (interrupted()) kill(-child, SIGKILL);
    siginfo_t ignored;
    while (waitid(P_PID, id_t(child), &ignored, WEXITED | WNOWAIT) != 0 && errno == EINTR)
        if (interrupted()) kill(-child, SIGKILL);
    spare(child);
    int status = 0;
    waitpid(std::exchange(child, 0), &status, 0);
    return status;
}

/// The last lines of the child's standard error.
std::string Ffmpeg::last_words() const {
    std::string text(8192, '\0');
    const off_t length = lseek(words, 0, SEEK_END);
    const ssize_t got = pread(words, text.data(), text.size(), std::max<off_t>(0, length - off_t(text.size())));
    text.resize(std::size_t(std::max<ssize_t>(got, 0)));
    return tail(text);
}

} // namespace sinew::canvas
