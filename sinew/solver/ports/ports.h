#pragma once

#include "sinew/math/matrix.h"
#include "sinew/solver/id.h"

#include <cstddef>
#include <cstdint>
#include <vector>

/// Where a directly solved block is joined to what is swept. A **port** is a node of the block on which swept
/// constraints act. The sweep sees all of the block through its ports: how far each of them moves under an impulse at
/// any of them, its links held (static condensation: Guyan 1965). Whatever else acts on single nodes of a block, a
/// contact or a grab, can stand on the same ports: it needs a place, a response and somewhere to leave its impulse.
///
/// Impulses are mass times displacement, as a sweep's multipliers are: h times those in newton seconds.
namespace sinew {

template <int D> struct Port {
    using Vector = Vec<D, double>;
    std::uint32_t node = 0;
    std::uint32_t block = 0;  ///< of Blocks::hanging
    std::uint32_t number = 0; ///< among the ports of its block
    Vector impulse{};         ///< of the swept constraints, in this substep so far
    Vector guess{};           ///< about which the block was made linear: that of the last substep
    double radius = 0;        ///< metres within which its block is linear: half its shortest link
    Vector free_move{};       ///< its displacement in this substep without any impulse, by the linear model
};

/// A swept constraint that acts on a port. These come after all others.
struct PortRow {
    int kind = 0;
    Row row = 0;
    double multiplier = 0; ///< in this substep so far
};

/// All that hangs together with a port, by whatever constraints.
struct PortGroup {
    std::uint32_t first = 0, members = 0;        ///< of Ports::members
    std::uint32_t first_spring = 0, springs = 0; ///< of Ports::springs
    std::uint32_t first_anchor = 0, anchors = 0; ///< of Ports::anchors
    bool driven = false;                         ///< a winch or a motor works on it
    double stored = 0;                           ///< energy in its springs, when the substep began
    double length = 0;                           ///< mean of its links
    double share = 1;                            ///< of its velocities that is left at the end of the substep
};

/// All of it follows from the rest of the world.
template <int D> struct Ports {
    static constexpr auto none = ~std::uint32_t(0);

    std::vector<Port<D>> list;                ///< block by block
    std::vector<Matrix<D, double>> responses; ///< of each block: port q by an impulse at port p, at q ports + p
    std::vector<PortRow> rows;
    std::vector<std::uint32_t> at; ///< per particle: its port
    std::vector<char> is_port;     ///< per slot of a particle, which stays when rows move

    std::vector<char> sheets; ///< per sheet of the plan: it has a port

    std::vector<PortGroup> groups;
    std::vector<std::uint32_t> members; ///< of the groups: particles, by their slots of the sweep
    std::vector<PortRow> springs;       ///< of the groups: constraints that give
    std::vector<std::uint32_t> anchors; ///< of the groups: particles that do not move by themselves, by their slots
    std::vector<char> reached;          ///< per particle: it is in a group, or holds one

    // Room for a substep.
    std::vector<Vec<D, double>> last_moves; ///< per slot of the sweep: the displacements of the last substep
    std::vector<Vec<D, double>> free_moves; ///< per slot of the sweep: the displacements before constraints act
    std::vector<double> mobilities;         ///< per slot of the sweep

    void clear() {
        list.clear();
        rows.clear();
        sheets.clear();
        responses.clear();
        groups.clear();
        members.clear();
        springs.clear();
        anchors.clear();
    }
    void reserve(std::size_t particles, std::size_t constraints) {
        list.reserve(particles);
        rows.reserve(constraints);
        sheets.reserve(particles);
        responses.reserve(4 * particles);
        groups.reserve(particles);
        springs.reserve(constraints);
        for (auto* column : {&at, &members, &anchors}) column->reserve(particles);
        for (auto* column : {&is_port, &reached}) column->reserve(particles);
        for (auto* column : {&free_moves, &last_moves}) column->reserve(particles);
        mobilities.reserve(particles);
    }
};

} // namespace sinew
