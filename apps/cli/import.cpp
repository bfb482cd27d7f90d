#include "sinew/scene/text.h"

#include "apps/cli/arguments.h"
#include "apps/cli/command.h"
#include "apps/cli/console.h"
#include "apps/cli/imported_file.h"
#include "files/in/formats.h"
#include "files/in/role.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace sinew::cli {
namespace {

namespace fs = std::filesystem;

std::string import_formats_text() {
    std::string text;
    for (const auto* format : files::import_formats())
        text += fmt::format("  {:18} {}\n", fmt::format("{} ({})", format->name, format->endings), format->about);
    return text;
}

std::string roles_text() {
    std::string text;
    for (const auto& role : files::role_words) text += fmt::format("  {:11} {}\n", role.word, role.about);
    return text;
}

class ImportCommand final : public Command {
    Manual manual() const override {
        static const std::string details =
            "The scene is complete: sinew check accepts it, sinew render and play show it. Models and images that it\n"
            "needs are written into folders beside it. What the file has and a scene cannot hold is told on standard\n"
            "error, with its place. The format is known by content, or else by the ending:\n" +
            import_formats_text() +
            "What a shape or a mesh becomes is a word in its id, class, layer or name (\"rope_2\", \"ground\"), that "
            "of the\n"
            "nearest group around it, or else --as:\n" +
            roles_text();
        return {
            .name = "import",
            .usage = "FILE [-o SCENE] [--as ROLE] [--error E] [--scale F]",
            .about = "makes a scene of a drawing, a model, a map or a picture",
            .details = details,
            .examples = "sinew import logo.svg -o logo.json --as jelly\n"
                        "sinew import level.tmj -o level.json\n"
                        "sinew import figure.glb -o figure.json        its skeleton as a ragdoll\n"
                        "sinew import cat.png -o cat.json --as crate   its outline, wearing the picture\n",
        };
    }

    void declare(CLI::App& parser) override {
        declare_words(parser, words);
        declare_text(parser, "-o,--output", output, "SCENE", "scene to write; else FILE's name with .json, here");
        declare_text(parser, "--as", role, "ROLE", "what becomes of shapes whose name tells nothing");
        declare_number(parser, "--error", error, {1e-6, 1e6}, "E", "largest distance of a simplified outline, pixels");
        declare_number(parser, "--scale", scale, {1e-6, 1e6}, "F", "length in the scene of a unit of the file");
    }

    int run() override {
        if (words.plain.size() != 1 || !words.overrides.empty())
            usage_error("import: exactly one file is expected", "sinew import FILE");
        check_role();
        const fs::path path = words.plain[0];
        const auto imported = import_of(read_import(path), {role, error, scale});
        const auto target = target_for(path);
        write_import(imported, target);
        for (const auto& note : imported.notes) print_error(import_note(path, note) + '\n');
        print(fmt::format("{}: {}\n", target.string(), import_counts(imported)));
        return done;
    }

    void check_role() const {
        if (role.empty() || files::role_called(role)) return;
        std::vector<std::string_view> names;
        for (const auto& word : files::role_words) names.push_back(word.word);
        usage_error(fmt::format("there is no role {}", in_quotes(role)), suggest(role, names));
    }

    /// The file to write: never the imported one, and no other by its default name.
    fs::path target_for(const fs::path& path) const {
        std::error_code unknown;
        const fs::path target = output.empty() ? fs::path(path.stem()).concat(".json") : fs::path(output);
        if (fs::equivalent(target, path, unknown))
            refuse(target.string(), "the scene would replace the imported file", "-o FILE names another");
        if (output.empty() && fs::exists(target, unknown))
            refuse(target.string(), "this file exists already", "-o FILE names another, or this one to replace it");
        return target;
    }

    Words words;
    std::string output, role;
    std::optional<double> error, scale;
};

} // namespace

std::unique_ptr<Command> command::import_scene() {
    return std::make_unique<ImportCommand>();
}

} // namespace sinew::cli
