#include "sinew/math/format.h"
#include "sinew/scene/check.h"
#include "sinew/scene/check_constraint.h"
#include "sinew/scene/types.h"
#include "sinew/world/colliders.h"
#include "sinew/world/edit.h"

#include <algorithm>
#include <map>
#include <span>

namespace sinew {
namespace {

/// Checks the references of a scene against the built world.
template <int D, class Real> class ReferenceCheck {
  public:
    ReferenceCheck(const Scene& scene, const World<D, Real>& world, Document& document,
                   std::span<const std::string> incomplete)
        : scene_(scene), world_(world), document_(document), incomplete_(incomplete) {}

    void run() {
        for (std::size_t i = 0; i < scene_.constraints.size(); ++i)
            for (std::size_t k = 0; k < scene_.constraints[i].between.size(); ++k)
                particle(scene_.constraints[i].between[k], under("constraints", i, "between") + under("", k).substr(1));
        for (std::size_t i = 0; i < scene_.pins.size(); ++i)
            particle(scene_.pins[i].particle, under("pins", i, "particle"));
        pins();
        for (std::size_t i = 0; i < scene_.pairs.size(); ++i) pair(scene_.pairs[i], i);
        for (std::size_t i = 0; i < scene_.figures.size(); ++i) figure(scene_.figures[i], i);
        for (std::size_t i = 0; i < scene_.looks.size(); ++i) check_look(scene_.looks[i].first);
        for (std::size_t i = 0; i < scene_.events.size(); ++i) event(scene_.events[i], i);
        for (std::size_t i = 0; i < scene_.traces.size(); ++i)
            if (const auto& of = scene_.traces[i].of; !find_figure(world_, of)) particle(of, under("traces", i, "of"));
        for (std::size_t i = 0; i < scene_.world.forces.size(); ++i)
            if (const auto* attractor = std::get_if<AttractorForce>(&scene_.world.forces[i].force))
                pulled(attractor->figure, "/world" + under("forces", i, "figure"));
    }

  private:
    const Scene& scene_;
    const World<D, Real>& world_;
    Document& document_;
    std::span<const std::string> incomplete_;
    std::map<std::string, std::size_t, std::less<>> repeated_; ///< numbers of constraints by full name, once asked for

    bool is_incomplete(std::string_view figure) const {
        return std::ranges::find(incomplete_, figure) != incomplete_.end();
    }
    void unknown_figure(std::string_view name, const std::string& place) {
        if (!is_incomplete("")) unknown("figure", name, place, figure_names());
    }

    std::vector<std::string_view> figure_names() const {
        std::vector<std::string_view> names;
        for (const auto& figure : world_.figures) names.push_back(figure.name);
        return names;
    }

    void add_colliders(std::vector<std::string_view>& names) const {
        for (const auto& collider : world_.colliders)
            if (!collider.name.empty()) names.emplace_back(collider.name);
    }

    /// Reports an unknown name. `also` lists further valid names that cannot serve as candidates for a suggestion.
    void unknown(std::string_view what, std::string_view name, const std::string& place,
                 std::vector<std::string_view> candidates, const std::string& also = {}) {
        constexpr std::size_t max_listed = 40;
        std::string help;
        if (candidates.size() > max_listed)
            help = format_text("there are {}, such as \"{}\" and \"{}\"", candidates.size(), candidates.front(),
                               candidates.back());
        else if (!candidates.empty() || also.empty())
            help = suggest(name, std::move(candidates));
        document_.error(place, format_text("there is no {} \"{}\"", what, name),
                        help + (help.empty() || also.empty() ? "" : "; ") + also);
    }

    /// "by number: joint_0 to joint_19, end_0 to end_5"
    static std::string numbers_text(std::span<const Numbered> numbered) {
        std::string text;
        for (const auto& run : numbered)
            if (run.count > 0)
                text += format_text("{} {} to {}", text.empty() ? "by number:" : ",",
                                    name_of(run.first, std::span(&run, 1)),
                                    name_of(run.first + run.count - 1, std::span(&run, 1)));
        return text;
    }

    template <class Id> static std::vector<std::string_view> given_in(const NameTable<Id>& table) {
        std::vector<std::string_view> names;
        for (const auto& named : table) names.emplace_back(named.first);
        return names;
    }

    template <class Tell>
    void path(std::string_view what, std::string_view path, const std::string& place, bool found, Tell&& tell) {
        if (found) return;
        if (document_.diagnostics.full()) return document_.diagnostics.count_one_more();
        const auto slash = path.find('/');
        if (slash == std::string_view::npos)
            return document_.error(place, format_text("expected a {} as figure/name, found \"{}\"", what, path),
                                   full_names(what, path));
        const auto index = find_figure(world_, path.substr(0, slash));
        if (!index) return unknown_figure(path.substr(0, slash), place);
        const auto& figure = world_.figures[*index];
        if (is_incomplete(figure.name)) return;
        tell(figure, format_text("{} in \"{}\" called", what, path.substr(0, slash)), path.substr(slash + 1));
    }

    /// Help for a name without a figure: the figures that have one of that name, or else of a near one.
    std::string full_names(std::string_view what, std::string_view name) const {
        const bool particles = what == "particle";
        std::vector<std::string> full;
        constexpr std::size_t max = 1000;
        for (const auto& figure : world_.figures) {
            const auto path = concat(figure.name, "/", name);
            if (particles ? find_particle(world_, path).has_value() : find_constraint(world_, path).has_value())
                return concat("did you mean ", in_quotes(path), "?");
            const auto add = [&](std::string_view given) {
                if (full.size() < max) full.push_back(concat(figure.name, "/", given));
            };
            for (const auto given : particles ? given_in(figure.particle_names) : given_in(figure.constraint_names))
                add(given);
            for (const auto& run : particles ? figure.particle_numbers : figure.constraint_numbers)
                if (run.count > 0) add(name_of(run.first, std::span(&run, 1)));
        }
        return suggest(name, {full.begin(), full.end()});
    }

    void particle(std::string_view name, const std::string& place) {
        path("particle", name, place, !find_particles(world_, name).empty(),
             [&](const Figure& figure, const std::string& what, std::string_view unfound) {
                 unknown(what, unfound, place, given_in(figure.particle_names), numbers_text(figure.particle_numbers));
             });
    }

    /// Checks the figure of an attractor; empty stands for all figures.
    void pulled(std::string_view name, const std::string& place) {
        if (!name.empty() && !find_figure(world_, name)) unknown_figure(name, place);
    }

    /// Reports sides that are neither figures nor colliders, and pairs of two colliders.
    void pair(const PairSection& section, std::size_t i) {
        for (std::size_t k = 0; k < 2; ++k) {
            const auto& name = section.between[k];
            if (is_wall(name) || find_figure(world_, name)) continue;
            const auto place = under("pairs", i) + format_text("/between/{}", k);
            if (name.find('/') != std::string::npos)
                document_.error(place, format_text("expected a figure or a collider, found \"{}\"", name));
            else
                side(name, place);
        }
        if (is_wall(section.between[0]) && is_wall(section.between[1]))
            document_.error(under("pairs", i, "between"), "two colliders never touch each other",
                            "a pair is of two figures, or of a figure and a collider");
    }
    bool is_wall(std::string_view name) const {
        return !name.empty() && !find_figure(world_, name) &&
               (collider_called(world_, name) || (name == bounds_name && !world_.bounds.empty()));
    }

    /// Reports particles that one pin of the scene holds rigidly and another pin holds too: the later one would take
    /// them over. A pin of the figure itself is taken over without a word.
    void pins() {
        std::map<std::uint32_t, std::size_t> held; // by index of the particle: the pin that holds it
        for (std::size_t i = 0; i < scene_.pins.size(); ++i)
            for (const auto id : find_particles(world_, scene_.pins[i].particle)) {
                const auto [first, fresh] = held.try_emplace(id.index, i);
                if (fresh || first->second == i) continue;
                const auto& earlier = scene_.pins[first->second];
                if (earlier.grip.compliance > 0 || earlier.grip.max_force > 0 || earlier.steer) continue;
                document_.error(under("pins", i, "particle"),
                                format_text("\"{}\" is held by {} already, as \"{}\"", scene_.pins[i].particle,
                                            under("pins", first->second), earlier.particle),
                                "one pin holds a particle: put driver, target and grip into one of them");
                break;
            }
    }

    void constraint(std::string_view name, const std::string& place) {
        path("constraint", name, place, !find_constraints(world_, name).empty(),
             [&](const Figure& figure, const std::string& what, std::string_view unfound) {
                 unknown(what, unfound, place, given_in(figure.constraint_names),
                         numbers_text(figure.constraint_numbers));
             });
    }

    /// Checks a constraint changed by an event: one name, without a star, means one constraint. Repeated removals take
    /// one after the other.
    void changed_constraint(const std::string& name, const std::string& place, bool is_each_in_turn) {
        if (is_joined_later(name)) return;
        constraint(name, place);
        if (is_each_in_turn) return;
        if (repeated_.empty()) find_repeated();
        const auto count = repeated_.find(name);
        if (count == repeated_.end() || count->second < 2) return;
        document_.error(
            place,
            format_text("there are {} constraints {}, of which the event would reach one", count->second,
                        in_quotes(name)),
            concat("give each its own \"name\", or write ", in_quotes(name + "*"), " for all whose names begin so"));
    }
    /// Counts the constraints of each full name given.
    void find_repeated() {
        repeated_.try_emplace("");
        for (const auto& figure : world_.figures)
            for (const auto& [name, id] : figure.constraint_names) ++repeated_[concat(figure.name, "/", name)];
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
                                   under("figures", i) + under("constraints", k) + format_text("/between/{}", m));
        for (std::size_t k = 0; k < by_hand->pieces.size(); ++k)
            for (std::size_t m = 0; m < by_hand->pieces[k].through.size(); ++m)
                particle_seen_from(i, by_hand->pieces[k].through[m],
                                   under("figures", i) + under("pieces", k) + format_text("/through/{}", m));
    }

    /// Checks a particle's name inside figure i: a particle of the figure itself, or figure/name of an earlier figure.
    void particle_seen_from(std::size_t i, std::string_view name, const std::string& place) {
        particle(full_name(name, world_.figures[i].name + "/"), place);
        const auto index = find_figure(world_, name.substr(0, std::min(name.find('/'), name.size())));
        if (name.find('/') != std::string_view::npos && index && *index > i)
            document_.error(place, format_text("\"{}\" is of a figure that is made later", name),
                            "figures are made in their order: put the one that joins others behind them");
    }

    /// True if an event adds a constraint of that full name.
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

    /// Checks a key of "looks": figure/part, figure, collider, or a part of any figure.
    void check_look(std::string_view key) {
        const auto place = "/looks" + json::pointer_step(key);
        const auto slash = key.find('/');
        if (slash != std::string_view::npos) {
            const auto index = find_figure(world_, key.substr(0, slash));
            if (!index) return unknown_figure(key.substr(0, slash), place);
            if (!is_incomplete(world_.figures[*index].name) && !has_part(world_.figures[*index], key.substr(slash + 1)))
                unknown("part", key.substr(slash + 1), place, parts_of(world_.figures[*index]));
            return;
        }
        if (find_figure(world_, key) || collider_called(world_, key) || !incomplete_.empty()) return;
        auto candidates = figure_names();
        add_colliders(candidates);
        for (const auto& figure : world_.figures) {
            if (has_part(figure, key)) return;
            for (const auto part : parts_of(figure))
                if (std::find(candidates.begin(), candidates.end(), part) == candidates.end())
                    candidates.push_back(part);
        }
        unknown("figure, collider or part", key, place, std::move(candidates));
    }

    void event(const EventSection& section, std::size_t i) {
        detail::visit_held(section.event, [&](const auto& event) { this->event(event, i); });
        if (!section.on) return;
        const auto place = under("events", i, "on");
        if (!find_figure(world_, section.on->of)) particle(section.on->of, place + "/of");
        const auto& with = section.on->with;
        const bool is_bounds = with == bounds_name && !world_.bounds.empty();
        if (!with.empty() && !is_bounds && !collider_called(world_, with) && !find_figure(world_, with))
            side(with, place + "/with");
    }
    /// Reports a name of no particle, no figure and no collider.
    void side(const std::string& name, const std::string& place) {
        if (name.find('/') != std::string::npos) return particle(name, place);
        if (is_incomplete("")) return;
        auto candidates = figure_names();
        add_colliders(candidates);
        unknown("collider or figure", name, place, std::move(candidates));
    }
    void event(const GrabEvent& grab, std::size_t i) { particle(grab.particle, under("events", i, "grab")); }
    void event(const ReleaseEvent& release, std::size_t i) {
        particle(release.particle, under("events", i, "release"));
    }
    void event(const ImpulseEvent& impulse, std::size_t i) {
        const auto place = under("events", i, "impulse");
        if (find_figure(world_, impulse.target)) return;
        if (impulse.target.find('/') == std::string::npos) return unknown_figure(impulse.target, place);
        particle(impulse.target, place);
    }
    void event(const KickEvent& kick, std::size_t i) { particle(kick.target, under("events", i, "kick")); }
    void event(const JoinEvent& join, std::size_t i) {
        for (std::size_t k = 0; k < join.constraint.between.size(); ++k)
            particle(join.constraint.between[k], under("events", i, "join") + format_text("/{}", k));
    }
    void event(const AdjustEvent& adjust, std::size_t i) {
        for (std::size_t k = 0; k < adjust.constraints.size(); ++k)
            changed_constraint(adjust.constraints[k], under("events", i, "adjust") + format_text("/{}", k), false);
        if (!adjust.has_values())
            document_.error(under("events", i, "adjust"), "an adjust without new values",
                            "say rest, low, high, compliance, max_force, breaking_strain or break_force");
        for (const auto& name : adjust.constraints)
            for (const auto& id : find_constraints(world_, name))
                return check_signs(kinds_in<D>[id.kind], D, adjust, under("events", i), document_);
    }
    void event(const ResizeEvent& resize, std::size_t i) { particle(resize.particles, under("events", i, "resize")); }
    void event(const RemoveEvent& removal, std::size_t i) {
        for (std::size_t k = 0; k < removal.names.size(); ++k) {
            const auto& name = removal.names[k];
            const auto place = under("events", i, "remove") + format_text("/{}", k);
            if (name.find('/') == std::string::npos) {
                if (!find_figure(world_, name) && !collider_called(world_, name)) side(name, place);
            } else {
                changed_constraint(name, place, scene_.events[i].every > 0 || scene_.events[i].on);
            }
        }
    }
    void event(const AddEvent& more, std::size_t i) {
        if (!find_figure(world_, more.figure)) unknown_figure(more.figure, under("events", i, "add"));
    }
    void event(const SteerEvent& steer, std::size_t i) {
        const auto place = under("events", i, "steer");
        const auto found =
            std::ranges::find(scene_.figures, steer.figure, [](const auto& one) { return name_of(one); });
        if (found == scene_.figures.end()) return unknown_figure(steer.figure, place);
        bool can = false;
        detail::visit_held(found->made, [&]<class Made>(const Made&) {
            can = std::is_same_v<Made, Character> || std::is_same_v<Made, Car>;
        });
        if (!can)
            document_.error(place, format_text("\"{}\" has no controls", steer.figure),
                            "an event steers figures of the prefabs character and car");
        if (scene_.events[i].on) document_.error(place, "a contact does not steer", "give the event a time: \"at\"");
    }
    void event(const ColliderEvent& change, std::size_t i) {
        const auto place = under("events", i, "collider");
        const auto section = std::ranges::find(scene_.colliders, change.collider, &ColliderSection::name);
        if (section == scene_.colliders.end() || change.collider.empty()) {
            std::vector<std::string_view> names;
            for (const auto& one : scene_.colliders)
                if (!one.name.empty()) names.emplace_back(one.name);
            return unknown("collider", change.collider, place, std::move(names));
        }
        if (section->motion && (change.to || change.turn))
            document_.error(place, format_text("\"{}\" has a motion of its own", change.collider),
                            "an event moves what has none");
    }
    template <class Event> void event(const Event&, std::size_t) {}
};

} // namespace

void check_references(const Scene& scene, const AnyWorld& world, Document& document,
                      std::span<const std::string> incomplete) {
    std::visit([&](const auto& w) { ReferenceCheck(scene, w, document, incomplete).run(); }, world);
}

} // namespace sinew
