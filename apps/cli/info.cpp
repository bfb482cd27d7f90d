#include "sinew/constraint/kind_table.h"
#include "sinew/world/islands.h"
#include "sinew/world/rig.h"

#include "apps/cli/arguments.h"
#include "apps/cli/command.h"
#include "apps/cli/console.h"
#include "apps/cli/json_line.h"
#include "apps/cli/report_text.h"
#include "apps/cli/scene_file.h"
#include "apps/cli/stepping.h"
#include "canvas/interrupt.h"

#include <fmt/format.h>
#include <span>

namespace sinew::cli {
namespace {

using Rows = std::vector<std::vector<std::string>>;

/// Number of constraints of one kind; lists follow the order of the list of kinds.
struct KindCount {
    std::string_view kind;
    std::size_t count = 0;
};
using KindCounts = std::vector<KindCount>;

/// Summary of a figure.
struct FigureSummary {
    std::string name, prefab;
    std::size_t particles = 0;
    double mass = 0;
    std::size_t islands = 0; ///< at the end
    KindCounts constraints;
    std::vector<std::string> particle_names, constraint_names;
};

template <int D> KindCounts no_constraints() {
    KindCounts counts;
    for (const auto& kind : kinds_in<D>) counts.push_back({kind.name});
    return counts;
}

template <int D, class Real> double mass_of(const World<D, Real>& world, const Figure& figure) {
    double mass = 0;
    for (const auto particle : figure.particles) {
        const auto row = row_of(world, particle);
        const auto inverse = row ? double(world.particles.inverse_mass[*row]) : 0;
        if (inverse > 0) mass += 1 / inverse;
    }
    return mass;
}

/// Given names, then numbered ones.
template <class Id> std::vector<std::string> names_in(const NameTable<Id>& named, std::span<const Numbered> numbered) {
    std::vector<std::string> names;
    for (const auto& [name, id] : named) names.push_back(name);
    for (const auto& run : numbered)
        for (std::size_t i = 0; i < run.count; ++i) names.push_back(name_of(run.first + i, std::span(&run, 1)));
    return names;
}

template <int D, class Real> FigureSummary summary_of(const World<D, Real>& world, const Figure& figure) {
    FigureSummary summary{figure.name,
                          figure.prefab,
                          figure.particles.size(),
                          mass_of(world, figure),
                          0,
                          no_constraints<D>(),
                          names_in(figure.particle_names, figure.particle_numbers),
                          names_in(figure.constraint_names, figure.constraint_numbers)};
    for (const auto& constraint : figure.constraints) ++summary.constraints[std::size_t(constraint.kind)].count;
    return summary;
}

std::vector<FigureSummary> figures_of(const AnyWorld& any) {
    std::vector<FigureSummary> figures;
    std::visit(
        [&](const auto& world) {
            for (const auto& figure : world.figures) figures.push_back(summary_of(world, figure));
        },
        any);
    return figures;
}

/// Sets each figure's present number of islands.
void count_islands(const AnyWorld& any, std::vector<FigureSummary>& figures) {
    const auto counts = std::visit([](const auto& world) { return islands(world); }, any);
    for (std::size_t i = 0; i < figures.size() && i < counts.size(); ++i) figures[i].islands = counts[i];
}

std::vector<RigFault> rig_of(const AnyWorld& any) {
    return std::visit([](const auto& world) { return rig_faults(world); }, any);
}

std::string rig_text(const std::vector<RigFault>& faults) {
    if (faults.empty()) return "  nothing is wrong with it\n";
    Rows rows;
    for (const auto& fault : faults) rows.push_back({fault.where, fault.what});
    return table(rows);
}

json::Array rig_json(const std::vector<RigFault>& faults) {
    json::Array items;
    for (const auto& fault : faults) items.push_back(json::Object{{"where", fault.where}, {"what", fault.what}});
    return items;
}

KindCounts constraints_of(const AnyWorld& any) {
    return std::visit(
        []<int D, class Real>(const World<D, Real>& world) {
            auto counts = no_constraints<D>();
            std::size_t kind = 0;
            for_each_table(world, [&](const auto& table) { counts[kind++].count = table.size(); });
            return counts;
        },
        any);
}

std::size_t pins_of(const AnyWorld& any) {
    return std::visit([](const auto& world) { return world.pins.size(); }, any);
}

std::string in_words(const KindCounts& counts) {
    std::string text;
    for (const auto& [kind, count] : counts)
        if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, kind);
    return text.empty() ? "none" : text;
}

json::Object in_json(const KindCounts& counts) {
    json::Object object;
    for (const auto& [kind, count] : counts) object.push_back({std::string(kind), count});
    return object;
}

/// Names of force fields, gravity first: in the scene file gravity is a property of the world.
std::vector<std::string> forces_of(const Scene& scene) {
    std::vector<std::string> names;
    if (scene.world.gravity != Point{}) names.push_back("gravity");
    for (const auto& section : scene.world.forces)
        std::visit([&]<class Force>(const Force&) { names.push_back(std::string(Force::name)); }, section.force);
    return names;
}

std::string bounds_of(const Scene& scene) {
    if (!scene.world.bounds) return "none";
    const auto& bounds = *scene.world.bounds;
    const auto planes = bounds.planes.size();
    if (planes == 0) return bounds.box ? "a box" : "none";
    return fmt::format("{}{}", bounds.box ? "a box, " : "", count_of(planes, "plane"));
}

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const auto& word : words) text += (text.empty() ? "" : ", ") + word;
    return text.empty() ? "none" : text;
}

json::Array in_json(const std::vector<std::string>& words) {
    return {words.begin(), words.end()};
}

std::string figures_text(const std::vector<FigureSummary>& figures, const Scene& scene) {
    Rows rows;
    for (const auto& figure : figures)
        rows.push_back({figure.name, figure.prefab, count_of(figure.particles, "particle"),
                        quantity(figure.mass, unit::mass, scene), in_words(figure.constraints),
                        count_of(figure.islands, "island") + " in the end"});
    return table(rows);
}

std::string names_text(const std::vector<FigureSummary>& figures) {
    Rows rows;
    for (const auto& figure : figures) {
        for (const auto& name : figure.particle_names) rows.push_back({figure.name + "/" + name, "particle"});
        for (const auto& name : figure.constraint_names) rows.push_back({figure.name + "/" + name, "constraint"});
    }
    return table(rows);
}

json::Array figures_json(const std::vector<FigureSummary>& figures, bool names) {
    json::Array items;
    for (const auto& figure : figures) {
        json::Object item{{"name", figure.name},           {"prefab", figure.prefab},
                          {"particles", figure.particles}, {"mass", figure.mass},
                          {"islands", figure.islands},     {"constraints", in_json(figure.constraints)}};
        if (names) {
            item.push_back({"particle_names", in_json(figure.particle_names)});
            item.push_back({"constraint_names", in_json(figure.constraint_names)});
        }
        items.push_back(std::move(item));
    }
    return items;
}

/// Two columns of values beside the names.
Rows side_by_side(const Rows& before, const Rows& after) {
    Rows rows{{"", "at the start", "then"}};
    for (std::size_t i = 0; i < before.size(); ++i) rows.push_back({before[i][0], before[i][1], after[i][1]});
    return rows;
}

/// Findings about a scene: its parts and rig at the start, and its state at the start and some seconds later.
struct Findings {
    std::vector<FigureSummary> figures;
    std::vector<RigFault> faults;
    KindCounts kinds;
    std::size_t pins = 0;
    Report before, after;
};

Findings findings_of(const std::string& name, std::optional<double> seconds, Run& run) {
    const auto& scene = run.session.scene();
    Findings found{.figures = figures_of(run.session.world()),
                   .faults = rig_of(run.session.world()),
                   .kinds = constraints_of(run.session.world()),
                   .pins = pins_of(run.session.world()),
                   .before = run.session.report(),
                   .after = {}};
    const auto steps = steps_until(scene, seconds.value_or(scene.seconds));
    {
        canvas::Progress progress(title_of(name), std::size_t(steps));
        run.advance(steps, progress);
    }
    found.after = run.session.report();
    count_islands(run.session.world(), found.figures);
    return found;
}

json::Object findings_json(const std::string& name, const Scene& scene, const Findings& found, bool names) {
    auto object = scene_json(name, scene);
    object.push_back({"about", scene.about});
    object.push_back({"figures", figures_json(found.figures, names)});
    object.push_back({"rig", rig_json(found.faults)});
    object.push_back({"constraints", in_json(found.kinds)});
    object.push_back({"pins", found.pins});
    object.push_back({"forces", in_json(forces_of(scene))});
    object.push_back({"events", scene.events.size()});
    object.push_back({"start", report_json(found.before)});
    object.push_back({"then", report_json(found.after)});
    return object;
}

std::string findings_text(const std::string& name, const Scene& scene, const Findings& found, bool names) {
    const auto chapter = [](std::string_view title, const std::string& text) {
        return fmt::format("\n{}\n{}", bold(title), text);
    };
    auto text = fmt::format("{} {}\n", bold(name), scene_text(scene));
    if (!scene.about.empty()) text += scene.about + "\n";
    text += chapter("figures", figures_text(found.figures, scene));
    text += chapter("rig", rig_text(found.faults));
    text += chapter("world", table({{"constraints", in_words(found.kinds)},
                                    {"pins", std::to_string(found.pins)},
                                    {"forces", joined(forces_of(scene))},
                                    {"bounds", bounds_of(scene)},
                                    {"events", std::to_string(scene.events.size())}}));
    text += chapter("state", table(side_by_side(report_rows(found.before, scene), report_rows(found.after, scene))));
    if (names) text += chapter("names", names_text(found.figures));
    return text;
}

class InfoCommand final : public Command {
    Manual manual() const override {
        return {
            .name = "info",
            .usage = "SCENE [--seconds S] [--names] [--json] [key=value...]",
            .about = "tells what is in a scene: figures, constraints, forces, energy, stretch",
            .details =
                "Energy, stretch and speed are told as they are at the start and after some seconds; so is into\n"
                "how many islands a figure has fallen that was cut or torn. What is wrong with the rig as it\n"
                "starts is listed by name: limits that nothing can meet or that the pose breaks, lengths that\n"
                "cannot all be, loops that nothing can move.\n",
            .examples = "sinew info ragdoll\n"
                        "sinew info ragdoll --names                what events and pins can refer to\n"
                        "sinew info cloth_wind --seconds 1 mode=classic\n",
        };
    }

    void declare(CLI::App& parser) override {
        declare_scene(parser, words);
        declare_number(parser, "-s,--seconds", seconds, possible_seconds, "S",
                       "when it is looked at again; else when the scene says it is over");
        declare_flag(parser, "--names", names, "names of all particles and constraints");
        declare_flag(parser, "--json", as_json, "one line of JSON");
    }

    int run() override {
        Run run(open_file(words.scene, words.overrides));
        canvas::catch_interrupts();
        const auto& scene = run.session.scene();
        const auto found = findings_of(words.scene, seconds, run);
        print(as_json ? to_line(findings_json(words.scene, scene, found, names))
                      : findings_text(words.scene, scene, found, names));
        return done;
    }

    SceneWords words;
    std::optional<double> seconds;
    bool names = false, as_json = false;
};

} // namespace

std::unique_ptr<Command> command::info() {
    return std::make_unique<InfoCommand>();
}

} // namespace sinew::cli
