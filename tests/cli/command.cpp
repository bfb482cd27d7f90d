#include "tests/cli/command.h"

#include "tests/paths.h"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <stdexcept>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace sinew::cli_test {
namespace {

double in_seconds(const timeval& time) {
    return double(time.tv_sec) + 1e-6 * double(time.tv_usec);
}

int checked(int result) {
    if (result < 0) throw std::runtime_error("a system call of the test failed");
    return result;
}

/// A file without a name that holds the text.
int file_of(const std::string& text) {
    const int file = checked(memfd_create("test", MFD_CLOEXEC));
    if (::write(file, text.data(), text.size()) != ssize_t(text.size())) checked(-1);
    lseek(file, 0, SEEK_SET);
    return file;
}

std::string read_all(int file) {
    std::string text(std::size_t(lseek(file, 0, SEEK_END)), '\0');
    if (pread(file, text.data(), text.size(), 0) != ssize_t(text.size())) checked(-1);
    close(file);
    return text;
}

int pipe_without_reader() {
    int ends[2];
    checked(pipe2(ends, O_CLOEXEC));
    close(ends[0]);
    return ends[1];
}

int output_of(const Setting& setting) {
    if (setting.reader_leaves) return pipe_without_reader();
    return setting.output.empty() ? file_of("") : checked(::open(setting.output.c_str(), O_RDWR | O_CLOEXEC));
}

int new_terminal() {
    const int terminal = checked(posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC));
    checked(grantpt(terminal));
    checked(unlockpt(terminal));
    return terminal;
}

void set_environment(const Setting& setting) {
    unsetenv("NO_COLOR");
    setenv("TERM", "xterm", 1);
    setenv("SINEW_SCENES", catalogue().c_str(), 1);
    for (const auto& [name, value] : setting.environment)
        value.empty() ? unsetenv(name.c_str()) : setenv(name.c_str(), value.c_str(), 1);
}

[[noreturn]] void become(const Arguments& arguments, const Setting& setting) {
    set_environment(setting);
    for (const int signal : {SIGPIPE, SIGINT}) std::signal(signal, SIG_DFL); // a shell's background job has no SIGINT
    if (!setting.folder.empty() && chdir(setting.folder.c_str()) != 0) _exit(126);
    if (setting.max_memory > 0 && !sanitized) {
        const rlimit limit{setting.max_memory, setting.max_memory};
        setrlimit(RLIMIT_AS, &limit);
    }
    if (setting.largest_file > 0) {
        const rlimit limit{setting.largest_file, setting.largest_file};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    std::vector<char*> words{const_cast<char*>("sinew")};
    for (const auto& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
    words.push_back(nullptr);
    execv(setting.command.c_str(), words.data());
    _exit(127);
}

} // namespace

Running::Running(const Arguments& arguments, const Setting& setting)
    : output(output_of(setting)), errors(setting.terminal ? new_terminal() : file_of("")), terminal(setting.terminal) {
    const int input = file_of(setting.input);
    const int seen = terminal ? checked(::open(ptsname(errors), O_RDWR | O_NOCTTY | O_CLOEXEC)) : errors;
    child = checked(fork());
    if (child == 0) {
        dup2(input, 0);
        dup2(output, 1);
        dup2(seen, 2);
        become(arguments, setting);
    }
    close(input);
    if (terminal) close(seen);
}

void Running::interrupt() const {
    ::kill(child, SIGINT);
}

void Running::kill() const {
    ::kill(child, SIGKILL);
}

/// A terminal gives an error instead of an end once nobody writes to it.
std::string Running::read_errors() {
    if (!terminal) return read_all(errors);
    std::string text;
    char block[4096];
    for (ssize_t read_bytes; (read_bytes = read(errors, block, sizeof block)) > 0;)
        text.append(block, std::size_t(read_bytes));
    close(errors);
    return text;
}

Outcome Running::wait() {
    Outcome outcome;
    if (terminal) outcome.err = read_errors();
    int status = 0;
    rusage used{};
    checked(wait4(child, &status, 0, &used));
    outcome.seconds = in_seconds(used.ru_utime) + in_seconds(used.ru_stime);
    outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    if (!terminal) outcome.err = read_errors();
    const bool is_file = lseek(output, 0, SEEK_END) > 0;
    if (is_file)
        outcome.out = read_all(output);
    else
        close(output);
    return outcome;
}

std::string Outcome::last_line() const {
    const auto end = out.ends_with('\n') ? out.size() - 1 : out.size();
    const auto before = out.rfind('\n', end - 1);
    const auto line_begin = before == std::string::npos ? 0 : before + 1;
    return out.substr(line_begin, end - line_begin);
}

Outcome sinew(const Arguments& arguments, const Setting& setting) {
    return Running(arguments, setting).wait();
}

std::filesystem::path catalogue() {
    return test::source_dir() + "/tests/cli/catalogue";
}

namespace {
testing::AssertionResult told(bool success, const char* verb, const std::string& text, std::string_view part) {
    return (success ? testing::AssertionSuccess() : testing::AssertionFailure()) << '"' << text << "\"\n"
                                                                                 << verb << "\n\"" << part << '"';
}
} // namespace

testing::AssertionResult has(const std::string& text, std::string_view part) {
    return told(text.find(part) != std::string::npos, "has", text, part);
}

testing::AssertionResult begins(const std::string& text, std::string_view part) {
    return told(text.starts_with(part), "begins with", text, part);
}

testing::AssertionResult ends(const std::string& text, std::string_view part) {
    return told(text.ends_with(part), "ends with", text, part);
}

} // namespace sinew::cli_test
