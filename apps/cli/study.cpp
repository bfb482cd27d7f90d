#include "apps/cli/arguments.h"
#include "apps/cli/command.h"
#include "apps/cli/console.h"

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fmt/format.h>
#include <unistd.h>

namespace sinew::cli {
namespace {

/// Studies are the Python package's: one process becomes the other, so that signals, output and exit code are its own.
constexpr const char* program = R"(import sys
try:
    from sinew.study.command import main
except ModuleNotFoundError as missing:
    if (missing.name or "").split(".")[0] not in ("sinew", "numpy"):
        raise
    print(f"sinew: error: {sys.executable} has no module {missing.name}: studies need the Python package\n"
          "      = help: pip install --no-build-isolation bindings/python in the source tree, or ./dev python and\n"
          "        PYTHONPATH=build-python/python; SINEW_PYTHON names another interpreter", file=sys.stderr)
    sys.exit(1)
sys.exit(main(sys.argv[1:]))
)";

class StudyCommand final : public Command {
    Manual manual() const override {
        return {
            .name = "study",
            .usage = "FILE [OPTION...]",
            .about = "runs many cases of a scene and measures them: a table, and a page with pictures",
            .details =
                "FILE says which scene, what varies, what is measured and until when. Killed, the same command goes\n"
                "on. `sinew study --help` tells the options: parts for other machines, a check by running again.\n"
                "The Python package runs it, by the interpreter python3 or the one that SINEW_PYTHON names.\n",
            .examples = "sinew study bridge.study.json                  all cases, on all cores\n"
                        "sinew study bridge.study.json --check          only whether the file is right\n"
                        "sinew study bridge.study.json --part 3/32      a part of the cases, on another machine\n"
                        "sinew study bridge.study.json --collect        all parts together\n"
                        "sinew study bridge.study.json --verify 20      20 cases again: the same hashes?\n",
        };
    }

    void declare(CLI::App& parser) override { parser.add_option("words", words); }
    bool takes_options_as_words() const override { return true; }

    int run() override {
        const char* const named = std::getenv("SINEW_PYTHON");
        const std::string python = named && *named ? named : "python3";
        std::vector<std::string> all{python, "-c", program};
        all.insert(all.end(), words.begin(), words.end());
        std::vector<char*> arguments;
        for (auto& word : all) arguments.push_back(word.data());
        arguments.push_back(nullptr);
        execvp(python.c_str(), arguments.data());
        refuse("sinew", fmt::format("{} cannot be started: {}", python, std::strerror(errno)),
               "studies need Python and its package sinew: docs/how/studies.md");
    }

    std::vector<std::string> words;
};

} // namespace

std::unique_ptr<Command> command::study() {
    return std::make_unique<StudyCommand>();
}

} // namespace sinew::cli
