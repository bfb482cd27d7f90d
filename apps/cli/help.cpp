#include "apps/cli/help.h"

#include "sinew/version.h"

#include "apps/cli/arguments.h"
#include "apps/cli/catalogue.h"
#include "apps/cli/command.h"
#include "apps/cli/console.h"

#include <fmt/format.h>

namespace sinew::cli {
namespace {

constexpr std::string_view words_text = R"(
  SCENE is the path of a scene file, the name of a scene of the catalogue, or - for standard input.
  key=value changes a value of the scene by its path; `sinew describe scene` tells them all:
      mode=classic   solver.substeps=16   figures.bob.height=200   world.gravity=[0,-9.81]
)";

constexpr std::string_view overview_examples =
    R"(  sinew list                                        scenes and prefabs to begin with
  sinew render ragdoll -o ragdoll.mp4               a film
  sinew render ragdoll -o ragdoll.png --sheet 4x3   twelve moments of it on one picture
  sinew run ragdoll --seconds 10 --json             how it ends, in numbers
  sinew run ragdoll mode=classic                    as the original demo moved
  sinew describe rope                               what can be said of a rope in a scene file
  sinew check my.json                               what is wrong with a scene file
)";

std::string indented(std::string_view lines) {
    std::string out;
    while (!lines.empty()) {
        const auto line = lines.substr(0, lines.find('\n'));
        lines.remove_prefix(std::min(line.size() + 1, lines.size()));
        out += line.empty() ? "\n" : fmt::format("  {}\n", line);
    }
    return out;
}

} // namespace

std::string overview_text() {
    std::vector<std::vector<std::string>> rows;
    for (const auto& command : all_commands())
        rows.push_back({std::string(command->manual().name), std::string(command->manual().about)});
    rows.push_back({"help COMMAND", "tells more about a command"});
    return fmt::format("Sinew {}: figures of Verlet points and constraints.\n\n"
                       "usage: sinew COMMAND [ARGUMENT...]\n\n{}\n{}\n{}{}\n{}\n{}",
                       SINEW_VERSION, bold("commands"), table(rows), bold("words"), words_text, bold("examples"),
                       overview_examples) +
           fmt::format("\nThe catalogue is {}; SINEW_SCENES=FOLDER in the environment names another.\n"
                       "Folders that are missing on the way to a file that is written are made.\n"
                       "Exit codes: 0 done, 1 the input cannot be used, 2 wrong usage.\n",
                       catalogue_folder().string());
}

std::string manual_text(Command& command) {
    const auto manual = command.manual();
    auto text = fmt::format("sinew {} {}\n\n{}\n{}", manual.name, manual.about, bold("usage"),
                            indented(fmt::format("sinew {} {}\n", manual.name, manual.usage)));
    if (manual.usage.find("key=value") != std::string_view::npos) text += words_text;
    if (!command.takes_options_as_words())
        text += fmt::format("\n{}\n{}", bold("options"), table(option_rows(command)));
    if (!manual.details.empty()) text += "\n" + indented(manual.details);
    return text + fmt::format("\n{}\n{}", bold("examples"), indented(manual.examples));
}

} // namespace sinew::cli
