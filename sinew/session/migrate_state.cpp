#include "sinew/session/migrate_state.h"

#include "sinew/assert/assert.h"
#include "sinew/session/similarity.h"
#include "sinew/world/edit.h"

#include <algorithm>
#include <span>
#include <tuple>
#include <vector>

namespace sinew {
namespace {

/// Copies the state of one figure from an old world to a new one.
template <class WorldT> class Transplant {
  public:
    Transplant(const WorldT& old, const Figure& was, WorldT& fresh, Figure& is)
        : old_(old), was_(was), fresh_(fresh), is_(is) {}

    /// A figure changed by a cut (new particles or constraints) does not match the new world's figure.
    bool fits() const {
        return was_.particles.size() == is_.particles.size() && was_.constraints.size() == is_.constraints.size();
    }

    void carry(std::vector<ParticleId>& gone, std::vector<ConstraintId>& cut) {
        SINEW_ASSERT(fits(), "both figures have as many particles and constraints");
        for (std::size_t i = 0; i < is_.particles.size(); ++i) carry_particle(i, gone);
        for (std::size_t i = 0; i < is_.constraints.size(); ++i) carry_constraint(i, cut);
        carry_pieces();
        is_.quarantined = was_.quarantined;
    }

  private:
    const WorldT& old_;
    const Figure& was_;
    WorldT& fresh_;
    Figure& is_;

    void carry_particle(std::size_t i, std::vector<ParticleId>& gone) {
        const auto from = row_of(old_, was_.particles[i]), to = row_of(fresh_, is_.particles[i]);
        if (!from) gone.push_back(is_.particles[i]);
        if (!from || !to) return;
        const auto& source = old_.particles;
        auto& target = fresh_.particles;
        target.position[*to] = source.position[*from];
        target.previous[*to] = source.previous[*from];
        target.velocity[*to] = source.velocity[*from];
        target.at_end[*to] = source.at_end[*from];
        target.residual[*to] = source.residual[*from];
        target.energy_debt.set(*to, source.energy_debt[*from]);
        target.spin.set(*to, source.spin[*from]);
        target.turn.set(*to, source.turn[*from]);
        target.quarantined[*to] = source.quarantined[*from];
        if (target.quarantined[*to]) target.mobility[*to] = 0;
    }

    void carry_constraint(std::size_t i, std::vector<ConstraintId>& cut) {
        if (!constraint_state(old_, was_.constraints[i])) cut.push_back(is_.constraints[i]);
    }

    /// Copies the drawn pieces, which a cut changes.
    void carry_pieces() {
        std::vector<ParticleId> becomes(old_.particles.size());
        for (std::size_t i = 0; i < is_.particles.size(); ++i)
            if (const auto row = row_of(old_, was_.particles[i])) becomes[*row] = is_.particles[i];
        is_.pieces = was_.pieces;
        is_.fragments = was_.fragments;
        for (auto& piece : is_.pieces) {
            IdList<ParticleId> follow;
            for (const auto id : piece.particles) {
                const auto row = row_of(old_, id);
                const auto own = row ? becomes[*row] : ParticleId{};
                follow.push_back(row && own == ParticleId{} ? counterpart(id, *row) : own);
            }
            piece.particles = std::move(follow);
        }
    }

    /// The same particle of another figure, to which a joint is drawn; none where that figure has other particles.
    ParticleId counterpart(ParticleId id, Row row) const {
        const auto number = old_.particles.figure[row];
        if (number >= old_.figures.size()) return {};
        const auto& before = old_.figures[number];
        const auto known = find_figure(fresh_, before.name);
        if (!known || fresh_.figures[*known].particles.size() != before.particles.size()) return {};
        for (std::size_t i = 0; i < before.particles.size(); ++i)
            if (before.particles[i] == id) return fresh_.figures[*known].particles[i];
        return {};
    }
};

/// True for figures whose particles and constraints are the same but for their state: limits that a motor has moved may
/// differ.
template <class WorldT>
bool has_same_parts(const WorldT& old, const Figure& was, const WorldT& fresh, const Figure& is) {
    for (std::size_t i = 0; i < is.particles.size(); ++i) {
        const auto from = row_of(old, was.particles[i]), to = row_of(fresh, is.particles[i]);
        if (!from || !to) continue;
        const auto &a = old.particles, &b = fresh.particles;
        if (a.inverse_mass[*from] != b.inverse_mass[*to] || a.radius[*from] != b.radius[*to]) return false;
    }
    for (std::size_t i = 0; i < is.constraints.size(); ++i) {
        const auto before = was.constraints[i], after = is.constraints[i];
        if (before.kind != after.kind) return false;
        bool same = true;
        visit_table(old, before.kind, [&]<class Table>(const Table& table) {
            const auto& other = std::get<Table>(fresh.constraints);
            const auto from = table.handles.find(before.id), to = other.handles.find(after.id);
            if (!from || !to) return;
            same = table.compliance[*from] == other.compliance[*to] &&
                   (table.motorized[*from] ||
                    (table.low(*from) == other.low(*to) && table.high(*from) == other.high(*to)));
        });
        if (!same) return false;
    }
    return true;
}

/// Rows of the particles of no figure.
template <class WorldT> std::vector<Row> loose_rows(const WorldT& world) {
    std::vector<Row> rows;
    for (Row row = 0; row < world.particles.size(); ++row)
        if (world.particles.figure[row] == no_figure) rows.push_back(row);
    return rows;
}

template <class WorldT> void carry_loose(const WorldT& old, WorldT& fresh) {
    const auto from = loose_rows(old), to = loose_rows(fresh);
    if (from.size() != to.size()) return;
    for (std::size_t i = 0; i < to.size(); ++i) {
        const auto& source = old.particles;
        auto& target = fresh.particles;
        target.position[to[i]] = source.position[from[i]];
        target.previous[to[i]] = source.previous[from[i]];
        target.velocity[to[i]] = source.velocity[from[i]];
        target.residual[to[i]] = source.residual[from[i]];
        target.at_end[to[i]] = source.at_end[from[i]];
    }
}

template <class WorldT>
void carry_built(const WorldT& old, std::size_t described, WorldT& fresh, std::size_t described_now) {
    std::vector<ParticleId> gone;
    std::vector<ConstraintId> cut;
    for (std::size_t i = described_now; i < fresh.figures.size(); ++i) {
        const auto known = find_figure(old, fresh.figures[i].name);
        if (!known || *known < described) continue;
        const auto& was = old.figures[*known];
        Transplant figure(old, was, fresh, fresh.figures[i]);
        if (figure.fits() && has_same_parts(old, was, fresh, fresh.figures[i])) figure.carry(gone, cut);
    }
    carry_loose(old, fresh);
    if (!cut.empty()) remove_constraints(fresh, std::span<const ConstraintId>(cut));
    if (!gone.empty()) remove_particles(fresh, std::span<const ParticleId>(gone));
}

const FigureSection* section_of(const Scene& scene, std::size_t figure) {
    return figure < scene.figures.size() ? &scene.figures[figure] : nullptr;
}

bool same_words(const Scene& scene, const FigureSection& a, const FigureSection& b) {
    return to_json(scene, a) == to_json(scene, b);
}

/// True if every constraint is of the same kind as before.
bool same_kinds(const Figure& was, const Figure& is) {
    if (was.constraints.size() != is.constraints.size()) return false;
    for (std::size_t i = 0; i < is.constraints.size(); ++i)
        if (was.constraints[i].kind != is.constraints[i].kind) return false;
    return true;
}

/// The figures of a scene as they begin, built when the first one is asked for.
template <class WorldT> class Beginning {
  public:
    explicit Beginning(const Scene& scene) : scene_(scene) {}

    const WorldT& world() {
        if (!built_) built_ = instantiate(scene_);
        return std::get<WorldT>(*built_);
    }

  private:
    const Scene& scene_;
    std::optional<AnyWorld> built_;
};

/// True if a pin holds a particle of a figure.
template <class WorldT> bool is_pinned(const WorldT& world, std::size_t figure) {
    return std::ranges::any_of(world.pins, [&](const auto& pin) {
        const auto row = row_of(world, pin.particle);
        return row && world.particles.figure[*row] == FigureIndex(figure);
    });
}

template <class WorldT>
std::vector<FigureIndex> carry_all(const Scene& scene, const WorldT& old, const Scene& edited, WorldT& fresh) {
    std::vector<FigureIndex> going_on;
    fresh.time = old.time;
    fresh.steps = old.steps;
    fresh.last_step = old.last_step;
    fresh.last_substep = old.last_substep;
    fresh.repair_window = old.repair_window;
    std::vector<ParticleId> gone;
    std::vector<ConstraintId> cut;
    Beginning<WorldT> beginning(scene);
    for (std::size_t i = 0; i < fresh.figures.size(); ++i) {
        const auto known = find_figure(old, fresh.figures[i].name);
        if (!known) continue;
        const auto *before = section_of(scene, *known), *after = section_of(edited, i);
        if (!before || !after) continue;
        const auto& was = old.figures[*known];
        Transplant figure(old, was, fresh, fresh.figures[i]);
        if (!figure.fits()) continue;
        if (same_words(scene, *before, *after)) {
            figure.carry(gone, cut);
            going_on.push_back(FigureIndex(i));
            continue;
        }
        if (before->made.index() != after->made.index() || !same_kinds(was, fresh.figures[i])) continue;
        const auto& begun = beginning.world();
        const auto moved = similarity_of(begun, begun.figures[*known], fresh, fresh.figures[i]);
        // Pins are where the description puts them: a swung figure, turned about its middle now, would be torn off.
        if (!moved || (!moved->is_translation() && is_pinned(fresh, i))) continue;
        const auto pieces = fresh.figures[i].pieces;
        const auto lost = gone.size() + cut.size();
        figure.carry(gone, cut);
        if (gone.size() + cut.size() == lost && was.fragments.empty()) fresh.figures[i].pieces = pieces;
        if (!moved->is_identity) move_by(fresh, fresh.figures[i], *moved); // after carry()
        going_on.push_back(FigureIndex(i));
    }
    if (!cut.empty()) remove_constraints(fresh, std::span<const ConstraintId>(cut));
    if (!gone.empty()) remove_particles(fresh, std::span<const ParticleId>(gone));
    return going_on;
}

} // namespace

std::vector<FigureIndex> migrate_state(const Scene& scene, const AnyWorld& world, const Scene& edited,
                                       AnyWorld& fresh) {
    return std::visit(
        [&]<class WorldT>(WorldT& into) {
            const auto* from = std::get_if<WorldT>(&world);
            return from ? carry_all(scene, *from, edited, into) : std::vector<FigureIndex>();
        },
        fresh);
}

void migrate_built(const BuiltWorld<const AnyWorld>& from, const BuiltWorld<AnyWorld>& into) {
    std::visit(
        [&]<class WorldT>(WorldT& fresh) {
            if (const auto* old = std::get_if<WorldT>(&from.world))
                carry_built(*old, from.described, fresh, into.described);
        },
        into.world);
}

} // namespace sinew
