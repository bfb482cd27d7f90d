#include "sinew/prefab/prefabs.h"

#include "apps/cli/arguments.h"
#include "apps/cli/command.h"
#include "apps/cli/console.h"
#include "apps/cli/index.h"
#include "apps/cli/json_line.h"
#include "apps/cli/scene_page.h"

#include <fmt/format.h>

namespace sinew::cli {
namespace {

struct Entry {
    std::string name, about;
};

std::vector<Entry> prefabs() {
    std::vector<Entry> entries;
    Prefabs::for_each([&]<class Prefab>(std::type_identity<Prefab>) {
        entries.push_back({std::string(Prefab::name), std::string(Prefab::about)});
    });
    return entries;
}

std::string scenes_in_words() {
    std::vector<std::vector<std::string>> rows;
    std::string_view category;
    const auto index = catalogue_index();
    for (const auto& entry : index) {
        if (entry.category != category) rows.push_back({bold(entry.category)});
        category = entry.category;
        rows.push_back({entry.name, entry.about});
    }
    return table(rows);
}

std::string prefabs_in_words() {
    std::vector<std::vector<std::string>> rows;
    for (const auto& entry : prefabs()) rows.push_back({entry.name, entry.about});
    return table(rows);
}

json::Object json_of_catalogue() {
    json::Array scenes, made;
    for (const auto& [name, about, category, file] : catalogue_index())
        scenes.push_back(json::Object{{"name", name}, {"about", about}, {"category", category}, {"file", file}});
    for (const auto& [name, about] : prefabs()) made.push_back(json::Object{{"name", name}, {"about", about}});
    return {{"scenes", std::move(scenes)}, {"prefabs", std::move(made)}};
}

std::string in_table(std::string text) {
    for (std::size_t i = 0; (i = text.find('|', i)) != std::string::npos; i += 2) text.insert(i, 1, '\\');
    return text;
}

/// docs/reference/catalogue.md
std::string markdown() {
    std::string text =
        "# The catalogue\n\n<!-- Made by: tools/describe_docs -->\n\n"
        "Every scene runs as the engine means it (`physical`) and as the tutorial had it "
        "(`mode=classic`):\n\n"
        "```\nsinew render chains -o out/chains.gif\nsinew render chains mode=classic -o out/chains.gif\n"
        "```\n\n| | scene | made of | idea from |\n|---|---|---|---|\n";
    std::vector<ScenePage> pages;
    std::string_view category;
    const auto index = catalogue_index();
    for (const auto& entry : index) {
        const auto& page = pages.emplace_back(page_of(entry.name));
        text += fmt::format("| {1} | [`{0}`](#{0}) | {2} | {3} |\n", page.name,
                            entry.category == category ? "" : entry.category, page.made_of, in_table(page.source));
        category = entry.category;
    }
    for (const auto& page : pages) {
        text += fmt::format("\n## {}\n\n{}\n\n", page.name, page.about);
        if (!page.parameters.empty()) text += "| value | is | unit | meaning |\n|---|---|---|---|\n";
        for (const auto& [path, value, unit, help] : page.parameters)
            text += fmt::format("| `{}` | {} | {} | {} |\n", path, in_table(value), unit, in_table(help));
    }
    text += "\n## Prefabs\n\n`sinew describe PREFAB` tells their parameters.\n\n| prefab | |\n|---|---|\n";
    for (const auto& [name, about] : prefabs()) text += fmt::format("| `{}` | {} |\n", name, in_table(about));
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
            usage_error(fmt::format("list takes no word such as {}", word), fmt::format("sinew describe {}", word));
        if (!words.overrides.empty()) usage_error("list changes no values");
        if (as_json && as_markdown) usage_error("list: --json or --markdown, not both");
        if (as_markdown)
            print(markdown());
        else if (as_json)
            print(to_line(json_of_catalogue()));
        else
            print(fmt::format("{}\n{}\n{}", scenes_in_words(), bold("prefabs"), prefabs_in_words()));
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
