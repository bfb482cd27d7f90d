#pragma once

#include <memory>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace sinew::cli {

/// What a shell is told about how it ended. After a signal it is 128 + its number, as shells expect: 130 after Ctrl-C.
enum ExitCode : int {
    done = 0,
    bad_input = 1,  ///< what was given cannot be used: a scene, a file to write
    wrong_usage = 2 ///< what was asked for makes no sense
};

/// What help says about a command.
struct Manual {
    std::string_view name;
    std::string_view usage;    ///< what follows the name: "SCENE [key=value...]"
    std::string_view about;    ///< one line, begins with a verb
    std::string_view details;  ///< below the options; lines end as they shall be seen
    std::string_view examples; ///< a line each
};

/// A sub-command: its members are what its options set.
class Command {
  public:
    virtual ~Command() = default;
    virtual Manual manual() const = 0;
    /// Declares options on an empty parser.
    virtual void declare(CLI::App& parser) = 0;
    /// Called once the options are read. Gives the exit code; throws GiveUp.
    virtual int run() = 0;
};

/// The list of sub-commands, in the order of the help. A new one is one new file, NAME.cpp, that defines
/// `std::unique_ptr<Command> command::NAME()`, and one word here. A build may want but one.
#ifdef SINEW_ONLY_COMMAND
#define SINEW_COMMANDS(X) X(SINEW_ONLY_COMMAND)
#else
#define SINEW_COMMANDS(X) X(play) X(render) X(gallery) X(run) X(check) X(info) X(list) X(describe) X(bench)
#endif

namespace command {
#define SINEW_DECLARE(name) std::unique_ptr<Command> name();
SINEW_COMMANDS(SINEW_DECLARE)
#undef SINEW_DECLARE
} // namespace command

std::vector<std::unique_ptr<Command>> all_commands();

} // namespace sinew::cli
