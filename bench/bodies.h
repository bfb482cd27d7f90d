#pragma once

#include "bench/contact.h"

#include <memory>
#include <span>

/// Cases of contact for engines of rigid bodies.
namespace sinew::bench {

/// Figures of a work as rigid bodies with shapes, held together by joints. Particles whose links leave no freedom form
/// one body; each link besides is a rod. The mass of a particle is divided evenly among the bodies that it belongs to.
struct Bodies {
    using Vector = Vec<2, double>;
    struct Point {
        std::uint32_t particle = 0;
        Vector from_center{};
    };
    struct Body {
        Vector center{};
        double mass = 0, inertia = 0; ///< kg, kg m^2
        std::uint32_t figure = 0;     ///< bodies of one figure do not touch each other
        std::vector<Point> points{};
    };
    struct Shape {
        std::uint32_t body = 0;
        std::vector<Vector> corners{}; ///< from the centre; one of a disc, two of a capsule, more of a polygon
        double radius = 0;
    };
    struct Joint {
        std::uint32_t a = 0, b = 0;
        Vector on_a{}, on_b{}; ///< from the centres
        double length = 0;     ///< of the shortest link there, m
    };
    std::vector<Body> bodies;
    std::vector<Shape> shapes;
    std::vector<Joint> joints;
};
Bodies bodies_of(const ContactWork& work);

/// Another engine at work.
class BodySimulation {
  public:
    using Vector = Bodies::Vector;
    virtual ~BodySimulation() = default;
    virtual void step() = 0; ///< advances by one frame
    /// Place of a point of a body.
    virtual Vector position(std::uint32_t body, const Vector& from_center) const = 0;
};

struct BodySolver {
    std::string_view name;
    std::unique_ptr<BodySimulation> (*make)(const ContactWork& work, const Bodies& bodies, int substeps);
};

/// Engines built with -D SINEW_PEERS=ON; otherwise empty.
std::span<const BodySolver> body_peers();

/// Places of the particles: where the first body of each has it.
std::vector<Vec<2, double>> positions_of(const ContactWork& work, const Bodies& bodies,
                                         const BodySimulation& simulation);

/// Accuracy of a state. The error of a link is the largest gap of a joint, as a part of the shortest link there;
/// speeds are those of the step since `before`.
ContactState look_at(const ContactWork& work, const Bodies& bodies, const BodySimulation& simulation,
                     std::span<const Vec<2, double>> before);

} // namespace sinew::bench
