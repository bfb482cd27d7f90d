#include "sinew/scene/text.h"
#include "sinew/world/environment.h"

#include "bindings/c/native/sized.h"
#include "bindings/c/simulation.h"

#include <cmath>

/// Worlds built by calls: an empty one.
using namespace sinew;
using namespace sinew::c;

static_assert(kind_number<Distance, 2> == SINEW_DISTANCE && kind_number<Distance, 3> == SINEW_DISTANCE &&
              kind_number<Angle, 2> == SINEW_ANGLE && kind_number<Angle, 3> == SINEW_ANGLE &&
              kind_number<Area, 2> == SINEW_AREA_2D && kind_number<Pulley, 2> == SINEW_PULLEY_2D &&
              kind_number<Rail, 2> == SINEW_RAIL_2D && kind_number<Volume, 3> == SINEW_VOLUME_3D &&
              kind_number<Dihedral, 3> == SINEW_DIHEDRAL_3D && kind_number<Pulley, 3> == SINEW_PULLEY_3D);

namespace {

/// Scene without figures, as text.
std::string scene_of(const sinew_world_spec& spec, int dimension) {
    json::Object world{{"gravity", numbers_of(spec.gravity, dimension)}, {"damping", spec.damping}};
    json::Object solver{{"precision", spec.real_bytes == 4 ? "float" : "double"}};
    if (spec.substeps > 0) solver.push_back({"substeps", double(spec.substeps)});
    if (spec.rate != 0) solver.push_back({"rate", spec.rate});
    return json::to_text(
        json::Object{{"sinew", 1.0}, {"dimension", double(dimension)}, {"world", world}, {"solver", solver}});
}

} // namespace

extern "C" {

sinew_status sinew_world_create(const sinew_world_spec* given, sinew_world* simulation) {
    sinew_world_spec spec;
    if (const auto status = take(given, spec)) return status;
    const auto dimension = spec.dimension == 0 ? 2 : spec.dimension;
    if (dimension != 2 && dimension != 3) return fail(SINEW_BAD_ARGUMENT, "a world has 2 or 3 dimensions");
    if (spec.real_bytes != 0 && spec.real_bytes != 4 && spec.real_bytes != 8)
        return fail(SINEW_BAD_ARGUMENT, "a number has 4 or 8 bytes");
    if (!is_finite(spec.gravity) || !std::isfinite(spec.damping) || !std::isfinite(spec.rate)) return not_finite();
    return sinew_world_open(scene_of(spec, int(dimension)).c_str(), nullptr, simulation);
}

sinew_status sinew_world_set_gravity(sinew_world simulation, sinew_point gravity) {
    if (!is_finite(gravity)) return not_finite();
    return change(simulation, [&](Session& session) {
        std::visit([&]<int D, class Real>(World<D, Real>& world) { set_gravity(world, vector_of<D, Real>(gravity)); },
                   session.world());
        return SINEW_OK;
    });
}

} // extern "C"
