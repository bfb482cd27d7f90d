#include "sinew/prefab/body.h"

namespace sinew {

std::vector<Joint> posed(std::span<const Joint> joints, std::span<const PoseTurn> pose) {
    std::vector<Joint> turned(joints.begin(), joints.end());
    const auto find = [&](std::string_view name) {
        return std::find_if(turned.begin(), turned.end(), [&](const Joint& joint) { return joint.name == name; });
    };
    for (const auto& [at, degrees] : pose)
        for (const auto& limb : limbs) {
            auto beyond = std::find(limb.begin(), limb.end(), at);
            if (beyond == limb.end()) continue;
            const auto hinge = *find(at);
            const double angle = degrees * pi<double> / 180, c = cosine(angle), s = sine(angle);
            while (++beyond != limb.end()) {
                const auto joint = find(*beyond);
                const double x = joint->x - hinge.x,
                             y = joint->y - hinge.y; // y points down, so a turn that is counter-clockwise on screen has
                                                     // the opposite sign here
                joint->x = hinge.x + c * x + s * y;
                joint->y = hinge.y - s * x + c * y;
            }
        }
    return turned;
}

} // namespace sinew
