#pragma once

#include "bench/simulation.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Cases of contact: figures in a plane that fall into a box and lie on each other.
namespace sinew::bench {

using Flat = Vec<2, float>;

/// A world of contact in solver-neutral form.
struct ContactWork {
    struct Particle {
        Flat position{};
        float mass = 1, radius = 0;
        std::uint32_t body = 0; ///< parts of one body do not touch each other
    };
    struct Outline {
        std::vector<std::uint32_t> corners; ///< two of a capsule, more of a filled polygon
    };
    struct Wall {
        Flat normal{};
        float offset = 0;
    };
    std::vector<Particle> particles; ///< discs, unless part of an outline
    std::vector<Stick> sticks;       ///< of exact length
    std::vector<Outline> outlines;
    std::vector<Wall> walls;
    std::uint32_t bodies = 0;
    float friction = 0.5F, gravity = -9.81F;
    bool is_loose = false; ///< discs without links: all of them one figure that touches itself
};

/// Family of cases by size: pile-1000.
struct ContactFamily {
    std::string_view name, about;
    std::vector<int> sizes; ///< measured by default
    int max = 0;
    ContactWork (*build)(int size) = nullptr;
};
const std::vector<ContactFamily>& contact_families();

struct ContactCase {
    std::string name;
    const ContactFamily* family = nullptr;
    int size = 0;
};
/// Case by name, FAMILY-SIZE; empty if unknown.
std::optional<ContactCase> find_contact_case(std::string_view name);
std::vector<ContactCase> all_contact_cases();

/// World of the engine, before the first step. `contact` off: the same figures pass through each other.
World<2, float> contact_world(const ContactWork& work, int substeps, bool contact = true);

/// Accuracy of a state.
struct ContactState {
    double longest = 0;   ///< largest relative error of a link
    double speed = 0;     ///< mean, m/s
    int crossed = 0;      ///< pairs of links of different bodies that lie across each other
    bool is_lost = false; ///< a place is not finite
};
ContactState look_at(const ContactWork& work, const World<2, float>& world);

/// Number of pairs of sides of different bodies that cross.
int crossed_sides(const ContactWork& work, std::span<const Vec<2, double>> positions);

} // namespace sinew::bench
