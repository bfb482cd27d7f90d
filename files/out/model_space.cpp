#include "files/out/model_space.h"

namespace sinew::files {

ModelSpace::ModelSpace(const Scene& scene)
    : scale_(1 / scene.measures().per_metre), sense_(scene.units.up == "-y" ? -1 : 1) {}

Vec3<double> ModelSpace::position(const Vec3<double>& in_scene) const {
    return {{in_scene[0] * scale_, in_scene[1] * scale_ * sense_, in_scene[2] * scale_ * sense_}};
}

} // namespace sinew::files
