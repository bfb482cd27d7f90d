#include "sinew/scene/limits.h"
#include "sinew/scene/reader.h"
#include "sinew/scene/scene.h"
#include "sinew/scene/text.h"

#include "apps/cli/arguments.h"
#include "apps/cli/command.h"
#include "apps/cli/console.h"
#include "apps/cli/kind_text.h"
#include "apps/cli/prefab_names.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace sinew::cli {
namespace {

/// A record with a table of fields: a section of a scene file, or an alternative of a section.
struct Topic {
    std::string path; ///< "solver.rules", "figures.rope"
    std::string_view about;
    const Layout* record;
    bool shadowed = false; ///< an outer topic has the same last name

    std::string_view last() const { return std::string_view(path).substr(path.rfind('.') + 1); } // npos + 1 is 0
    /// Name on the command line: "rope".
    std::string_view name() const { return shadowed ? std::string_view(path) : last(); }
    /// Outer topics first; a prefab before what is called alike elsewhere, such as the collider `box`.
    auto rank() const { return std::pair(std::ranges::count(path, '.'), !path.starts_with("figures.")); }
};

/// Record in a field: the field itself, or the elements of a list or map; null if none.
const Layout* record_in(const Layout& shape) {
    if (shape.type == Layout::Type::record) return &shape;
    const bool many = shape.type == Layout::Type::list || shape.type == Layout::Type::map;
    return many ? record_in(shape.parts[0]) : nullptr;
}

void collect(std::vector<Topic>& topics, const Layout& record, const std::string& prefix) {
    const auto add = [&](const Layout& part, std::string_view name, std::string_view about) {
        topics.push_back({prefix + std::string(name), about, &part});
        collect(topics, part, topics.back().path + ".");
    };
    for (const auto& field : record.parts) {
        if (field.type == Layout::Type::choice)
            for (const auto& alternative : field.parts) add(alternative, alternative.name, alternative.about);
        else if (const auto* inside = record_in(field))
            add(*inside, field.field.name, field.field.help);
    }
}

/// Owner of the layouts topics point to.
struct Layouts {
    Layout scene = scene_layout();
    Layout limits = layout_of<Limits>();
};

std::vector<Topic> topics_of(const Layouts& shapes) {
    std::vector<Topic> topics{
        {"scene", "A scene file", &shapes.scene},
        {"limits", "Limits beyond which a scene is refused; set on the command line only", &shapes.limits}};
    collect(topics, shapes.scene, "");
    std::ranges::stable_sort(topics, {}, &Topic::rank);
    std::set<std::string_view> taken;
    for (auto& topic : topics) topic.shadowed = !taken.insert(topic.last()).second;
    return topics;
}

const Topic& topic_called(const std::vector<Topic>& topics, const std::string& word) {
    std::vector<std::string_view> names;
    for (const auto& topic : topics) {
        if (word == topic.path || word == topic.name()) return topic;
        names.push_back(topic.name());
    }
    names.insert(names.end(), kind_names.begin(), kind_names.end());
    usage_error(fmt::format("no topic is called {}", in_quotes(word)), suggest(word, std::move(names)));
}

std::string overview(const std::vector<Topic>& topics) {
    std::vector<std::vector<std::string>> rows;
    for (const auto& topic : topics) rows.push_back({std::string(topic.name()), std::string(topic.about)});
    std::vector<std::vector<std::string>> kinds;
    for (const auto& kind : every_kind) kinds.push_back({std::string(kind.name), std::string(kind.manual.about)});
    return fmt::format("{}\n{}\n{}\n{}", bold("topics"), table(rows), bold("kinds of constraints"), table(kinds));
}

class DescribeCommand final : public Command {
    Manual manual() const override {
        return {
            .name = "describe",
            .usage = "PREFAB | KIND | kinds | scene | SECTION [--schema] [--markdown]",
            .about = "describes scene files: parameters, units, defaults, ranges, names, kinds of constraints",
            .details = "Without a name, lists all topics. Defaults and ranges are in metres, kilograms and seconds;\n"
                       "in a scene in px a metre counts as 100, in a scene in frames a second counts as 60.\n"
                       "For a prefab, also describes the position \"at\" and the names of particles, constraints\n"
                       "and drawn parts.\n",
            .examples = "sinew describe\n"
                        "sinew describe rope\n"
                        "sinew describe pulley                               a kind of constraint\n"
                        "sinew describe solver.rules\n"
                        "sinew describe scene --schema > scene.schema.json    for editors\n",
        };
    }

    void declare(CLI::App& parser) override {
        declare_words(parser, words);
        declare_flag(parser, "--schema", schema, "as a JSON Schema (draft 07)");
        declare_flag(parser, "--markdown", markdown, "as tables for documentation");
    }

    int run() override {
        const Layouts shapes;
        const auto topics = topics_of(shapes);
        if (schema && markdown) usage_error("describe: --schema or --markdown, not both");
        if (!words.overrides.empty()) usage_error("describe changes no values");
        if (words.plain.empty()) print(overview(topics));
        for (const auto& word : words.plain)
            if (!print_kinds(word)) print(text_of(topic_called(topics, word), &shapes.scene));
        return done;
    }

    /// Prints a kind of constraint, or all `kinds`; false for any other word.
    bool print_kinds(std::string_view word) const {
        bool found = false;
        for (const auto& kind : every_kind) {
            if (word != kind.name && word != "kinds") continue;
            if (schema) usage_error(fmt::format("describe: a kind such as {} has no schema", kind.name));
            print((found ? "\n" : "") + (markdown ? kind_markdown(kind) : kind_text(kind)));
            found = true;
        }
        return found;
    }

    std::string text_of(const Topic& topic, const Layout* scene) const {
        if (schema) return json::to_text(schema_of(*topic.record, topic.name(), topic.record == scene)) + "\n";
        Layout titled = *topic.record;
        titled.name = topic.name();
        titled.about = topic.about;
        if (markdown) return describe_markdown(titled);
        const bool is_prefab = topic.path.starts_with("figures.");
        return sinew::describe(titled) + (is_prefab ? prefab_names(topic.last()) : "");
    }

    Words words;
    bool schema = false, markdown = false;
};

} // namespace

std::unique_ptr<Command> command::describe() {
    return std::make_unique<DescribeCommand>();
}

} // namespace sinew::cli
