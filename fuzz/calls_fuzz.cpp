#include "bindings/c/sinew.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <span>
#include <vector>

namespace {

constexpr const char* flat = R"({"sinew": 1, "world": {"gravity": [0, -10], "bounds": {"box": [[-5, -3], [5, 5]]}},
    "solver": {"substeps": 2}, "colliders": [{"name": "table", "shape": "box", "at": [0, -2], "size": [3, 0.2]}],
    "figures": [{"prefab": "rope", "name": "rope", "segments": 5}, {"prefab": "box", "name": "box", "at": [1, 1]},
                {"prefab": "tire", "name": "tire", "at": [-2, 2], "contact": {"radius": 0.05}}]})";
constexpr const char* deep = R"({"sinew": 1, "dimension": 3, "world": {"gravity": [0, -10, 0]},
    "solver": {"precision": "float", "substeps": 2},
    "figures": [{"prefab": "cloth", "name": "cloth", "columns": 4, "rows": 4},
                {"prefab": "ball", "name": "ball", "at": [0, 2, 0]}]})";

/// A program of calls, read from the fuzzer's bytes; after their end everything is 0.
class Program {
  public:
    explicit Program(std::span<const std::uint8_t> bytes) : left_(bytes) {}

    bool over() const { return left_.empty(); }
    std::uint8_t byte() {
        if (left_.empty()) return 0;
        const auto first = left_.front();
        left_ = left_.subspan(1);
        return first;
    }
    /// A usual number, an extreme one, or any eight bytes.
    double number() {
        constexpr double infinite = std::numeric_limits<double>::infinity(),
                         undefined = std::numeric_limits<double>::quiet_NaN();
        constexpr std::array extremes = {0.0, -1.0, 1e-300, 1e-12, 1e12, 1e300, infinite, -infinite, undefined, 1e39};
        const auto kind = byte();
        if (kind < 200) return (kind - 100) / 20.0;
        if (kind < 250) return extremes[kind % extremes.size()];
        double any = 0;
        std::array<std::uint8_t, sizeof any> raw{};
        for (auto& one : raw) one = byte();
        std::memcpy(&any, raw.data(), sizeof any);
        return any;
    }
    sinew_point point() {
        const double x = number(), y = number();
        return {x, y, byte() % 2 ? number() : 0};
    }
    /// An id that was handed out, living or gone, or any number.
    std::uint64_t id(const std::vector<std::uint64_t>& known) {
        const auto which = byte();
        return known.empty() || which > 250 ? std::uint64_t(which) << (which % 60) : known[which % known.size()];
    }

  private:
    std::span<const std::uint8_t> left_;
};

void demand(bool holds) {
    if (!holds) std::abort();
}

/// Calls of the C face in any order on a few simulations, with ids that may be gone.
class Calls {
  public:
    explicit Calls(Program program) : program_(program) {
        for (const auto* scene : {flat, deep}) {
            sinew_world opened{};
            demand(sinew_world_open(scene, nullptr, &opened) == SINEW_OK);
            take(opened);
        }
    }
    Calls(const Calls&) = delete;
    Calls& operator=(const Calls&) = delete;
    ~Calls() {
        for (const auto simulation : simulations_) sinew_world_close(simulation);
    }

    void run() {
        constexpr int max_calls = 200;
        for (int i = 0; i < max_calls && !program_.over(); ++i) {
            const auto which = program_.byte();
            simulation_ = which == 255 ? sinew_world{which} : simulations_[which % simulations_.size()];
            call(program_.byte() % 9);
        }
        for (const auto simulation : simulations_) check(simulation);
    }

  private:
    Program program_;
    std::vector<sinew_world> simulations_; ///< some are closed
    sinew_world simulation_{};             ///< of the present call
    std::vector<std::uint64_t> particles_{0}, constraints_{0}, pins_{0};

    void call(int room) {
        switch (room) {
        case 0:
            return step();
        case 1:
            return handles();
        case 2:
            return add();
        case 3:
            return remove();
        case 4:
            return change_particle();
        case 5:
            return change_constraint();
        case 6:
            return point();
        case 8:
            return figures();
        default:
            return look();
        }
    }

    void take(sinew_world simulation) {
        simulations_.push_back(simulation);
        sinew_info info{};
        info.struct_size = sizeof info;
        demand(sinew_world_get_info(simulation, &info) == SINEW_OK);
        sinew_particle particle = 0;
        for (std::uint32_t row = 0; row < info.particles; row += 3)
            if (sinew_world_particle_at(simulation, row, &particle) == SINEW_OK) particles_.push_back(particle);
        sinew_constraint constraint = 0;
        for (std::uint32_t kind = 0; kind < 8; ++kind)
            for (std::uint32_t row = 0; row < 3; ++row)
                if (sinew_world_constraint_at(simulation, kind, row, &constraint) == SINEW_OK)
                    constraints_.push_back(constraint);
    }

    void step() { sinew_world_step(simulation_, program_.byte() % 4U); }

    void handles() {
        constexpr std::size_t max_simulations = 6;
        sinew_world made{};
        const auto which = program_.byte() % 4;
        if (which == 0) sinew_world_restart(simulation_);
        if (which == 1 && simulations_.size() > 2) sinew_world_close(simulation_);
        if (simulations_.size() >= max_simulations) return;
        if (which == 2 && sinew_world_copy(simulation_, &made) == SINEW_OK) take(made);
        if (which == 3) save_and_load();
    }

    /// A loaded world has the hash of the saved one, at once and after a step.
    void save_and_load() {
        const std::uint8_t* bytes = nullptr;
        std::size_t size = 0;
        if (sinew_world_save(simulation_, &bytes, &size) != SINEW_OK) return;
        sinew_world loaded{};
        demand(sinew_world_load(bytes, size, nullptr, &loaded) == SINEW_OK);
        for (int step = 0; step < 2; ++step) {
            std::uint64_t here = 0, there = 0;
            demand(sinew_world_state_hash(simulation_, &here) == SINEW_OK &&
                   sinew_world_state_hash(loaded, &there) == SINEW_OK);
            demand(here == there);
            sinew_world_step(simulation_, 1);
            sinew_world_step(loaded, 1);
        }
        take(loaded);
    }

    void add() {
        const auto which = program_.byte() % 3;
        if (which == 0) {
            const sinew_particle_spec spec{sizeof spec, program_.point(), program_.point(), program_.number(),
                                           program_.number()};
            sinew_particle made = 0;
            if (sinew_world_add_particle(simulation_, &spec, &made) == SINEW_OK) particles_.push_back(made);
        } else if (which == 1) {
            std::array<sinew_particle, 5> of{};
            for (auto& particle : of) particle = program_.id(particles_);
            const auto count = program_.byte() % (of.size() + 1);
            const sinew_constraint_spec spec{sizeof spec,       program_.number(), program_.number(),
                                             program_.number(), program_.number(), program_.number()};
            sinew_constraint made = 0;
            if (sinew_world_add_constraint(simulation_, program_.byte() % 10U, of.data(), count, &spec, &made) ==
                SINEW_OK)
                constraints_.push_back(made);
        } else {
            sinew_pin made = 0;
            if (sinew_world_pin_particle(simulation_, program_.id(particles_), &made) == SINEW_OK)
                pins_.push_back(made);
        }
    }

    void remove() {
        const auto which = program_.byte() % 4;
        if (which == 0) sinew_world_remove_particle(simulation_, program_.id(particles_));
        if (which == 1) sinew_world_remove_constraint(simulation_, program_.id(constraints_));
        if (which == 2) sinew_world_unpin(simulation_, program_.id(pins_));
        if (which == 3) {
            std::uint32_t count = 0;
            sinew_world_cut(simulation_, program_.point(), program_.point(), &count);
        }
    }

    void change_particle() {
        const auto which = program_.byte() % 6;
        const auto particle = program_.id(particles_);
        if (which == 0) sinew_world_set_position(simulation_, particle, program_.point());
        if (which == 1) sinew_world_set_velocity(simulation_, particle, program_.point());
        if (which == 2) sinew_world_set_mass(simulation_, particle, program_.number());
        if (which == 3) sinew_world_set_radius(simulation_, particle, program_.number());
        if (which == 4) sinew_world_apply_force(simulation_, particle, program_.point());
        if (which == 5) sinew_world_apply_impulse(simulation_, particle, program_.point());
    }

    void change_constraint() {
        const auto which = program_.byte() % 6;
        const auto constraint = program_.id(constraints_);
        const auto number = program_.number();
        if (which == 0) sinew_world_set_limits(simulation_, constraint, number, program_.number());
        if (which == 1) sinew_world_set_compliance(simulation_, constraint, number);
        if (which == 2) sinew_world_set_max_force(simulation_, constraint, number);
        if (which == 3) sinew_world_set_breaking_strain(simulation_, constraint, number);
        if (which == 4) sinew_world_set_break_force(simulation_, constraint, number);
        if (which == 5) sinew_world_drive(simulation_, constraint, number);
    }

    void point() {
        const auto which = program_.byte() % 7;
        if (which == 0) sinew_world_grab(simulation_, program_.point(), program_.number());
        if (which == 1) sinew_world_grab_particle(simulation_, program_.id(particles_));
        if (which == 2) sinew_world_drag(simulation_, program_.point());
        if (which == 3) sinew_world_let_go(simulation_);
        if (which == 4) sinew_world_point_at(simulation_, program_.point());
        if (which == 5) sinew_world_move_pin(simulation_, program_.id(pins_), program_.point());
        if (which == 6) {
            sinew_collider table = 0;
            if (sinew_world_find_collider(simulation_, "table", &table) != SINEW_OK) return;
            const auto axis = program_.point();
            sinew_world_move_collider(simulation_, table, program_.point(), program_.number(), &axis);
        }
    }

    /// Figures with controls, which come, are steered, and go.
    void figures() {
        const auto which = program_.byte() % 6;
        const std::uint32_t figure = program_.byte() % 8U;
        if (which < 2) {
            const sinew_parameter parameter{which == 0 ? "speed" : "torque", program_.number(), nullptr};
            const sinew_figure_spec spec{.struct_size = sizeof spec,
                                         .parameter_count = 1,
                                         .parameters = &parameter,
                                         .prefab = which == 0 ? "character" : "car",
                                         .name = nullptr,
                                         .position = program_.point(),
                                         .velocity = program_.point(),
                                         .turn = program_.number()};
            sinew_world_add_figure(simulation_, &spec, nullptr);
        } else if (which < 4) {
            const sinew_controls controls{sizeof controls,   program_.byte() % 2U, program_.byte() % 2U, 0,
                                          program_.number(), program_.number()};
            sinew_world_steer(simulation_, figure, &controls);
        } else if (which == 4) {
            sinew_world_steer(simulation_, figure, nullptr);
        } else {
            sinew_world_remove_figure(simulation_, figure);
        }
    }

    void look() {
        sinew_picture picture{};
        picture.struct_size = sizeof picture;
        sinew_view view{};
        view.struct_size = sizeof view;
        std::uint32_t count = 0;
        const auto which = program_.byte();
        if (which % 4 == 0) sinew_world_draw(simulation_, 1U + which, 100, which, &picture);
        if (which % 4 == 1) sinew_world_get_column(simulation_, sinew_column(which % 13), &view);
        if (which % 4 == 2) sinew_world_list_contacts(simulation_, which % 8U);
        if (which % 4 == 3) sinew_world_contact_count(simulation_, &count);
        check(simulation_);
    }

    /// Positions are finite: what is not is frozen where it was.
    static void check(sinew_world simulation) {
        sinew_info info{};
        info.struct_size = sizeof info;
        if (sinew_world_step(simulation, 1) != SINEW_OK || sinew_world_get_info(simulation, &info) != SINEW_OK) return;
        for (std::uint32_t row = 0; row < info.particles; ++row) {
            sinew_particle particle = 0;
            sinew_particle_state state{};
            state.struct_size = sizeof state;
            demand(sinew_world_particle_at(simulation, row, &particle) == SINEW_OK);
            demand(sinew_world_get_particle(simulation, particle, &state) == SINEW_OK);
            for (const double x : state.position) demand(std::isfinite(x));
        }
    }
};

} // namespace

/// Bytes are calls of the C face: each succeeds or is refused, and the worlds stay finite and can be saved.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Calls(Program({data, size})).run();
    return 0;
}
