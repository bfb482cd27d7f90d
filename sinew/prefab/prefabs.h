#pragma once

#include "sinew/prefab/ball.h"
#include "sinew/prefab/balls.h"
#include "sinew/prefab/box.h"
#include "sinew/prefab/bridge.h"
#include "sinew/prefab/car.h"
#include "sinew/prefab/chain.h"
#include "sinew/prefab/character.h"
#include "sinew/prefab/cloth.h"
#include "sinew/prefab/crank.h"
#include "sinew/prefab/curtain.h"
#include "sinew/prefab/formation.h"
#include "sinew/prefab/humanoid.h"
#include "sinew/prefab/jelly.h"
#include "sinew/prefab/limb.h"
#include "sinew/prefab/mesh.h"
#include "sinew/prefab/polygon.h"
#include "sinew/prefab/puppet.h"
#include "sinew/prefab/ragdoll.h"
#include "sinew/prefab/rope.h"
#include "sinew/prefab/spiderweb.h"
#include "sinew/prefab/stick_figure.h"
#include "sinew/prefab/swing.h"
#include "sinew/prefab/tire.h"
#include "sinew/prefab/tree.h"
#include "sinew/prefab/wheel.h"

#include <optional>
#include <string>
#include <string_view>
#include <variant>

/// A prefab is a Record whose fields are its parameters, with
///
///     name, about        name in scene files, and one sentence of description
///     dimensions         {lowest, highest} dimension the prefab exists in
///     sizes()            upper bounds on the numbers of particles and constraints, known before building
///     problem(dimension) optional: an error for a combination of parameters that are each in range
///     build(builder)     builds the figure
namespace sinew {

/// The list of prefabs. A new prefab is one new pair of files and one word in this list.
using Prefabs =
    TypeList<Polygon, Box, Ball, Balls, Wheel, Tire, Jelly, Rope, Chain, Swing, Bridge, Crank, Cloth, Mesh, Curtain,
             Spiderweb, Tree, Formation, StickFigure, Limb, Humanoid, Puppet, Ragdoll, Character, Car>;

namespace detail {
template <class List> struct VariantOf;
template <class... Types> struct VariantOf<TypeList<Types...>> { using type = std::variant<Types...>; };
} // namespace detail

/// Any prefab, with its parameters.
using AnyPrefab = detail::VariantOf<Prefabs>::type;

/// The prefab of a given name with default parameters; nothing for an unknown name.
std::optional<AnyPrefab> make_prefab(std::string_view name);

std::string_view name_of(const AnyPrefab& prefab);
Sizes sizes_of(const AnyPrefab& prefab);

/// Reason why a prefab cannot be built in a world of that dimension; nothing if it can. Ranges of single parameters are
/// not checked here; they are in the fields.
std::optional<std::string> problem_of(const AnyPrefab& prefab, int dimension);

/// Adds a prefab to a world. Returns nothing if the prefab does not exist in D dimensions.
template <int D, class Real>
std::optional<FigureIndex> build(World<D, Real>& world, const AnyPrefab& prefab, std::string_view name,
                                 const Placement<D, Real>& placement = {});

} // namespace sinew
