#include "apps/cli/arguments.h"
#include "apps/cli/catalogue.h"
#include "apps/cli/command.h"
#include "apps/cli/console.h"
#include "apps/cli/json_line.h"
#include "apps/cli/scene_file.h"
#include "apps/cli/scene_page.h"

#include <fmt/format.h>

namespace sinew::cli {
namespace {

struct Entry {
    std::string name, about, file;
};

/// What the file says it is, without reading more of it than that.
std::string about_file(const std::string& path) {
    try {
        const auto document = open_document(path);
        const auto* about = json::find(document.root, "/about");
        const auto* text = about ? about->as<std::string>() : nullptr;
        if (text) return *text;
        return document.diagnostics.ok() ? "" : fmt::format("broken: see `sinew check {}`", path);
    } catch (const GiveUp&) {
        return "cannot be read";
    }
}

std::vector<Entry> scenes() {
    std::vector<Entry> entries;
    for (const auto& name : catalogue_names()) {
        const auto path = catalogue_path(name).string();
        entries.push_back({name, about_file(path), path});
    }
    return entries;
}

std::vector<Entry> prefabs() {
    std::vector<Entry> entries;
    Prefabs::for_each([&]<class Prefab>(std::type_identity<Prefab>) {
        entries.push_back({std::string(Prefab::name), std::string(Prefab::about), {}});
    });
    return entries;
}

std::string table_of(const std::vector<Entry>& entries) {
    std::vector<std::vector<std::string>> rows;
    for (const auto& entry : entries) rows.push_back({entry.name, entry.about});
    return table(rows);
}

json::Array json_of(const std::vector<Entry>& entries) {
    json::Array items;
    for (const auto& [name, about, file] : entries) {
        json::Object item{{"name", name}, {"about", about}};
        if (!file.empty()) item.push_back({"file", file});
        items.push_back(std::move(item));
    }
    return items;
}

std::string in_table(std::string text) {
    for (std::size_t i = 0; (i = text.find('|', i)) != std::string::npos; i += 2) text.insert(i, 1, '\\');
    return text;
}

/// docs/catalogue.md
std::string markdown() {
    std::string text =
        "# The catalogue\n\n<!-- Made by: sinew list --markdown > docs/catalogue.md -->\n\n"
        "Every scene runs as the engine means it (`physical`) and as the tutorial had it "
        "(`mode=classic`):\n\n"
        "```\nsinew render chains -o out/chains.gif\nsinew render chains mode=classic -o out/chains.gif\n"
        "```\n\n| scene | made of | idea from |\n|---|---|---|\n";
    std::vector<ScenePage> pages;
    for (const auto& name : catalogue_names()) pages.push_back(page_of(name));
    for (const auto& page : pages)
        text += fmt::format("| [`{0}`](#{0}) | {1} | {2} |\n", page.name, page.made_of, in_table(page.source));
    for (const auto& page : pages) {
        text += fmt::format("\n## {}\n\n{}\n\n", page.name, page.about);
        if (!page.parameters.empty()) text += "| value | is | unit | meaning |\n|---|---|---|---|\n";
        for (const auto& [path, value, unit, help] : page.parameters)
            text += fmt::format("| `{}` | {} | {} | {} |\n", path, in_table(value), unit, in_table(help));
    }
    text += "\n## Prefabs\n\n`sinew describe PREFAB` tells their parameters.\n\n| prefab | |\n|---|---|\n";
    for (const auto& [name, about, file] : prefabs()) text += fmt::format("| `{}` | {} |\n", name, in_table(about));
    return text;
}

class ListCommand final : public Command {
    Manual manual() const override {
        return {
            .name = "list",
            .usage = "[--json | --markdown]",
            .about = "lists the scenes of the catalogue and the prefabs",
            .details = "A scene is run, drawn or checked by its name. A prefab is what scene files make figures of;\n"
                       "`sinew describe PREFAB` tells its parameters.\n",
            .examples = "sinew list\n"
                        "sinew list --json | jq -r '.scenes[].name'\n",
        };
    }

    void declare(CLI::App& parser) override {
        declare_words(parser, words);
        declare_flag(parser, "--markdown", as_markdown, "as a page of documentation: all that scenes state");
        declare_flag(parser, "--json", as_json, "one line of JSON: {\"scenes\": [...], \"prefabs\": [...]}");
    }

    int run() override {
        for (const auto& word : words.plain)
            misused(fmt::format("list takes no word such as {}", word), fmt::format("sinew describe {}", word));
        if (!words.overrides.empty()) misused("list changes no values");
        if (as_json && as_markdown) misused("list: --json or --markdown, not both");
        if (as_markdown)
            print(markdown());
        else if (as_json)
            print(to_line(json::Object{{"scenes", json_of(scenes())}, {"prefabs", json_of(prefabs())}}));
        else
            print(fmt::format("{}\n{}\n{}\n{}", bold("scenes"), table_of(scenes()), bold("prefabs"),
                              table_of(prefabs())));
        return done;
    }

    Words words;
    bool as_json = false, as_markdown = false;
};

} // namespace

std::unique_ptr<Command> command::list() {
    return std::make_unique<ListCommand>();
}

} // namespace sinew::cli
