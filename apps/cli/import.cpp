#include "sinew/scene/text.h"

#include "apps/cli/arguments.h"
#include "apps/cli/command.h"
#include "apps/cli/console.h"
#include "files/in/formats.h"
#include "files/in/role.h"

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <fstream>

namespace sinew::cli {
namespace {

namespace fs = std::filesystem;

std::string formats_text() {
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

/// A name that files and figures can have: letters, digits, _ and -.
std::string title_from(const fs::path& path) {
    std::string title;
    for (const char c : path.stem().string().substr(0, 40))
        title += std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' ? c : '_';
    return title.empty() ? "scene" : title;
}

/// The whole file; of one beyond the limit so much that it is refused.
std::string read_bytes(const fs::path& path) {
    std::error_code unknown;
    if (fs::is_directory(path, unknown)) refuse(path.string(), "a folder, not a file");
    std::ifstream stream(path, std::ios::binary);
    if (!stream) refuse(path.string(), std::strerror(errno));
    std::string bytes(files::ImportLimits::bytes + 1, '\0');
    stream.read(bytes.data(), std::streamsize(bytes.size()));
    bytes.resize(std::size_t(stream.gcount()));
    return bytes;
}

void write_file(const fs::path& path, const std::string& bytes) {
    std::error_code failure;
    if (path.has_parent_path()) fs::create_directories(path.parent_path(), failure);
    std::ofstream stream(path, std::ios::binary);
    stream.write(bytes.data(), std::streamsize(bytes.size()));
    stream.close();
    if (failure || !stream)
        refuse(path.string(), concat("cannot be written: ", failure ? failure.message() : std::strerror(errno)));
}

class ImportCommand final : public Command {
    Manual manual() const override {
        static const std::string details =
            "The scene is complete: sinew check accepts it, sinew render and play show it. Models and images that it\n"
            "needs are written into folders beside it. What the file has and a scene cannot hold is told on standard\n"
            "error, with its place. The format is known by content, or else by the ending:\n" +
            formats_text() +
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
        const files::ImportFile file{path.string(), title_from(path), read_bytes(path),
                                     path.has_parent_path() ? path.parent_path() : fs::path(".")};
        auto imported = import_of(file);
        const auto target = target_for(path);
        for (const auto& side : imported.beside) write_file(target.parent_path() / side.name, side.bytes);
        write_file(target, json::to_text(imported.scene) + "\n");
        for (const auto& [place, message] : imported.notes)
            print_error(fmt::format("{}{}{}: note: {}\n", path.string(), place.empty() ? "" : ":", place,
                                    printable(message, 400)));
        print(fmt::format("{}: {}\n", target.string(), counts(imported)));
        return done;
    }

    void check_role() const {
        if (role.empty() || files::role_called(role)) return;
        std::vector<std::string_view> names;
        for (const auto& word : files::role_words) names.push_back(word.word);
        usage_error(fmt::format("there is no role {}", in_quotes(role)), suggest(role, names));
    }

    files::Imported import_of(const files::ImportFile& file) const {
        try {
            return files::import_file(file, {role, error, scale});
        } catch (const files::ImportError& problem) {
            refuse(concat(file.name, problem.place.empty() ? "" : ":", problem.place), problem.message, problem.help);
        }
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

    static std::string counts(const files::Imported& imported) {
        const auto number = [&](std::string_view key) {
            const auto* const list = json::find(imported.scene, key);
            return list ? list->value.as<json::Array>()->size() : 0;
        };
        auto text =
            fmt::format("{}, {}", count_of(number("figures"), "figure"), count_of(number("colliders"), "collider"));
        if (!imported.beside.empty()) text += fmt::format(", {} beside it", count_of(imported.beside.size(), "file"));
        return text;
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
