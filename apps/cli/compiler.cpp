#include "apps/cli/compiler.h"

#include "apps/cli/console.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fmt/format.h>
#include <string>
#include <sys/wait.h>
#include <system_error>

namespace sinew::cli {
namespace {

namespace fs = std::filesystem;

bool is_c(const fs::path& path) {
    return path.extension() == ".c";
}

std::string variable(const char* name, const char* otherwise) {
    const char* const value = std::getenv(name);
    return value && *value ? value : otherwise;
}

/// A word of a shell's line.
std::string quoted(const std::string& word) {
    std::string out = "'";
    for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
}

/// Folder of sinew.h: of an installed command, or of the source tree.
fs::path include_folder() {
    std::error_code unknown;
    const auto installed = fs::read_symlink("/proc/self/exe", unknown).parent_path() / "../include";
    if (!unknown && fs::exists(installed / "sinew_level.h", unknown)) return installed.lexically_normal();
    return SINEW_INCLUDE_DIR;
}

std::string command_for(const fs::path& source, const fs::path& object) {
    const auto language = is_c(source)
                              ? fmt::format("{} -std=c11 {}", variable("CC", "cc"), variable("CFLAGS", "-g -O1"))
                              : fmt::format("{} -std=c++20 {}", variable("CXX", "c++"), variable("CXXFLAGS", "-g -O1"));
    return fmt::format("{} -Wall -shared -fPIC -I {} -o {} {} 2>&1", language, quoted(include_folder().string()),
                       quoted(object.string()), quoted(source.string()));
}

} // namespace

bool is_source(const fs::path& path) {
    const auto extension = path.extension();
    return extension == ".c" || extension == ".cpp" || extension == ".cc" || extension == ".cxx";
}

void compile(const fs::path& source, const fs::path& object) {
    std::error_code unknown;
    if (!fs::is_regular_file(source, unknown)) refuse(source.string(), "No such file");
    std::FILE* const pipe = popen(command_for(source, object).c_str(), "r");
    if (!pipe) refuse(source.string(), "no compiler could be started");
    std::string said;
    std::array<char, 4096> block{};
    while (const auto read = std::fread(block.data(), 1, block.size(), pipe)) said.append(block.data(), read);
    const int status = pclose(pipe);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return print_error(said); // warnings
    while (said.ends_with('\n')) said.pop_back();
    if (WIFEXITED(status) && WEXITSTATUS(status) == 127)
        refuse(source.string(), said, "install a compiler, or name one by CC or CXX");
    refuse(source.string(), said.empty() ? "it does not compile" : fmt::format("it does not compile:\n{}", said));
}

} // namespace sinew::cli
