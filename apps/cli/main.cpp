#include "sinew/scene/diagnostic.h"
#include "sinew/scene/text.h"
#include "sinew/solver/simd/kernel.h"
#include "sinew/version.h"

#include "apps/cli/arguments.h"
#include "apps/cli/catalogue.h"
#include "apps/cli/command.h"
#include "apps/cli/console.h"
#include "apps/cli/help.h"

#include <algorithm>
#include <array>
#include <csignal>
#include <exception>
#include <fmt/format.h>
#include <new>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace sinew::cli {

#define SINEW_MAKE(name) all.push_back(command::name());
std::vector<std::unique_ptr<Command>> all_commands() {
    std::vector<std::unique_ptr<Command>> all;
    SINEW_COMMANDS(SINEW_MAKE)
    return all;
}
#undef SINEW_MAKE

namespace {

using Arguments = std::span<const std::string>;

/// Suggestion for an unknown command: "did you mean "render"? (commands: ...)"; for a scene's name, how to draw the
/// scene.
std::string command_help(const std::string& word) {
    if (std::ranges::count(catalogue_names(), word) > 0 || word.ends_with(".json"))
        return fmt::format("to draw a scene: sinew render {}", word);
    std::vector<std::string_view> names;
    const auto commands = all_commands();
    for (const auto& command : commands) names.push_back(command->manual().name);
    return suggest(word, names);
}

std::unique_ptr<Command> command_of(const std::string& word) {
    for (auto& command : all_commands())
        if (command->manual().name == word) return std::move(command);
    if (word.starts_with("-")) {
        constexpr std::array<std::string_view, 2> options{"--help", "--version"};
        const auto meant = nearest(word, options);
        usage_error(fmt::format("no option {} here", printable(word)),
                    meant.empty() ? "options follow the command: sinew COMMAND OPTIONS"
                                  : fmt::format("did you mean {}?", meant));
    }
    usage_error(fmt::format("there is no command {}", in_quotes(word)), command_help(word));
}

int run_command(Command& command, Arguments arguments) {
    if (parse(command, arguments)) return command.run();
    print(manual_text(command));
    return done;
}

int help(Arguments topics) {
    if (topics.empty()) print(overview_text());
    for (const auto& topic : topics) print(manual_text(*command_of(topic)));
    return done;
}

int run(Arguments arguments) {
    if (arguments.empty()) return help({});
    const auto& first = arguments[0];
    const auto rest = arguments.subspan(1);
    if (first == "help" || first == "--help" || first == "-h") return help(rest);
    if (first == "--version") return print("sinew " SINEW_VERSION "\n"), int(done);
    return run_command(*command_of(first), rest);
}

/// Maps large blocks separately, so that freed blocks return to the system at once; otherwise a large world's process
/// keeps all temporary memory of building the world.
void give_back_at_once() {
#ifdef __GLIBC__
    mallopt(M_MMAP_THRESHOLD, 1 << 18);
#endif
}

int run_or_explain(Arguments arguments) {
    if (!has_any_simd()) {
        print_error(
            error_text("sinew", "this build has no kernels for this processor", "build it with SINEW_KERNELS=one"));
        return bad_input;
    }
    try {
        return run(arguments);
    } catch (const CommandError& end) {
        print_error(end.message);
        return end.code;
    } catch (const std::bad_alloc&) {
        print_error(error_text("sinew", "out of memory"));
    } catch (const std::exception& error) {
        print_error(error_text("sinew", error.what()));
    }
    return bad_input;
}

} // namespace
} // namespace sinew::cli

int main(int count, char** words) {
    sinew::cli::give_back_at_once();
    std::signal(SIGPIPE, SIG_IGN); // a write into a closed pipe returns an error instead
    const std::vector<std::string> arguments(words + std::min(count, 1), words + count);
    return sinew::cli::close_output(sinew::cli::run_or_explain(arguments));
}
