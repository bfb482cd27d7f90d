#include "sinew/prefab/prefabs.h"

#include "sinew/math/format.h"
#include "sinew/prefab/problem.h"

namespace sinew {
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
            return detail::problem_of_mass(chosen.mass, chosen.sizes().particles);
        },
        prefab);
}

template <int D, class Real>
std::optional<FigureIndex> build(World<D, Real>& world, const AnyPrefab& prefab, std::string_view name,
                                 const Placement<D, Real>& placement) {
    return std::visit(
        [&]<class Prefab>(const Prefab& chosen) -> std::optional<FigureIndex> {
            if constexpr (Prefab::dimensions.include(D))
                return build_checked(world, chosen, name, placement);
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
