#include "apps/cli/level_file.h"

#include "apps/cli/compiler.h"
#include "apps/cli/console.h"
#include "apps/cli/scene_file.h"
#include "bindings/c/native/lend.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <dlfcn.h>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <link.h>
#include <unistd.h>
#include <vector>

namespace sinew::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* entry_name = "sinew_level_entry";
constexpr const char* empty_scene = R"({"sinew": 1, "world": {"gravity": [0, -9.81]}})";

/// A file that is removed once it is loaded: the dynamic linker would take a new file of an old name for the old one,
/// and a compiler may write over a file that is in use.
class PassingFile {
  public:
    PassingFile() {
        const int file = mkstemp(name_.data());
        if (file < 0) refuse(name_, std::strerror(errno));
        close(file);
    }
    PassingFile(const PassingFile&) = delete;
    PassingFile& operator=(const PassingFile&) = delete;
    ~PassingFile() {
        std::error_code gone;
        fs::remove(name_, gone);
    }
    const std::string& name() const { return name_; }

  private:
    std::string name_ = (fs::temp_directory_path() / "sinew-level-XXXXXX").string();
};

/// Message of the dynamic linker, without the passing file.
std::string linker_message(const std::string& file) {
    const char* const text = dlerror();
    std::string message = text ? text : "it cannot be loaded";
    if (message.starts_with(file + ": ")) message.erase(0, file.size() + 2);
    return message;
}

std::string help_for(const std::string& message) {
    if (message.find("undefined symbol") != std::string::npos)
        return "a level is linked with the libraries it calls; sinew.h alone needs none";
    return "a level is compiled by cc -shared -fPIC level.c -o level.so";
}

bool ends_within(const std::vector<char>& file, std::size_t offset, std::size_t size) {
    return offset <= file.size() && size <= file.size() - offset;
}

/// False for the beginning of a shared object, whose compiler is at work still: memory behind its end cannot be read.
bool is_whole(const std::string& object) {
    std::ifstream stream(object, std::ios::binary);
    const std::vector<char> file(std::istreambuf_iterator<char>(stream), {});
    ElfW(Ehdr) header;
    if (!ends_within(file, 0, sizeof header)) return true; // the dynamic linker says what it is
    std::memcpy(&header, file.data(), sizeof header);
    if (std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0) return true;
    const std::size_t size = sizeof(ElfW(Phdr));
    if (!ends_within(file, header.e_phoff, header.e_phnum * size)) return false;
    for (std::size_t i = 0; i < header.e_phnum; ++i) {
        ElfW(Phdr) part;
        std::memcpy(&part, file.data() + header.e_phoff + i * size, size);
        if (!ends_within(file, part.p_offset, part.p_filesz)) return false;
    }
    return ends_within(file, header.e_shoff, std::size_t(header.e_shnum) * header.e_shentsize);
}

/// Message of a crash, made beforehand: a handler of signals allocates nothing.
struct CrashMessage {
    std::array<char, 512> text{};
    std::size_t size = 0;
} crash_message;

/// Tells which level runs; the signal then ends the program.
void tell_crash(int) {
    std::size_t told = 0;
    while (told < crash_message.size) {
        const auto written = write(STDERR_FILENO, crash_message.text.data() + told, crash_message.size - told);
        if (written <= 0) return;
        told += std::size_t(written);
    }
}

/// Crashes from now on name the level, unless a debugger's library tells of them.
void name_in_crashes(const std::string& word) {
    const auto message = error_text(word, "a crash, in the level or in what it calls",
                                    "compile the level with -g, and run `gdb --args sinew play` with it");
    crash_message.size = message.copy(crash_message.text.data(), crash_message.text.size());
    static std::array<char, 1 << 16> stack; // beside one that has overflowed
    const stack_t beside{.ss_sp = stack.data(), .ss_flags = 0, .ss_size = stack.size()};
    sigaltstack(&beside, nullptr);
    for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) {
        struct sigaction present = {}, wanted = {};
        if (sigaction(signal, nullptr, &present) != 0 || present.sa_handler != SIG_DFL) continue;
        wanted.sa_handler = tell_crash;
        wanted.sa_flags = SA_ONSTACK | SA_RESETHAND;
        sigaction(signal, &wanted, nullptr);
    }
}

/// The level of a shared object, which stays in memory: functions of it may be kept anywhere, as a filter of contacts.
const sinew_level* load(const std::string& object, const std::string& word) {
    if (!is_whole(object)) refuse(word, "it is not whole: its end is missing");
    name_in_crashes(word);
    void* const loaded = dlopen(object.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!loaded) {
        const auto message = linker_message(object);
        refuse(word, message, help_for(message));
    }
    using Entry = const sinew_level* (*)();
    const auto entry = reinterpret_cast<Entry>(dlsym(loaded, entry_name));
    const auto* const level = entry ? entry() : nullptr;
    if (!level)
        refuse(word, fmt::format("it is no level: it has no function {}", entry_name),
               "a level includes <sinew_level.h> and has a line SINEW_LEVEL(.build = build)");
    return level;
}

void make_object(const std::string& word, const std::string& object) {
    if (is_source(word)) return compile(word, object);
    std::error_code problem;
    fs::copy_file(word, object, fs::copy_options::overwrite_existing, problem);
    if (problem) refuse(word, problem.message());
}

} // namespace

bool is_level(const std::string& word) {
    return fs::path(word).extension() == ".so" || is_source(word);
}

play::Fetched open_level(const std::string& word, std::span<const Override> overrides) {
    const PassingFile object;
    make_object(word, object.name());
    const auto* const given = load(object.name(), word);
    std::string problem;
    auto level = c::level_of(given, word, problem);
    if (!level) refuse(word, problem);
    auto opened = open_text(given->scene ? given->scene : empty_scene, word, fs::path(word).parent_path(), overrides);
    Session trial{Opened(opened)}; // a level that cannot be built is refused, and what runs goes on
    trial.play(level);
    if (!level->problem.empty()) refuse(word, level->problem.substr(word.size() + 2));
    return {std::move(opened), "", word, std::move(level)};
}

} // namespace sinew::cli
