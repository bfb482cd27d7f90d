#pragma once

#include "bench/simulation.h"

/// The solver of the tutorials (Jakobsen 2001, Advanced Character Physics): an array of points, a Verlet step, and one
/// distance constraint after the other with a square root. The unit of speed. The code is written as a reader of a
/// tutorial would write it, neither slower nor faster.
namespace sinew::bench {

class Textbook final : public Simulation {
  public:
    enum class Order {
        listed,  ///< in the order of addition
        shuffled ///< random, as from a mesh loader or an editor
    };
    Textbook(const Work& work, const Effort& effort, Order order = Order::listed);

    void step() override;
    Found position(std::size_t particle) const override;

  private:
    struct Point {
        float x, y, z;
        float old_x, old_y, old_z;
        float inverse_mass;
    };

    struct Link {
        std::uint32_t a, b;
        float length;
    };

    Effort effort_;
    Position gravity_;
    std::vector<Point> points_;
    std::vector<Link> sticks_, struts_;

    void move(float h);
    void satisfy();
};

} // namespace sinew::bench
