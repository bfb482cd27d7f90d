#include "sinew/constraint/kind_table.h"
#include "sinew/scene/text.h"
#include "sinew/session/pick.h"
#include "sinew/world/measure.h"

#include "bindings/c/native/sized.h"
#include "bindings/c/simulation.h"

#include <algorithm>
#include <utility>

/// Reading a simulation: numbers, columns, particles, constraints, figures, events.
using namespace sinew;
using namespace sinew::c;

namespace {

template <class WorldT> std::uint32_t count_constraints(const WorldT& world) {
    std::size_t count = 0;
    for_each_table(world, [&](const auto& table) { count += table.size(); });
    return std::uint32_t(count);
}

/// Calls visit(world) with the world of a session and returns the result.
template <class Visit> auto in_world(const Session& session, Visit&& visit) {
    return std::visit(std::forward<Visit>(visit), session.world());
}

template <int D, class Real> sinew_view view_of(const std::vector<Vec<D, Real>>& column) {
    return {0, column.data(), std::uint32_t(column.size()), D, sizeof(Real), 0};
}
template <class Number> sinew_view view_of(const std::vector<Number>& column, std::uint32_t components = 1) {
    return {0,          column.data(),  std::uint32_t(column.size() / components),
            components, sizeof(Number), std::is_integral_v<Number>};
}

/// Rows of the ends of all distances, in `rows`.
template <class WorldT> sinew_view ends_of(const WorldT& world, std::vector<std::uint32_t>& rows) {
    rows.clear();
    const auto& table = std::get<std::size_t(kind_number<Distance, WorldT::dimension>)>(world.constraints);
    for (Row row = 0; row < table.size(); ++row)
        for (const auto member : table.members[row]) rows.push_back(member);
    return view_of(rows, 2);
}

/// 1 for every particle asleep, else 0, in `rows`.
template <class Particles> sinew_view sleepers_of(const Particles& particles, std::vector<std::uint32_t>& rows) {
    rows.clear();
    for (Row row = 0; row < particles.size(); ++row) rows.push_back(particles.asleep[row] != 0);
    return view_of(rows);
}

/// A number of the state of every distance, in `numbers`.
template <class WorldT>
sinew_view measures_of(const WorldT& world, double ConstraintState::*number, std::vector<double>& numbers) {
    constexpr auto kind = kind_number<Distance, WorldT::dimension>;
    numbers.clear();
    const auto& table = std::get<std::size_t(kind)>(world.constraints);
    for (Row row = 0; row < table.size(); ++row)
        numbers.push_back((*constraint_state(world, {int(kind), table.handles.id_of(row)})).*number);
    return view_of(numbers);
}

/// A surface as a fan of triangles. A corner may be there twice, after itself: a patch of three.
void add_fan(std::vector<Row>& corners, std::vector<std::uint32_t>& rows) {
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    for (std::size_t i = 2; i < corners.size(); ++i) rows.insert(rows.end(), {corners[0], corners[i - 1], corners[i]});
}

/// Rows of the corners of the triangles of all whole patches of cloth and skin, in `rows`.
template <class WorldT> sinew_view triangles_of(const WorldT& world, std::vector<std::uint32_t>& rows) {
    rows.clear();
    std::vector<Row> corners;
    for (const auto& figure : world.figures)
        for (const auto& piece : figure.pieces) {
            if (piece.mark != Mark::surface || piece.hidden) continue;
            corners.clear();
            for (const auto id : piece.particles)
                if (const auto row = row_of(world, id)) corners.push_back(*row);
            if (corners.size() == piece.particles.size()) add_fan(corners, rows);
        }
    return view_of(rows, 3);
}

template <class WorldT> std::optional<sinew_view> column_of(const WorldT& world, int column, Simulation& simulation) {
    const auto& particles = world.particles;
    switch (column) {
    case SINEW_POSITION:
        return view_of(particles.position);
    case SINEW_PREVIOUS:
        return view_of(particles.previous);
    case SINEW_VELOCITY:
        return view_of(particles.velocity);
    case SINEW_INVERSE_MASS:
        return view_of(particles.inverse_mass);
    case SINEW_RADIUS:
        return view_of(particles.radius);
    case SINEW_FIGURE:
        return view_of(particles.figure);
    case SINEW_CONSTRAINT_ENDS:
        return ends_of(world, simulation.rows);
    case SINEW_MOBILITY:
        return view_of(particles.mobility);
    case SINEW_ASLEEP:
        return sleepers_of(particles, simulation.rows);
    case SINEW_TENSION:
        return measures_of(world, &ConstraintState::tension, simulation.numbers);
    case SINEW_STRAIN:
        return measures_of(world, &ConstraintState::strain, simulation.numbers);
    case SINEW_TRIANGLES:
        return triangles_of(world, simulation.rows);
    default:
        return std::nullopt;
    }
}

template <class WorldT> sinew_particle_state state_of(const WorldT& world, Row row) {
    const auto& particles = world.particles;
    sinew_particle_state state{0,
                               {},
                               {},
                               double(particles.inverse_mass[row]),
                               double(particles.radius[row]),
                               particles.figure[row],
                               particles.asleep[row] != 0};
    for (int i = 0; i < WorldT::dimension; ++i) {
        state.position[i] = double(particles.position[row][i]);
        state.velocity[i] = double(particles.velocity[row][i]);
    }
    return state;
}

/// Calls visit(table) for the table of a kind; false for a kind the dimension has not.
template <class WorldT, class Visit> bool in_table(const WorldT& world, std::uint32_t kind, Visit&& visit) {
    std::uint32_t number = 0;
    bool found = false;
    for_each_table(world, [&](const auto& table) {
        if (number++ == kind) visit(table), found = true;
    });
    return found;
}

sinew_status no_kind() {
    return fail(SINEW_BAD_ARGUMENT, "no kind of constraint of this dimension has this number");
}

} // namespace

extern "C" {

sinew_status sinew_world_get_info(sinew_world simulation, sinew_info* info) {
    if (const auto status = can_fill(info)) return status;
    return read(simulation, [&](const Simulation& known, const Session& session) {
        const auto& scene = session.scene();
        const auto units = scene.measures();
        sinew_info now{};
        in_world(session, [&]<int D, class Real>(const World<D, Real>& world) {
            now.dimension = D;
            now.real_bytes = sizeof(Real);
            now.particles = std::uint32_t(world.particles.size());
            now.constraints = count_constraints(world);
            now.figures = std::uint32_t(world.figures.size());
            for (Row row = 0; row < world.particles.size(); ++row) now.asleep += world.particles.asleep[row] != 0;
        });
        now.is_classic = scene.solver.mode == "classic";
        now.y_is_down = scene.units.up == "-y";
        now.read_only = !known.own;
        now.rate = scene.solver.rate;
        now.seconds = scene.seconds;
        now.per_metre = units.per_metre;
        now.per_kilogram = units.per_kilogram;
        now.per_second = units.per_second;
        now.view_width = std::uint32_t(scene.view.size[0]);
        now.view_height = std::uint32_t(scene.view.size[1]);
        fill_sized(now, info);
        return SINEW_OK;
    });
}

sinew_status sinew_world_get_report(sinew_world simulation, sinew_report* report) {
    if (const auto status = can_fill(report)) return status;
    return read(simulation, [&](const Simulation&, const Session& session) {
        const auto now = session.report();
        const sinew_report found{0,          now.seconds,     double(now.steps), now.kinetic,      now.potential,
                                 now.stored, now.energy_lost, now.stretch_max,   now.stretch_mean, now.max_speed};
        fill_sized(found, report);
        return SINEW_OK;
    });
}

sinew_status sinew_world_state_hash(sinew_world simulation, uint64_t* hash) {
    if (!hash) return null_argument();
    return read(simulation, [&](const Simulation&, const Session& session) {
        *hash = in_world(session, [](const auto& world) { return state_hash(world); });
        return SINEW_OK;
    });
}

sinew_status sinew_world_get_column(sinew_world simulation, sinew_column column, sinew_view* view) {
    if (const auto status = can_fill(view)) return status;
    return read(simulation, [&](Simulation& known, const Session& session) {
        const auto found = in_world(session, [&](const auto& world) { return column_of(world, int(column), known); });
        if (!found) return fail(SINEW_BAD_ARGUMENT, "no such column");
        fill_sized(*found, view);
        return SINEW_OK;
    });
}

// --- particles -------------------------------------------------------------------------------------------------------

sinew_status sinew_world_particle_at(sinew_world simulation, uint32_t row, sinew_particle* particle) {
    if (!particle) return null_argument();
    return read(simulation, [&](const Simulation&, const Session& session) {
        return in_world(session, [&](const auto& world) {
            if (row >= world.particles.size()) return fail(SINEW_NOT_FOUND, "there are fewer particles");
            *particle = number_of(world.particles.handles.id_of(row));
            return SINEW_OK;
        });
    });
}

sinew_status sinew_world_row_of(sinew_world simulation, sinew_particle particle, uint32_t* row) {
    if (!row) return null_argument();
    return read(simulation, [&](const Simulation&, const Session& session) {
        return in_world(session, [&](const auto& world) {
            const auto found = row_of(world, id_of<ParticleTag>(particle));
            if (!found) return bad_id("particle");
            *row = *found;
            return SINEW_OK;
        });
    });
}

sinew_status sinew_world_find_particle(sinew_world simulation, const char* name, sinew_particle* particle) {
    if (!name || !particle) return null_argument();
    return read(simulation, [&](const Simulation&, const Session& session) {
        return in_world(session, [&](const auto& world) {
            const auto found = find_particle(world, name);
            if (!found) return fail(SINEW_NOT_FOUND, concat("no particle is called ", in_quotes(name)));
            *particle = number_of(*found);
            return SINEW_OK;
        });
    });
}

sinew_status sinew_world_particle_name(sinew_world simulation, sinew_particle particle, const char** name) {
    if (!name) return null_argument();
    return read(simulation, [&](Simulation& known, const Session& session) {
        const auto id = id_of<ParticleTag>(particle);
        if (!in_world(session, [&](const auto& world) { return row_of(world, id); })) return bad_id("particle");
        known.text = name_of(session.world(), id);
        *name = known.text.c_str();
        return SINEW_OK;
    });
}

sinew_status sinew_world_get_particle(sinew_world simulation, sinew_particle particle, sinew_particle_state* state) {
    if (const auto status = can_fill(state)) return status;
    return read(simulation, [&](const Simulation&, const Session& session) {
        return in_world(session, [&](const auto& world) {
            const auto row = row_of(world, id_of<ParticleTag>(particle));
            if (!row) return bad_id("particle");
            fill_sized(state_of(world, *row), state);
            return SINEW_OK;
        });
    });
}

// --- constraints -----------------------------------------------------------------------------------------------------

sinew_status sinew_world_find_constraint(sinew_world simulation, const char* name, sinew_constraint* constraint) {
    if (!name || !constraint) return null_argument();
    return read(simulation, [&](const Simulation&, const Session& session) {
        return in_world(session, [&](const auto& world) {
            const auto found = find_constraint(world, name);
            if (!found) return fail(SINEW_NOT_FOUND, concat("no constraint is called ", in_quotes(name)));
            *constraint = number_of(*found);
            return SINEW_OK;
        });
    });
}

sinew_status sinew_world_get_constraint(sinew_world simulation, sinew_constraint constraint,
                                        sinew_constraint_state* state) {
    if (const auto status = can_fill(state)) return status;
    return read(simulation, [&](const Simulation&, const Session& session) {
        return in_world(session, [&](const auto& world) {
            const auto found = constraint_state(world, constraint_of(constraint));
            if (!found) return bad_id("constraint");
            fill_sized(sinew_constraint_state{0, found->measure, found->error, found->strain, found->tension}, state);
            return SINEW_OK;
        });
    });
}

sinew_status sinew_world_constraint_count(sinew_world simulation, uint32_t kind, uint32_t* count) {
    if (!count) return null_argument();
    return read(simulation, [&](const Simulation&, const Session& session) {
        return in_world(session, [&](const auto& world) {
            const bool known = in_table(world, kind, [&](const auto& table) { *count = std::uint32_t(table.size()); });
            return known ? SINEW_OK : no_kind();
        });
    });
}

sinew_status sinew_world_constraint_at(sinew_world simulation, uint32_t kind, uint32_t row,
                                       sinew_constraint* constraint) {
    if (!constraint) return null_argument();
    return read(simulation, [&](const Simulation&, const Session& session) {
        return in_world(session, [&](const auto& world) {
            std::optional<sinew_constraint> found;
            const bool known = in_table(world, kind, [&](const auto& table) {
                if (row < table.size()) found = number_of(ConstraintId{int(kind), table.handles.id_of(row)});
            });
            if (!known) return no_kind();
            if (!found) return fail(SINEW_NOT_FOUND, "there are fewer constraints");
            *constraint = *found;
            return SINEW_OK;
        });
    });
}

// --- figures and events ----------------------------------------------------------------------------------------------

sinew_status sinew_world_figure_at(sinew_world simulation, uint32_t index, sinew_figure* figure) {
    if (const auto status = can_fill(figure)) return status;
    return read(simulation, [&](const Simulation&, const Session& session) {
        return in_world(session, [&](const auto& world) {
            if (index >= world.figures.size() || !world.figures[index].in_use())
                return fail(SINEW_NOT_FOUND, "no figure has this index");
            const auto& found = world.figures[index];
            fill_sized(sinew_figure{0, found.name.c_str(), found.prefab.c_str(), std::uint32_t(found.particles.size()),
                                    found.quarantined},
                       figure);
            return SINEW_OK;
        });
    });
}

sinew_status sinew_world_event_count(sinew_world simulation, uint32_t* count) {
    if (!count) return null_argument();
    return read(simulation, [&](const Simulation&, const Session& session) {
        *count = std::uint32_t(session.happenings().size());
        return SINEW_OK;
    });
}

sinew_status sinew_world_event_at(sinew_world simulation, uint32_t index, sinew_event* event) {
    if (const auto status = can_fill(event)) return status;
    return read(simulation, [&](const Simulation&, const Session& session) {
        if (index >= session.happenings().size()) return fail(SINEW_NOT_FOUND, "there are fewer events");
        const auto& found = session.happenings()[index];
        fill_sized(sinew_event{0, found.seconds, found.what.c_str(), found.where.c_str(), std::uint32_t(found.islands),
                               found.with.c_str(), found.impulse},
                   event);
        return SINEW_OK;
    });
}

} // extern "C"
