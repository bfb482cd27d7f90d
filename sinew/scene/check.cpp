#include "sinew/scene/check.h"

#include "sinew/math/color.h"
#include "sinew/scene/types.h"
#include "sinew/solver/edit.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <set>
#include <span>

namespace sinew {
namespace {

std::string under(std::string_view list, std::size_t index, std::string_view key = {}) {
    return key.empty() ? fmt::format("/{}/{}", list, index) : fmt::format("/{}/{}/{}", list, index, key);
}

/// Whether one of the names stands for many particles.
bool has_star(std::span<const std::string> names) {
    return std::ranges::any_of(names, [](const std::string& name) { return name.ends_with('*'); });
}

Sizes sizes_of(const FigureSection& figure) {
    Sizes sizes;
    detail::visit_held(figure.made, [&](const auto& made) {
        if constexpr (requires { made.sizes(); })
            sizes = made.sizes();
        else
            for (sizes.particles = made.particles.size(); const auto& constraint : made.constraints)
                sizes.constraints += has_star(constraint.between) ? sizes.particles : 1;
    });
    return sizes;
}

class ValueCheck {
  public:
    ValueCheck(const Scene& scene, Document& document) : scene_(scene), document_(document) {}

    void run() {
        names();
        sizes();
        for (std::size_t i = 0; i < scene_.figures.size(); ++i) figure(scene_.figures[i], i);
        for (std::size_t i = 0; i < scene_.constraints.size(); ++i)
            constraint(scene_.constraints[i], under("constraints", i));
        for (std::size_t i = 0; i < scene_.looks.size(); ++i)
            look(scene_.looks[i].second, "/looks" + json::pointer_step(scene_.looks[i].first));
        bounds();
        for (std::size_t i = 0; i < scene_.pins.size(); ++i)
            detail::visit_held(scene_.pins[i].driver, [&](const auto& driver) {
                if constexpr (requires { driver.keys; }) keys(driver.keys, under("pins", i, "keys"));
            });
        for (std::size_t i = 0; i < scene_.events.size(); ++i) event(scene_.events[i], i);
    }

  private:
    const Scene& scene_;
    Document& document_;

    void names() {
        std::set<std::string_view> seen;
        for (std::size_t i = 0; i < scene_.figures.size(); ++i) {
            const auto name = name_of(scene_.figures[i]);
            const auto place = under("figures", i, scene_.figures[i].name.empty() ? "" : "name");
            if (name.find('/') != std::string_view::npos)
                document_.error(place, fmt::format("a figure's name cannot contain a slash, found \"{}\"", name));
            if (!seen.insert(name).second)
                document_.error(place, fmt::format("there is already a figure called \"{}\"", name),
                                "give each figure its own \"name\"");
        }
    }

    void sizes() {
        const auto& limits = document_.limits;
        count(std::int64_t(scene_.figures.size()), limits.figures, "figures", "/figures");
        count(std::int64_t(scene_.events.size()), limits.events, "events", "/events");
        Sizes sum;
        std::map<std::string_view, std::size_t> particles; // what a star can stand for
        for (const auto& figure : scene_.figures)
            particles[name_of(figure)] = std::min(sizes_of(figure).particles, std::size_t(1e12));
        const auto most = [&](const std::string_view name) {
            const auto found = particles.find(name.substr(0, name.find('/')));
            return name.ends_with('*') && found != particles.end() ? found->second : 1;
        };
        for (const auto& constraint : scene_.constraints) {
            std::size_t many = 1;
            for (const auto& name : constraint.between) many = std::max(many, most(name));
            sum.constraints += many;
        }
        for (const auto& pin : scene_.pins)
            if (pin.particle.ends_with('*')) sum.constraints += most(pin.particle);
        for (std::size_t i = 0; i < scene_.figures.size(); ++i) {
            const auto sizes = sizes_of(scene_.figures[i]);
            sum.particles += sizes.particles;
            sum.constraints += sizes.constraints;
            if (count(std::int64_t(sum.particles), limits.particles, "particles", under("figures", i)) ||
                count(std::int64_t(sum.constraints), limits.constraints, "constraints", under("figures", i)))
                return;
        }
    }

    /// Whether there are too many.
    bool count(std::int64_t found, std::int64_t allowed, std::string_view what, std::string place) {
        if (found <= allowed) return false;
        document_.error(std::move(place),
                        fmt::format("the scene would have {} {}, at most {} are allowed", found, what, allowed),
                        fmt::format("if you trust the file, raise the limit: limits.{}={}", what, found));
        return true;
    }

    void figure(const FigureSection& figure, std::size_t i) {
        detail::visit_held(figure.made, [&](const auto& made) {
            if constexpr (requires { made.dimensions; }) {
                if (!made.dimensions.include(scene_.dimension))
                    return document_.error(
                        under("figures", i, "prefab"),
                        fmt::format("a {} does not exist in {} dimensions", made.name, scene_.dimension));
            }
            if constexpr (requires { made.problem(scene_.dimension); })
                if (const auto problem = made.problem(scene_.dimension)) document_.error(under("figures", i), *problem);
        });
        if (const auto* by_hand = std::get_if<ByHand>(&figure.made)) {
            for (std::size_t k = 0; k < by_hand->constraints.size(); ++k)
                constraint(by_hand->constraints[k], under("figures", i) + under("constraints", k));
            for (std::size_t k = 0; k < by_hand->pieces.size(); ++k)
                piece(by_hand->pieces[k], under("figures", i) + under("pieces", k));
        }
        for (const auto& [part, seen] : figure.looks)
            look(seen, under("figures", i, "looks") + json::pointer_step(part));
    }

    /// How many particles a mark is drawn through, in the order of mark_names.
    void piece(const PieceSection& section, const std::string& place) {
        constexpr std::array<std::array<std::size_t, 2>, mark_names.size()> counts = {
            {{2, 1000}, {2, 1000}, {2, 1000}, {2, 1000}, {3, 1000}, {2, 2}, {1, 1000}, {3, 1000}, {4, 4}, {1, 4}}};
        const auto mark = std::find(mark_names.begin(), mark_names.end(), section.mark) - mark_names.begin();
        const auto [least, most] = counts[std::size_t(mark)];
        const auto found = section.through.size();
        if (found < least || found > most)
            document_.error(place + "/through",
                            fmt::format("a {} goes through {}{} particles, found {}", section.mark,
                                        least == most ? "" : fmt::format("{} to ", least), most, found));
        if (section.end_width > 0 && section.width == 0)
            document_.error(place + "/end_width", "an end_width needs a width to begin with");
    }

    void event(const EventSection& section, std::size_t i) {
        const double step = step_length(scene_);
        if (section.times > 0 && section.every == 0)
            document_.error(under("events", i, "times"), "what happens several times needs an \"every\"");
        if (section.every > 0 && section.every < step * 0.999)
            document_.error(under("events", i, "every"),
                            fmt::format("{} is shorter than a step, {:.6g}", section.every, step));
        if (const auto* join = std::get_if<JoinEvent>(&section.event))
            constraint(join->constraint, under("events", i), "join");
    }

    void constraint(const ConstraintSection& section, const std::string& place, std::string_view members = "between") {
        const auto between = fmt::format("{}/{}", place, members);
        if (section.rest && (section.low || section.high))
            document_.error(place + "/rest", "a constraint has either a rest or limits low and high, not both");
        if (section.low && section.high && *section.low > *section.high)
            document_.error(place + "/low", fmt::format("low ({}) is above high ({})", *section.low, *section.high));
        const auto size = section.between.size();
        const auto wanted = arity(section.kind);
        const bool any = section.kind == "area" || section.kind == "pulley";
        if (any ? size < wanted : size != wanted)
            document_.error(between, fmt::format("{} {} needs {}{} particles, found {}",
                                                 section.kind == "angle" || section.kind == "area" ? "an" : "a",
                                                 section.kind, any ? "at least " : "", wanted, size));
        if (section.lead > 0 && section.compliance == 0)
            document_.error(place + "/lead",
                            "only a constraint with a compliance has a lead: a rigid one has nothing to damp");
        if (section.drive) keys(section.drive->keys, place + "/drive/keys");
        if (std::ranges::count_if(section.between, [](const auto& name) { return name.ends_with('*'); }) > 1)
            document_.error(between, "one of the names can end in a star, not more");
        std::set<std::string_view> seen;
        for (const auto& name : section.between)
            if (!seen.insert(name).second) document_.error(between, fmt::format("\"{}\" is named twice", name));
        const bool exists = scene_.dimension == 2 ? section.kind != "volume" && section.kind != "dihedral"
                                                  : section.kind != "area" && section.kind != "rail";
        if (!exists)
            document_.error(place + "/kind",
                            fmt::format("there is no {} in {} dimensions", section.kind, scene_.dimension));
    }

    static std::size_t arity(std::string_view kind) {
        if (kind == "distance") return 2;
        return kind == "volume" || kind == "dihedral" ? 4 : 3;
    }

    void look(const Look& look, const std::string& place) {
        for (const auto& [key, text] :
             {std::pair("/color", look.color), std::pair("/fill", look.fill), std::pair("/hover", look.hover)})
            if (!text.empty() && !parse_color(text) && std::ranges::find(theme_colors, text) == theme_colors.end())
                document_.error(place + key, fmt::format("\"{}\" is no colour", text),
                                "a name such as tomato or teal, ink or paper, #rgb, #rrggbb, #rrggbbaa or none");
    }

    template <class Key> void keys(const std::vector<Key>& keys, const std::string& place) {
        for (std::size_t i = 1; i < keys.size(); ++i)
            if (keys[i].at <= keys[i - 1].at)
                document_.error(
                    fmt::format("{}/{}/at", place, i),
                    fmt::format("{} is not after {}, the time of the key before it", keys[i].at, keys[i - 1].at));
    }

    void bounds() {
        if (!scene_.world.bounds) return;
        if (const auto& box = scene_.world.bounds->box)
            for (int k = 0; k < scene_.dimension; ++k)
                if ((*box)[0][k] == (*box)[1][k])
                    document_.error("/world/bounds/box", "the corners of the box have no room between them");
        const auto& planes = scene_.world.bounds->planes;
        for (std::size_t i = 0; i < planes.size(); ++i)
            if (planes[i].normal == Point{})
                document_.error(under("world/bounds/planes", i, "normal"), "a normal needs a length");
    }
};

/// Checks references against the world they are made to.
template <int D, class Real> class ReferenceCheck {
  public:
    ReferenceCheck(const Scene& scene, const World<D, Real>& world, Document& document)
        : scene_(scene), world_(world), document_(document) {}

    void run() {
        for (std::size_t i = 0; i < scene_.constraints.size(); ++i)
            for (std::size_t k = 0; k < scene_.constraints[i].between.size(); ++k)
                particle(scene_.constraints[i].between[k], under("constraints", i, "between") + under("", k).substr(1));
        for (std::size_t i = 0; i < scene_.pins.size(); ++i)
            particle(scene_.pins[i].particle, under("pins", i, "particle"));
        for (std::size_t i = 0; i < scene_.figures.size(); ++i) figure(scene_.figures[i], i);
        for (std::size_t i = 0; i < scene_.looks.size(); ++i) look(scene_.looks[i].first);
        for (std::size_t i = 0; i < scene_.events.size(); ++i)
            detail::visit_held(scene_.events[i].event, [&](const auto& event) { this->event(event, i); });
    }

  private:
    const Scene& scene_;
    const World<D, Real>& world_;
    Document& document_;

    std::vector<std::string_view> figure_names() const {
        std::vector<std::string_view> names;
        for (const auto& figure : world_.figures) names.push_back(figure.name);
        return names;
    }

    void unknown(std::string_view what, std::string_view name, const std::string& place,
                 std::vector<std::string_view> candidates) {
        constexpr std::size_t most_listed = 40;
        const auto help = candidates.size() <= most_listed
                              ? suggest(name, std::move(candidates))
                              : fmt::format("there are {}, such as \"{}\" and \"{}\"", candidates.size(),
                                            candidates.front(), candidates.back());
        document_.error(place, fmt::format("there is no {} \"{}\"", what, name), help);
    }

    /// A name "figure/rest"; reports what of it does not exist. `names` lists what the figure has.
    template <class Names>
    void path(std::string_view what, std::string_view path, const std::string& place, bool found, Names&& names) {
        if (found) return;
        if (document_.diagnostics.full()) return document_.diagnostics.count_one_more();
        const auto slash = path.find('/');
        if (slash == std::string_view::npos)
            return document_.error(place, fmt::format("expected a {} as figure/name, found \"{}\"", what, path),
                                   suggest(path, figure_names()));
        const auto index = find_figure(world_, path.substr(0, slash));
        if (!index) return unknown("figure", path.substr(0, slash), place, figure_names());
        unknown(fmt::format("{} in \"{}\" called", what, path.substr(0, slash)), path.substr(slash + 1), place,
                names(world_.figures[*index]));
    }

    void particle(std::string_view name, const std::string& place) {
        path("particle", name, place, !find_particles(world_, name).empty(), [](const Figure& figure) {
            std::vector<std::string_view> names;
            for (const auto& named : figure.particle_names) names.emplace_back(named.first);
            return names;
        });
    }

    void constraint(std::string_view name, const std::string& place) {
        path("constraint", name, place, find_constraint(world_, name).has_value(), [](const Figure& figure) {
            std::vector<std::string_view> names;
            for (const auto& named : figure.constraint_names) names.emplace_back(named.first);
            return names;
        });
    }

    void figure(const FigureSection& section, std::size_t i) {
        const auto& built = world_.figures[i];
        for (const auto& [name, kick] : section.kicks)
            particle(built.name + "/" + name, under("figures", i, "kicks") + json::pointer_step(name));
        for (const auto& [part, seen] : section.looks)
            if (part != "all" && !has_part(built, part) && !is_joined_later(built.name + "/" + part))
                unknown("part", part, under("figures", i, "looks") + json::pointer_step(part), parts_of(built));
        const auto* by_hand = std::get_if<ByHand>(&section.made);
        if (!by_hand) return;
        for (std::size_t k = 0; k < by_hand->constraints.size(); ++k)
            for (std::size_t m = 0; m < by_hand->constraints[k].between.size(); ++m)
                particle_seen_from(i, by_hand->constraints[k].between[m],
                                   under("figures", i) + under("constraints", k) + fmt::format("/between/{}", m));
        for (std::size_t k = 0; k < by_hand->pieces.size(); ++k)
            for (std::size_t m = 0; m < by_hand->pieces[k].through.size(); ++m)
                particle_seen_from(i, by_hand->pieces[k].through[m],
                                   under("figures", i) + under("pieces", k) + fmt::format("/through/{}", m));
    }

    /// Inside a figure: one of its own, or as figure/name one of a figure before it.
    void particle_seen_from(std::size_t i, std::string_view name, const std::string& place) {
        particle(full_name(name, world_.figures[i].name + "/"), place);
        const auto index = find_figure(world_, name.substr(0, std::min(name.find('/'), name.size())));
        if (name.find('/') != std::string_view::npos && index && *index > i)
            document_.error(place, fmt::format("\"{}\" is of a figure that is made later", name),
                            "figures are made in their order: put the one that joins others behind them");
    }

    /// Whether an event makes a constraint of that full name.
    bool is_joined_later(std::string_view path) const {
        return std::ranges::any_of(scene_.events, [&](const EventSection& section) {
            const auto* join = std::get_if<JoinEvent>(&section.event);
            if (!join || join->constraint.name.empty() || join->constraint.between.empty()) return false;
            const std::string_view first = join->constraint.between.front();
            const auto figure = first.substr(0, first.find('/') + 1);
            return path.starts_with(figure) && path.substr(figure.size()) == join->constraint.name;
        });
    }

    static bool has_part(const Figure& figure, std::string_view part) {
        return std::any_of(figure.pieces.begin(), figure.pieces.end(),
                           [&](const Piece& piece) { return piece.part == part; });
    }

    static std::vector<std::string_view> parts_of(const Figure& figure) {
        std::vector<std::string_view> parts;
        for (const auto& piece : figure.pieces)
            if (std::find(parts.begin(), parts.end(), piece.part) == parts.end()) parts.emplace_back(piece.part);
        return parts;
    }

    /// A key of "looks": figure/part, figure, or the part of any figure.
    void look(std::string_view key) {
        const auto place = "/looks" + json::pointer_step(key);
        const auto slash = key.find('/');
        if (slash != std::string_view::npos) {
            const auto index = find_figure(world_, key.substr(0, slash));
            if (!index) return unknown("figure", key.substr(0, slash), place, figure_names());
            if (!has_part(world_.figures[*index], key.substr(slash + 1)))
                unknown("part", key.substr(slash + 1), place, parts_of(world_.figures[*index]));
            return;
        }
        if (find_figure(world_, key)) return;
        auto candidates = figure_names();
        for (const auto& figure : world_.figures) {
            if (has_part(figure, key)) return;
            for (const auto part : parts_of(figure))
                if (std::find(candidates.begin(), candidates.end(), part) == candidates.end())
                    candidates.push_back(part);
        }
        unknown("figure or part", key, place, std::move(candidates));
    }

    void event(const GrabEvent& grab, std::size_t i) { particle(grab.particle, under("events", i, "grab")); }
    void event(const ReleaseEvent& release, std::size_t i) {
        particle(release.particle, under("events", i, "release"));
    }
    void event(const ImpulseEvent& impulse, std::size_t i) {
        if (!find_figure(world_, impulse.target)) particle(impulse.target, under("events", i, "impulse"));
    }
    void event(const KickEvent& kick, std::size_t i) { particle(kick.target, under("events", i, "kick")); }
    void event(const JoinEvent& join, std::size_t i) {
        for (std::size_t k = 0; k < join.constraint.between.size(); ++k)
            particle(join.constraint.between[k], under("events", i, "join") + fmt::format("/{}", k));
    }
    void event(const SnipEvent& snip, std::size_t i) {
        for (std::size_t k = 0; k < snip.constraints.size(); ++k)
            if (!is_joined_later(snip.constraints[k]))
                constraint(snip.constraints[k], under("events", i, "snip") + fmt::format("/{}", k));
    }
    template <class Event> void event(const Event&, std::size_t) {}
};

} // namespace

std::string_view name_of(const FigureSection& figure) {
    if (!figure.name.empty()) return figure.name;
    std::string_view name;
    detail::visit_held(figure.made, [&](const auto& made) { name = made.name; });
    return name;
}

std::string full_name(std::string_view name, std::string_view prefix) {
    return name.find('/') == std::string_view::npos ? concat(prefix, name) : std::string(name);
}

void check_values(const Scene& scene, Document& document) {
    ValueCheck(scene, document).run();
}

void check_references(const Scene& scene, const AnyWorld& world, Document& document) {
    std::visit([&](const auto& w) { ReferenceCheck(scene, w, document).run(); }, world);
}

} // namespace sinew
