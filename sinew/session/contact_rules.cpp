#include "sinew/session/contact_rules.h"

#include "sinew/math/sort.h"
#include "sinew/world/edit.h"

#include <algorithm>
#include <optional>
#include <tuple>

namespace sinew {
namespace {

/// One side of a contact.
struct Side {
    FigureIndex figure = no_figure;
    std::optional<ParticleId> particle{};
    std::string_view collider{};
    bool is_collider = false;
};

/// Touch of a figure, or of a single particle, and a collider.
struct WallTouch {
    Side side;
    std::uint32_t particle = 0, collider = 0; ///< slots
    TouchStrength strength{};

    auto pair() const { return std::tie(side.figure, collider); }
    bool is_of_same(const WallTouch& other) const { return side.figure != no_figure && pair() == other.pair(); }
    /// Takes in a touch of another particle: impulses add up.
    void unite(const WallTouch& other) {
        strength.impulse += other.strength.impulse;
        strength.blow += other.strength.blow;
        strength.blow_before += other.strength.blow_before;
        strength.is_new = strength.is_new && other.strength.is_new;
    }
};

/// Contacts of the last step that fulfil one rule. All particles of a figure make one contact with a collider, unless
/// the rule names a particle.
template <class WorldT> class RuleMatch {
  public:
    RuleMatch(const WorldT& world, const ContactRule& rule) : world_(world), rule_(rule) {}

    /// The strongest; nothing if no contact fulfils the rule.
    std::optional<RuleMet> find() {
        if (rule_.phase == "end") {
            for (const auto& event : world_.events)
                if (event.type == EventType::parted && !goes_on(event))
                    consider(side_of(event), other_side_of(event), {});
            return best_;
        }
        for (const auto& touch : wall_touches())
            if (counts(touch.strength)) consider(touch.side, collider_at(touch.collider), touch.strength);
        for (const auto& touch : world_.contacts.figures)
            if (counts(touch.strength))
                consider(figure_at(touch.first, touch.particle[0]), figure_at(touch.second, touch.particle[1]),
                         touch.strength);
        return best_;
    }

  private:
    const WorldT& world_;
    const ContactRule& rule_;
    std::optional<RuleMet> best_;

    std::vector<WallTouch> wall_touches() const {
        std::vector<WallTouch> touches;
        for (const auto& touch : world_.contacts.touching)
            touches.push_back({particle_at(touch.particle), touch.particle, touch.collider, touch.strength});
        if (is_particle(rule_.of) || is_particle(rule_.with)) return touches;
        sinew::sort(touches.begin(), touches.end(), [](const WallTouch& a, const WallTouch& b) {
            return std::tuple_cat(a.pair(), std::tie(a.particle)) < std::tuple_cat(b.pair(), std::tie(b.particle));
        });
        std::size_t count = 0;
        for (const auto& touch : touches)
            if (count > 0 && touches[count - 1].is_of_same(touch))
                touches[count - 1].unite(touch);
            else
                touches[count++] = touch;
        touches.resize(count);
        for (auto& touch : touches) touch.strength.is_new = touch.strength.is_new && !was_before(touch);
        return touches;
    }
    /// True if the figure has left the collider with another particle, in the step in which it touches with this one.
    bool was_before(const WallTouch& touch) const {
        return touch.side.figure != no_figure && std::ranges::any_of(world_.events, [&](const Event& event) {
                   return event.type == EventType::parted && event.figure == touch.side.figure &&
                          slot_of(event.collider) == touch.collider;
               });
    }
    /// True if the figure still touches the collider that one of its particles has left.
    bool goes_on(const Event& parted) const {
        const auto slot = slot_of(parted.collider);
        if (!slot || parted.figure == no_figure || is_particle(rule_.of) || is_particle(rule_.with)) return false;
        return std::ranges::any_of(world_.contacts.touching, [&](const ColliderTouch& touch) {
            return touch.collider == *slot && particle_at(touch.particle).figure == parted.figure;
        });
    }
    /// Slot of a collider or a plane of an event; nothing where two figures touch.
    std::optional<std::uint32_t> slot_of(const ColliderId& collider) const {
        if (is_plane(collider.index)) return collider.index;
        const auto row = world_.collider_handles.find(collider);
        return row ? std::optional(world_.collider_handles.index_of(*row)) : std::nullopt;
    }
    bool is_particle(const std::string& name) const {
        return !name.empty() && !find_figure(world_, name) && find_particle(world_, name);
    }

    bool counts(const TouchStrength& touch) const {
        if (rule_.phase == "hit") return touch.is_hit(rule_.above);
        return touch.impulse >= rule_.above && touch.is_new == (rule_.phase == "begin");
    }
    void consider(const Side& one, const Side& other, const TouchStrength& touch) {
        if (is(rule_.of, one) && (rule_.with.empty() || is(rule_.with, other))) return keep(other, touch);
        if (is(rule_.of, other) && (rule_.with.empty() || is(rule_.with, one))) keep(one, touch);
    }
    void keep(const Side& with, const TouchStrength& touch) {
        const double impulse = rule_.phase == "hit" ? touch.blow : touch.impulse;
        if (!best_ || impulse > best_->impulse) best_ = {0, 0, name_of(with), impulse};
    }

    std::string name_of(const Side& side) const {
        if (side.is_collider) return std::string(side.collider);
        return side.figure < world_.figures.size() ? world_.figures[side.figure].name : "";
    }
    bool is(const std::string& name, const Side& side) const {
        if (side.is_collider) return name == side.collider;
        const auto figure = find_figure(world_, name);
        if (figure) return side.figure == *figure;
        const auto particle = find_particle(world_, name);
        return particle && side.particle == particle;
    }

    Side side_of(const Event& event) const { return {event.figure, event.particle}; }
    Side other_side_of(const Event& event) const {
        if (is_plane(event.collider.index)) return bounds();
        const auto row = world_.collider_handles.find(event.collider);
        return row ? collider_in(*row) : Side{event.other, event.other_particle};
    }
    Side figure_at(FigureIndex figure, std::uint32_t slot) const {
        const auto& handles = world_.particles.handles;
        return {figure, handles.in_use(slot) ? std::optional(handles.id_of(handles.row_at(slot))) : std::nullopt};
    }
    Side particle_at(std::uint32_t slot) const {
        const auto& handles = world_.particles.handles;
        return figure_at(handles.in_use(slot) ? world_.particles.figure[handles.row_at(slot)] : no_figure, slot);
    }
    Side collider_in(Row row) const { return {no_figure, {}, world_.colliders[row].name, true}; }
    static Side bounds() { return {no_figure, {}, bounds_name, true}; }
    Side collider_at(std::uint32_t slot) const {
        if (is_plane(slot)) return bounds();
        const auto& handles = world_.collider_handles;
        return handles.in_use(slot) ? collider_in(handles.row_at(slot)) : Side{.is_collider = true};
    }
};

} // namespace

void ContactRules::restart(const Scene& scene, AnyWorld& world) {
    waiting_.clear();
    for (std::size_t i = 0; i < scene.events.size(); ++i)
        if (scene.events[i].on) waiting_.push_back({i, 0, scene.events[i].first()});
    if (!waiting_.empty())
        std::visit([](auto& known) { known.contacts.lists_figures = known.contacts.lists_planes = true; }, world);
}

bool ContactRules::is_of(const Scene& scene) const {
    return std::ranges::all_of(waiting_, [&](const Waiting& waiting) {
        return waiting.event < scene.events.size() && scene.events[waiting.event].on.has_value();
    });
}

std::vector<RuleMet> ContactRules::met(const Scene& scene, const AnyWorld& world) {
    std::vector<RuleMet> all;
    std::visit(
        [&]<class WorldT>(const WorldT& known) {
            for (auto& [index, count, next] : waiting_) {
                const auto& event = scene.events[index];
                const bool is_over = event.times > 0 && count >= std::uint64_t(event.times);
                if (is_over || known.time < next - step_length(scene) * 1e-6) continue;
                auto found = RuleMatch<WorldT>(known, *event.on).find();
                if (!found) continue;
                found->event = index, found->before = count++;
                next = known.time + event.every;
                all.push_back(std::move(*found));
            }
        },
        world);
    return all;
}

} // namespace sinew
