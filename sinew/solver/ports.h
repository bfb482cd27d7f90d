#pragma once

#include "sinew/math/moments.h"
#include "sinew/table/id.h"

#include <cstddef>
#include <cstdint>
#include <vector>

/// Coupling of a directly solved block to the sweep. A **port** is a node of the block on which swept
/// constraints act. The sweep sees a block through its ports: the displacement of each port under an impulse at any
/// other, with the links of the block held (static condensation: Guyan 1965). A contact or a grab on a node of a block
/// can use the same ports: place, response, and a sum of impulses.
///
/// Impulses are mass times displacement, like the multipliers of a sweep: h times newton seconds.
namespace sinew {

template <int D> struct Port {
    using Vector = Vec<D, double>;
    std::uint32_t node = 0;
    std::uint32_t block = 0;  ///< index in Blocks::hanging
    std::uint32_t number = 0; ///< among the ports of its block
    Vector impulse{};         ///< sum of the swept constraints in this substep
    Vector guess{};           ///< impulse of the last substep, about which the block is linear
    double radius = 0;        ///< trust region of the linear model about `linear_move`, metres
    Vector linear_move{};     ///< displacement in this substep about which the block is linear
    Vector free_move{};       ///< displacement in this substep without impulses, by the linear model
};

/// A swept constraint at a port, solved after all others.
struct PortRow {
    int kind = 0;
    Row row = 0;
    double multiplier = 0; ///< in this substep so far
};

/// Connected component of particles around a port or of a jelly that is held, by all constraints.
template <int D> struct PortGroup {
    std::uint32_t first = 0, members = 0;        ///< range of Ports::members
    std::uint32_t first_spring = 0, springs = 0; ///< range of Ports::springs
    std::uint32_t first_anchor = 0, anchors = 0; ///< range of Ports::anchors
    bool motorized = false;                      ///< moved by a winch or a motor
    double stored = 0;                           ///< energy in the springs at the begin of the substep
    double length = 0;                           ///< of the longest link, metres
    double share = 1;                            ///< factor of the velocities at the end of the substep, 0..1
    double lost = 0;              ///< energy that constraints took in the substep, J; negative if `share`
                                  ///< removes less than they added
    double debt = 0;              ///< energy that constraints added before and that is not removed yet, J
    Vec<spins<D>, double> spin{}; ///< angular momentum due at the end of the substep, of a free one
};

/// Derived from the rest of the world: neither copied nor hashed.
template <int D> struct Ports {
    static constexpr auto none = ~std::uint32_t(0);

    std::vector<Port<D>> list;                ///< grouped by block
    std::vector<Matrix<D, double>> responses; ///< per block: response of port q to port p at q ports + p
    std::vector<PortRow> rows;
    std::vector<std::uint32_t> at; ///< port of each particle, or none
    std::vector<char> is_port;     ///< per slot of a particle, which stays when rows move

    std::vector<char> passes; ///< over each component of the plan in an iteration; 0 for one without a port

    std::vector<PortGroup<D>> groups;
    std::vector<std::uint32_t> members; ///< particles of the groups, by their slots of the sweep
    std::vector<PortRow> springs;       ///< compliant constraints of the groups
    std::vector<std::uint32_t> anchors; ///< immovable particles at the groups, by their slots
    std::vector<char> reached;          ///< 1 for each particle in or at a group

    // Room for a substep.
    std::vector<Vec<D, double>> last_displacements; ///< per slot of the sweep: the displacements of the last substep
    std::vector<Vec<D, double>> free_moves;         ///< per slot of the sweep: the displacements before constraints act
    std::vector<double> mobilities;                 ///< per slot of the sweep

    void clear() {
        list.clear();
        rows.clear();
        passes.clear();
        responses.clear();
        clear_groups();
    }
    void clear_groups() {
        groups.clear();
        members.clear();
        springs.clear();
        anchors.clear();
    }
    void reserve(std::size_t particles, std::size_t constraints) {
        list.reserve(particles);
        rows.reserve(constraints);
        passes.reserve(particles);
        responses.reserve(4 * particles);
        groups.reserve(particles);
        springs.reserve(constraints);
        for (auto* column : {&at, &members, &anchors}) column->reserve(particles);
        for (auto* column : {&is_port, &reached}) column->reserve(particles);
        for (auto* column : {&free_moves, &last_displacements}) column->reserve(particles);
        mobilities.reserve(particles);
    }
};

} // namespace sinew
