#pragma once

#include <memory>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace sinew::cli {

/// Exit code of the process. After a signal: 128 + the signal's number, as shells expect, 130 after Ctrl-C.
enum ExitCode : int {
    done = 0,
    bad_input = 1,  ///< unusable input or output: a scene, a file to write
    wrong_usage = 2 ///< meaningless arguments
};

/// Help text of a command.
struct Manual {
    std::string_view name;
    std::string_view usage;    ///< arguments after the name: "SCENE [key=value...]"
    std::string_view about;    ///< a line, begins with a verb
    std::string_view details;  ///< below the options; line breaks are kept
    std::string_view examples; ///< a line each
};

/// A sub-command. Options set the members.
class Command {
  public:
    virtual ~Command() = default;
    virtual Manual manual() const = 0;
    /// Declares options on an empty parser.
    virtual void declare(CLI::App& parser) = 0;
    /// True if all arguments are words, options too: another program reads them.
    virtual bool takes_options_as_words() const { return false; }
    /// Runs the command once the options are read. Returns the exit code; throws CommandError.
    virtual int run() = 0;
};

/// List of sub-commands, in the order of the help. A new command takes one new file, NAME.cpp, which defines
/// `std::unique_ptr<Command> command::NAME()`, and one word here. SINEW_ONLY_COMMAND reduces a build to one command.
#ifdef SINEW_ONLY_COMMAND
#define SINEW_COMMANDS(X) X(SINEW_ONLY_COMMAND)
#else
#define SINEW_COMMANDS(X)                                                                                              \
    X(play)                                                                                                            \
    X(render)                                                                                                          \
    X(export_scene)                                                                                                    \
    X(import_scene)                                                                                                    \
    X(gallery) X(run) X(study) X(record) X(replay) X(diff) X(check) X(info) X(list) X(describe) X(bench)
#endif

namespace command {
#define SINEW_DECLARE(name) std::unique_ptr<Command> name();
SINEW_COMMANDS(SINEW_DECLARE)
#undef SINEW_DECLARE
} // namespace command

std::vector<std::unique_ptr<Command>> all_commands();

} // namespace sinew::cli
