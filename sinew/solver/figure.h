#pragma once

#include "sinew/solver/fragment.h"
#include "sinew/solver/id_list.h"
#include "sinew/solver/integrator.h"
#include "sinew/solver/name_table.h"
#include "sinew/solver/stamp.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sinew {

/// How a part of a figure is drawn.
enum class Mark : std::uint8_t {
    stroke, ///< a line through its particles
    curve,  ///< a smooth line through them
    limb, ///< a band along the Bezier curve that its particles pull: 2 straight, 3 quadratic, 4 cubic, more through all
    tip,  ///< a disc at the last particle of a limb of the same particles, turned as the curve ends: a hand, a foot
    loop, ///< a closed line
    ring, ///< a long ring around two particles: a link of a chain, seen from its broad side
    dot,  ///< a disc at each particle
    fill, ///< a filled polygon
    surface, ///< a patch of cloth, four particles: shaded by its tilt, smoothly from patch to patch
    face, ///< eyes and a mouth on the disc at the last particle: its upper side is ahead on the way from the particle
          ///< before; in space its right side is that of the way from the first to the second of four
    fragment ///< a part of a patch of cloth that a blade left (fragment.h); made by cuts only
};

/// One drawn piece. What it looks like is said by the scene's looks, by part ("arm", "head"), so that a figure stays
/// one thing in any colours; how thick it is belongs to its shape.
struct Piece {
    Mark mark = Mark::stroke;
    std::string part{};
    IdList<ParticleId> particles{};
    double width = 0;           ///< in world units: line thickness or disc diameter; 0 leaves it to the looks
    double end_width = 0;       ///< of a stroke or limb that tapers: its width at the last particle
    bool hidden = false;        ///< a support that is only drawn when asked for
    std::uint32_t fragment = 0; ///< its number in the figure, of Mark::fragment
};

/// Cloth, whole or cut.
inline bool is_cloth(Mark mark) {
    return mark == Mark::surface || mark == Mark::fragment;
}

/// Whether an image can be painted in its place: on anything but closed lines, cloth, faces, and polygons of other than
/// four corners.
inline bool takes_image(const Piece& piece) {
    if (piece.mark == Mark::fill) return piece.particles.size() == 4;
    return piece.mark != Mark::loop && piece.mark != Mark::face && !is_cloth(piece.mark);
}

/// Names by number, which take no room however many they are: the figure's particles (or constraints) from the one
/// built as number `first` on are called stem_0, stem_1, ...; in rows of `columns`, where that is not 0,
/// stem_COLUMN_ROW.
struct Numbered {
    std::string stem;
    std::size_t first = 0;
    std::size_t count = 0;
    std::size_t columns = 0;
};

/// Which number a name stands for, or nothing: "link_7", "particle_3_5".
std::optional<std::size_t> number_called(std::string_view name, std::span<const Numbered> numbered);
/// The other way round; empty where the number has no name.
std::string name_of(std::size_t number, std::span<const Numbered> numbered);

/// Whether what hangs together is solved at once (block.h) instead of in the sweep.
enum class Direct : unsigned char {
    automatic, ///< where it has few loops, and more than one link
    on,        ///< however many loops it has, as long as its factors stay sparse
    off
};
inline constexpr std::array<std::string_view, 3> direct_names = {"auto", "on", "off"}; ///< in their order

/// What a prefab built: names for its particles and constraints, and what to draw. Positions are elsewhere, in columns.
/// Where one was removed another stands that is empty and not in use.
struct Figure {
    std::string name{};
    std::string prefab{};
    IdList<ParticleId> particles{}; ///< as they were built; what is removed leaves its id, which finds nothing
    IdList<ConstraintId> constraints{};
    NameTable<ParticleId> particle_names{};
    NameTable<ConstraintId> constraint_names{};
    std::vector<Numbered> particle_numbers{}; ///< further names
    std::vector<Numbered> constraint_numbers{};
    std::vector<Piece> pieces{};
    std::vector<Fragment> fragments{}; ///< of the pieces that are some
    Direct direct = Direct::automatic;
    std::optional<Integrator> integrator{}; ///< in classic mode; nothing: that of the rules
    bool tethers = false; ///< nothing of it gets further from what pins it than its links reach (plan.h)
    bool quarantined = false;
    std::uint32_t generation = Stamp::none; ///< of its FigureId; none: not in use

    bool in_use() const { return generation != Stamp::none; }
};

} // namespace sinew
