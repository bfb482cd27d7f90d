#include "sinew/scene/text.h"

#include "apps/cli/arguments.h"
#include "apps/cli/command.h"
#include "apps/cli/console.h"
#include "apps/cli/imported_file.h"
#include "apps/cli/index.h"
#include "apps/cli/json_line.h"
#include "apps/cli/level_file.h"
#include "apps/cli/scene_file.h"
#include "apps/cli/stepping.h"
#include "canvas/formats.h"
#include "canvas/interrupt.h"
#include "files/out/export_formats.h"
#include "files/out/frame_name.h"
#include "player/files.h"
#include "player/keys.h"
#include "player/script.h"
#include "player/tool.h"
#ifdef SINEW_WINDOW
#include "apps/window/window.h"
#endif

#include <fmt/format.h>

namespace sinew::cli {
namespace {

using play::Play;

constexpr std::size_t longest_script = 1 << 20; // bytes

/// The text without terminal escape sequences.
std::string plain(const std::string& text) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\033')
            while (i < text.size() && text[i] != 'm') ++i;
        else
            out += text[i];
    }
    return out;
}

play::Fetched fetch(const std::string& word, std::span<const Override> overrides) {
    try {
        if (is_level(word)) return open_level(word, overrides);
        play::Fetched fetched{open_file(word, overrides), "", {}};
        fetched.path = scene_path(word);
        return fetched;
    } catch (const CommandError& problem) {
        return {std::nullopt, plain(problem.message), {}};
    }
}

play::Fetched read(const std::string& text, const std::string& name, const std::filesystem::path& beside) {
    try {
        return {open_text(text, name, beside.parent_path()), "", {}};
    } catch (const CommandError& problem) {
        return {std::nullopt, plain(problem.message), {}};
    }
}

/// Makes a scene in out/ of a drawing, a model, a map or a picture.
play::Converted convert(const std::filesystem::path& path) {
    try {
        auto file = read_import(path);
        if (!files::is_foreign(file)) return {};
        const auto scene = play::free_path(std::filesystem::path("out") / (file.title + ".json"));
        file.title = scene.stem().string(); // of the files beside it, too
        const auto imported = import_of(file, {});
        write_import(imported, scene);
        auto message = fmt::format("imported: {}", import_counts(imported));
        if (!imported.notes.empty()) {
            const auto notes = std::filesystem::path("out") / (file.title + "_notes.txt");
            write_import_notes(imported, path, notes);
            message += fmt::format("; {} on what it could not take: {}", count_of(imported.notes.size(), "note"),
                                   notes.string());
        }
        for (const auto& note : imported.notes) print_error(import_note(path, note) + '\n');
        return {scene, "", std::move(message)};
    } catch (const CommandError& problem) {
        return {{}, plain(problem.message), ""};
    }
}

/// Models, and vectors and films that are no films of pictures.
std::unique_ptr<files::Exporter> open_export(const std::filesystem::path& path, std::array<int, 2> size, double fps) {
    const auto* const format = files::export_format_of(path);
    if (!format || (format->is_painted && canvas::format_of(path))) return nullptr;
    const bool moves = format->frames == files::FramesPerFile::all || files::has_frame_number(path);
    if (moves != (fps > 0)) return nullptr;
    return format->open({.path = path, .fps = fps > 0 ? fps : format->usual_fps, .size = size});
}

play::SceneLibrary library() {
    play::SceneLibrary library{{}, {}, fetch, read, convert, open_export};
    for (auto& entry : catalogue_index()) {
        library.names.push_back(std::move(entry.name));
        library.categories.push_back(std::move(entry.category));
    }
    return library;
}

std::string keys_text() {
    std::string text;
    for (const auto& action : play::key_actions()) text += fmt::format("  {:8} {}\n", action.key, action.about);
    text += fmt::format("  {:8} {}\n", "1 to 9", "overlays");
    for (const auto& tool : play::all_tools())
        text += fmt::format("  {:8} {}: {}\n", tool->key(), tool->name(), tool->about());
    return text;
}

class PlayCommand final : public Command {
    Manual manual() const override {
        return {
            .name = "play",
            .usage = "[SCENE] [--script FILE] [--json] [key=value...]",
            .about = "plays with a scene in a window",
            .details = details,
            .examples = "sinew play\n"
                        "sinew play ragdoll mode=classic\n"
                        "sinew play my-scene.json view.theme=dark\n"
                        "sinew play ./my_level.so\n"
                        "sinew play ragdoll --script throw.txt --json\n",
        };
    }

    void declare(CLI::App& parser) override {
        declare_words(parser, words);
        declare_text(parser, "--script", script_path, "FILE", "plays what the file says, without a window");
        declare_flag(parser, "--json", as_json, "tells what happens, one line of JSON each");
    }

    int run() override {
        if (words.plain.size() > 1)
            usage_error(fmt::format("{} is neither an option nor key=value", in_quotes(words.plain[1])),
                        "one scene is played at a time");
        const auto script = script_path.empty() ? std::nullopt : std::optional(read_script());
        if (!script) refuse_without_window();
        const auto scene = words.plain.empty() ? std::string("ragdoll") : words.plain[0];
        canvas::catch_interrupts();
        Play game(library(), scene, words.overrides);
        if (!game.ready()) throw CommandError{bad_input, game.problem()};
        game.shows_problems = !script; // a script fails in the end
        if (as_json) game.listener = [&](const play::Told& told) { print_told(game, told); };
        return script ? play_script(*script, game) : play_window(game);
    }

    play::Script read_script() const {
        auto read = play::read_script(read_text(script_path, longest_script));
        if (!read.problem.empty()) refuse(script_path, read.problem);
        return std::move(read.script);
    }

    int play_script(const play::Script& script, Play& game) const {
        const auto problem = play::run_script(script, game, [](double) { give_up_if_interrupted(); });
        if (!problem.empty()) refuse(script_path, problem);
        game.tell("end", {{"hash", game.hash()}});
        if (!game.problem().empty()) refuse_as_told(game.problem());
        return done;
    }

    /// Diagnostics of files are whole lines already; other problems are sentences.
    static void refuse_as_told(const std::string& problem) {
        if (problem.ends_with('\n')) throw CommandError{bad_input, problem};
        refuse("sinew play", problem);
    }

#ifdef SINEW_WINDOW
    static void refuse_without_window() {
        if (!window::has_display())
            refuse("sinew play", "there is no display to open a window on",
                   "draw it into a file instead: sinew render ragdoll -o ragdoll.mp4");
    }
    static int play_window(Play& game) {
        if (const auto problem = window::show(game)) refuse("sinew play", *problem);
        return done;
    }
#else
    static void refuse_without_window() {
        refuse("sinew play", "this sinew was built without its window",
               "apt-get install libsdl2-dev libimgui-dev libepoxy-dev, and build again; or draw into a file: sinew "
               "render ragdoll -o ragdoll.mp4");
    }
    static int play_window(Play&) {
        return bad_input;
    }
#endif

    static void print_told(const Play& game, const play::Told& told) {
        json::Object line{{"what", told.what}};
        if (game.ready()) {
            line.push_back({"scene", game.scene_name()});
            if (!json::find(told.more, "seconds")) line.push_back({"seconds", game.session().seconds()});
        }
        for (const auto& member : told.more) line.push_back(member);
        print(to_line(line));
        flush_output();
    }

    std::string details =
        "SCENE may be a level: a shared object, or C or C++ to compile to one (sinew_level.h), which\n"
        "builds a world and acts in it. Compiled again, it is loaded again and the world goes on. Arrow\n"
        "keys, space and h steer levels, characters and cars.\n\n"
        "In the window: drag to throw, drag with the right button to cut, with the middle one to look\n"
        "elsewhere; the wheel zooms. Keys:\n\n" +
        keys_text() +
        "\nA script is a line of text for each thing that a player does: the second, then what.\n\n"
        "  0.5 move bob/right_hand\n"
        "  0.7 press\n"
        "  1.0 move 900 200 over 0.5\n"
        "  1.6 release\n"
        "  2.0 key p\n"
        "  2.1 shot thrown.png\n\n"
        "Also: scroll N, where PARTICLE, set PATH=VALUE, open SCENE, go STEP, save FILE, state FILE,\n"
        "paste FILE, answer WORD, choose FILE, down KEY and up KEY for one that is held, end.\n\n"
        "With --json a line has what, scene, seconds and more. What happens in the scene has the members\n"
        "that it has in the log of run --json: where, islands, with, impulse.\n";
    Words words;
    std::string script_path;
    bool as_json = false;
};

} // namespace

std::unique_ptr<Command> command::play() {
    return std::make_unique<PlayCommand>();
}

} // namespace sinew::cli
