#pragma once

#include "sinew/math/vec.h"
#include "sinew/scene/scene.h"

namespace sinew::files {

/// Coordinates of models: metres, y upwards, right-handed, as glTF and OBJ have them. A scene with y downwards is
/// turned half around the x axis, which keeps its handedness.
class ModelSpace {
  public:
    explicit ModelSpace(const Scene& scene);

    Vec3<double> position(const Vec3<double>& in_scene) const;
    double length(double in_scene) const { return in_scene * scale_; }
    /// +1, or -1 where the scene's y points downwards: the sense of a rotation about z.
    double sense() const { return sense_; }

  private:
    double scale_ = 1; ///< metres per unit of length
    double sense_ = 1;
};

} // namespace sinew::files
