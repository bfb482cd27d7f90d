#include "sinew/prefab/prefabs.h"

#include "sinew/math/format.h"
#include "sinew/math/limit.h"

namespace sinew {
namespace {

/// Reason why the particles of a prefab would be lighter than a particle can be; nothing if none is.
template <class Prefab> std::optional<std::string> problem_of_mass(const Prefab& prefab) {
    constexpr double lightest = 1 / limit::mass<double>;
    const auto particles = prefab.sizes().particles;
    if (prefab.mass >= lightest * double(particles)) return std::nullopt;
    return format_text("a mass of {} is too little for {} particles: each weighs {} at least", prefab.mass, particles,
                       lightest);
}

} // namespace

std::optional<AnyPrefab> make_prefab(std::string_view name) {
    std::optional<AnyPrefab> made;
    Prefabs::for_each([&]<class Prefab>(std::type_identity<Prefab>) {
        if (Prefab::name == name) made = Prefab{};
    });
    return made;
}

std::string_view name_of(const AnyPrefab& prefab) {
    return std::visit([]<class Prefab>(const Prefab&) { return Prefab::name; }, prefab);
}

Sizes sizes_of(const AnyPrefab& prefab) {
    return std::visit([](const auto& chosen) { return chosen.sizes(); }, prefab);
}

std::optional<std::string> problem_of(const AnyPrefab& prefab, int dimension) {
    return std::visit(
        [&]<class Prefab>(const Prefab& chosen) -> std::optional<std::string> {
            if (!Prefab::dimensions.include(dimension))
                return format_text("there is no {} in {} dimensions", Prefab::name, dimension);
            if constexpr (requires { chosen.problem(dimension); })
                if (auto problem = chosen.problem(dimension)) return problem;
            return problem_of_mass(chosen);
        },
        prefab);
}

template <int D, class Real>
std::optional<FigureIndex> build(World<D, Real>& world, const AnyPrefab& prefab, std::string_view name,
                                 const Placement<D, Real>& placement) {
    return std::visit(
        [&]<class Prefab>(const Prefab& chosen) -> std::optional<FigureIndex> {
            if constexpr (Prefab::dimensions.include(D))
                return build(world, chosen, name, placement);
            else
                return std::nullopt;
        },
        prefab);
}

#define SINEW_BUILD(D, Real)                                                                                           \
    template std::optional<FigureIndex> build(World<D, Real>&, const AnyPrefab&, std::string_view,                     \
                                              const Placement<D, Real>&);
SINEW_INSTANTIATE(SINEW_BUILD)

} // namespace sinew
