#pragma once

#include "sinew/collide/filter.h"
#include "sinew/table/id_list.h"
#include "sinew/table/name_table.h"
#include "sinew/table/stamp.h"
#include "sinew/world/fragment.h"
#include "sinew/world/integrator.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sinew {

/// Shape of a drawn piece.
enum class Mark : std::uint8_t {
    stroke, ///< a line through the particles
    curve,  ///< a smooth line through the particles
    limb, ///< a band along a Bezier curve with the particles as control points: 2 straight, 3 quadratic, 4 cubic, more
          ///< through all
    tip,  ///< a disc at the last particle of a limb of the same particles, turned along the end of the curve: a hand, a
          ///< foot
    loop, ///< a closed line
    ring, ///< a long ring around two particles: a link of a chain, seen from the broad side
    dot,  ///< a disc at each particle
    fill, ///< a filled polygon
    surface, ///< a patch of cloth, four particles: shaded by the tilt, smoothly from patch to patch
    face,    ///< eyes and a mouth on the disc at the last particle; up is the direction from the particle before; in 3D
             ///< right is the direction from the first to the second of four
    fragment ///< a part of a patch of cloth left by a blade (fragment.h); made by cuts only
};

/// A drawn piece. The scene's looks give colours by part ("arm", "head"), so a figure is independent of colours; the
/// thickness belongs to the shape.
struct Piece {
    Mark mark = Mark::stroke;
    std::string part{};
    IdList<ParticleId> particles{};
    double width = 0;           ///< line thickness or disc diameter, world units; 0: from the looks
    double end_width = 0;       ///< width at the last particle of a stroke or limb with a taper
    bool hidden = false;        ///< a support, drawn only on request
    std::uint32_t fragment = 0; ///< Mark::fragment: index in the figure's fragments
};

/// True for cloth, whole or cut.
inline bool is_cloth(Mark mark) {
    return mark == Mark::surface || mark == Mark::fragment;
}

/// True if an image can replace the piece: not for closed lines, cloth, faces, and polygons without exactly four
/// corners.
inline bool takes_image(const Piece& piece) {
    if (piece.mark == Mark::fill) return piece.particles.size() == 4;
    return piece.mark != Mark::loop && piece.mark != Mark::face && !is_cloth(piece.mark);
}

/// Names by number, in constant memory. Particles (or constraints) of the figure, from number `first` in the order of
/// construction, are called stem_0, stem_1, ...; with `columns` > 0, stem_COLUMN_ROW.
struct Numbered {
    std::string stem;
    std::size_t first = 0;
    std::size_t count = 0;
    std::size_t columns = 0;
};

/// Number of a name such as "link_7" or "particle_3_5"; nothing if no rule matches.
std::optional<std::size_t> number_called(std::string_view name, std::span<const Numbered> numbered);
/// Name of a number; empty if no rule covers the number.
std::string name_of(std::size_t number, std::span<const Numbered> numbered);

/// Choice between the direct solver (block.h) and the sweep for connected constraints.
enum class Direct : unsigned char {
    automatic, ///< direct with few loops and more than one link
    on,        ///< direct with any number of loops, as long as the factors stay sparse
    off
};
inline constexpr std::array<std::string_view, 3> direct_names = {"auto", "on", "off"}; ///< in the order of Direct

/// Contact of cloth with itself and with other cloth.
enum class ClothContactKind : unsigned char {
    spheres, ///< spheres at the particles, 1.5 cells apart; layers may cross for moments
    thin     ///< faces and edges, half a cell apart; cloth without crossings never crosses
};
inline constexpr std::array<std::string_view, 2> cloth_contact_names = {"spheres",
                                                                        "thin"}; ///< in the order of ClothContactKind

/// Result of a prefab: names of its particles and constraints, and pieces to draw. Positions are in the columns of the
/// world. A removed figure leaves an empty, unused entry.
struct Figure {
    std::string name{};
    std::string prefab{};
    IdList<ParticleId> particles{}; ///< in the order of construction; a removed particle leaves a stale id
    IdList<ConstraintId> constraints{};
    NameTable<ParticleId> particle_names{};
    NameTable<ConstraintId> constraint_names{};
    std::vector<Numbered> particle_numbers{}; ///< further names, by number
    std::vector<Numbered> constraint_numbers{};
    std::vector<Piece> pieces{};
    std::vector<Fragment> fragments{}; ///< cut pieces: Mark::fragment
    Direct direct = Direct::automatic;
    std::optional<Integrator> integrator{}; ///< in classic mode; nothing: the integrator of the rules
    bool tethers = false;                   ///< long-range attachments to the figure's pins (plan.h)
    bool quarantined = false;
    bool faces_wind = false;     ///< winds press on its areas instead of its particles; found by the solver
    collide::Filter filter{};    ///< layers of the particles, and the layers that these touch
    bool collides = false;       ///< particles and links touch those of others that collide; direct while alone
    bool touches_itself = false; ///< likewise with each other, except for neighbours on a link
    ClothContactKind cloth = ClothContactKind::spheres; ///< of its faces (3D)
    double friction = 0.5;                              ///< Coulomb's coefficient against other figures
    double bounce = 0;                                  ///< restitution, 0..1; of two that touch the larger one counts
    std::optional<double> wall_friction{};              ///< Coulomb's coefficient against walls, in place of theirs
    double internal_damping = 0;            ///< rate of decay of motion other than that of a rigid body, >= 0, 1 / time
    std::uint32_t generation = Stamp::none; ///< generation of the FigureId; none: not in use

    bool in_use() const { return generation != Stamp::none; }
};

} // namespace sinew
