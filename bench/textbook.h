#pragma once

#include "bench/simulation.h"

/// The solver that tutorials teach (Jakobsen 2001, Advanced Character Physics): an array of points, Verlet's step, and
/// one distance after the other with a square root. The unit in which speed is told. Nothing here is made slower than a
/// reader of those would write it, and nothing faster.
namespace sinew::bench {

class Textbook final : public Simulation {
  public:
    enum class Order {
        listed,  ///< as the constraints were added
        shuffled ///< at random, as a loader of meshes or an editor leaves them
    };
    Textbook(const Work& work, const Effort& effort, Order order = Order::listed);

    void step() override;
    Found place(std::size_t particle) const override;

  private:
    struct Point {
        float x, y, z;
        float old_x, old_y, old_z;
        float inverse_mass;
    };

    Effort effort_;
    Place gravity_;
    std::vector<Point> points_;
    std::vector<Stick> sticks_;
    std::vector<Strut> struts_;

    void move(float h);
    void satisfy();
};

} // namespace sinew::bench
