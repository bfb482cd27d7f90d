#include "bench/contact.h"

#include "sinew/math/random.h"
#include "sinew/world/colliders.h"
#include "sinew/world/edit.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace sinew::bench {
namespace {

/// Fifteen particles, twenty-one links, 70 kg, eight limbs, a trunk and a head.
struct RagdollModel {
    enum Part { head, neck, ls, rs, le, re, lh, rh, pelvis, lp, rp, lk, rk, lf, rf, parts };
    using Pair = std::array<std::uint32_t, 2>;
    static constexpr std::array<Flat, parts> position{{{{0, 0.26F}},
                                                       {{0, 0.06F}},
                                                       {{-0.12F, 0}},
                                                       {{0.12F, 0}},
                                                       {{-0.18F, -0.28F}},
                                                       {{0.18F, -0.28F}},
                                                       {{-0.2F, -0.54F}},
                                                       {{0.2F, -0.54F}},
                                                       {{0, -0.48F}},
                                                       {{-0.1F, -0.42F}},
                                                       {{0.1F, -0.42F}},
                                                       {{-0.12F, -0.86F}},
                                                       {{0.12F, -0.86F}},
                                                       {{-0.13F, -1.3F}},
                                                       {{0.13F, -1.3F}}}};
    static constexpr std::array<float, parts> mass{4.2F, 4.9F, 6.44F, 6.44F,  1.715F, 1.715F, 0.77F, 0.77F,
                                                   5.6F, 9.8F, 9.8F,  6.965F, 6.965F, 1.995F, 1.995F};
    static constexpr std::array<Pair, 21> links{
        {{neck, ls},   {neck, rs},   {ls, lp},       {rs, rp},     {lp, rp},   {ls, rp},   {rs, lp},
         {pelvis, lp}, {pelvis, rp}, {neck, pelvis}, {head, neck}, {head, ls}, {head, rs}, {ls, le},
         {le, lh},     {rs, re},     {re, rh},       {lp, lk},     {lk, lf},   {rp, rk},   {rk, rf}}};
    static constexpr std::array<Pair, 9> limbs{
        {{ls, le}, {le, lh}, {rs, re}, {re, rh}, {lp, lk}, {lk, lf}, {rp, rk}, {rk, rf}, {neck, pelvis}}};
    static constexpr float radius(std::size_t part) {
        return part == head ? 0.11F : part == neck || part == pelvis ? 0.1F : 0.04F;
    }
};

void add_ragdoll(ContactWork& work, const Flat& at, float turn) {
    const auto first = std::uint32_t(work.particles.size());
    const float c = std::cos(turn), s = std::sin(turn);
    for (std::size_t i = 0; i < RagdollModel::parts; ++i) {
        const auto& p = RagdollModel::position[i];
        work.particles.push_back({.position = at + Flat{{c * p[0] - s * p[1], s * p[0] + c * p[1]}},
                                  .mass = RagdollModel::mass[i],
                                  .radius = RagdollModel::radius(i),
                                  .body = work.bodies});
    }
    for (const auto& [a, b] : RagdollModel::links)
        work.sticks.push_back({first + a, first + b, distance(RagdollModel::position[a], RagdollModel::position[b])});
    for (const auto& [a, b] : RagdollModel::limbs) work.outlines.push_back({{first + a, first + b}});
    ++work.bodies;
}

void add_box(ContactWork& work, float width) {
    work.walls = {{{{0, 1}}, 0}, {{{1, 0}}, -width / 2}, {{{-1, 0}}, -width / 2}};
}

/// Thirty abreast for a thousand, in a box 20 m wide: the pile is as high for any number.
ContactWork pile(int size) {
    ContactWork work;
    constexpr float apart = 0.64F;
    const int across = std::max(1, 30 * size / 1000);
    add_box(work, std::max(2.F, 20 * float(size) / 1000));
    const auto noise = [](int i, std::uint64_t k) { return float(random::symmetric(1, k, std::uint64_t(i))) / 2; };
    for (int i = 0; i < size; ++i)
        add_ragdoll(work,
                    {{(float(i % across) - float(across - 1) / 2) * apart + 0.04F * noise(i, 0),
                      1.9F + 1.75F * float(i / across)}},
                    0.16F * noise(i, 1));
    return work;
}

ContactWork discs(int size) {
    ContactWork work;
    constexpr float radius = 0.1F;
    const int across = std::max(2, int(std::sqrt(2.0 * size)));
    add_box(work, 2.1F * radius * float(across + 1));
    for (int i = 0; i < size; ++i) {
        const int row = i / across;
        const float shift = 0.3F * float(row % 2) * radius;
        work.particles.push_back({.position = {{(float(i % across) - float(across - 1) / 2) * 2.1F * radius + shift,
                                                radius * 2.1F * float(row + 1)}},
                                  .radius = radius});
    }
    work.bodies = 1;
    work.is_loose = true;
    return work;
}

void add_crate(ContactWork& work, const Flat& middle) {
    constexpr float half = 0.48F;
    const auto first = std::uint32_t(work.particles.size());
    for (const auto& corner : {Flat{{-half, -half}}, {{half, -half}}, {{half, half}}, {{-half, half}}})
        work.particles.push_back({.position = middle + corner, .mass = 0.25F, .radius = 0.02F, .body = work.bodies});
    for (std::uint32_t a = 0; a < 4; ++a)
        for (std::uint32_t b = a + 1; b < 4; ++b)
            work.sticks.push_back({first + a, first + b,
                                   distance(work.particles[first + a].position, work.particles[first + b].position)});
    work.outlines.push_back({{first, first + 1, first + 2, first + 3}});
    ++work.bodies;
}

ContactWork stack(int size) {
    ContactWork work;
    work.walls = {{{{0, 1}}, 0}};
    for (int i = 0; i < size; ++i) add_crate(work, {{0.01F * float(i % 3), 0.5F + float(i)}});
    return work;
}

ContactWork pyramid(int size) {
    ContactWork work;
    work.walls = {{{{0, 1}}, 0}};
    for (int row = 0; row < size; ++row)
        for (int i = 0; i < size - row; ++i)
            add_crate(work, {{1.1F * (float(i) + 0.5F * float(row)), 0.5F + float(row)}});
    return work;
}

} // namespace

const std::vector<ContactFamily>& contact_families() {
    static const std::vector<ContactFamily> all{
        {"pile",
         "SIZE ragdolls of 15 particles, 21 links and 10 shapes let go in a box, 20 m wide for 1000",
         {250, 1000, 4000},
         100'000,
         pile},
        {"discs", "SIZE loose discs let go in a box", {10'000, 100'000}, 1'000'000, discs},
        {"stack", "SIZE crates on each other", {10}, 1000, stack},
        {"pyramid", "SIZE rows of crates", {15}, 200, pyramid}};
    return all;
}

std::optional<ContactCase> find_contact_case(std::string_view name) {
    const auto dash = name.find('-');
    if (dash == std::string_view::npos) return std::nullopt;
    const auto digits = name.substr(dash + 1);
    int size = 0;
    const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), size);
    if (error != std::errc() || stop != digits.data() + digits.size()) return std::nullopt;
    for (const auto& family : contact_families())
        if (family.name == name.substr(0, dash) && size >= 1 && size <= family.max)
            return ContactCase{std::string(name), &family, size};
    return std::nullopt;
}

std::vector<ContactCase> all_contact_cases() {
    std::vector<ContactCase> all;
    for (const auto& family : contact_families())
        for (const int size : family.sizes)
            all.push_back({std::string(family.name) + "-" + std::to_string(size), &family, size});
    return all;
}

World<2, float> contact_world(const ContactWork& work, int substeps, bool contact) {
    World<2, float> world;
    world.forces.push_back(Gravity<2, float>{{{0, work.gravity}}});
    world.settings.substeps = substeps;
    for (const auto& wall : work.walls) world.bounds.push_back({wall.normal, wall.offset, 0, work.friction});
    for (std::uint32_t i = 0; i < work.bodies; ++i) {
        const auto figure = add_figure(world, "body_" + std::to_string(i));
        if (contact)
            set_contact(world, figure, {.figures = true, .itself = work.is_loose, .friction = work.friction});
        else
            world.figures[figure].direct = Direct::off;
    }
    std::vector<ParticleId> ids;
    for (const auto& p : work.particles) {
        ids.push_back(add_particle(
            world, {.position = p.position, .mass = p.mass, .radius = p.radius, .figure = FigureIndex(p.body)}));
        world.figures[p.body].particles.push_back(ids.back());
    }
    for (const auto& stick : work.sticks) {
        const auto body = FigureIndex(work.particles[stick.a].body);
        const auto id =
            add<Distance>(world, {ids[stick.a], ids[stick.b]}, {.limits = exactly(float(stick.rest)), .figure = body});
        world.figures[body].constraints.push_back(*id);
    }
    for (const auto& outline : work.outlines) {
        Piece piece{.mark = outline.corners.size() > 2 ? Mark::fill : Mark::stroke};
        for (const auto i : outline.corners) piece.particles.push_back(ids[i]);
        world.figures[work.particles[outline.corners[0]].body].pieces.push_back(piece);
    }
    return world;
}

int crossed_sides(const ContactWork& work, std::span<const Vec<2, double>> positions) {
    struct Side {
        Vec<2, double> a, b;
        std::uint32_t body;
        double low() const { return std::min(a[0], b[0]); }
        double high() const { return std::max(a[0], b[0]); }
    };
    std::vector<Side> sides;
    for (const auto& outline : work.outlines) {
        const auto& corners = outline.corners;
        const auto n = corners.size();
        for (std::size_t i = 0; i < (n == 2 ? 1 : n); ++i)
            sides.push_back({positions[corners[i]], positions[corners[(i + 1) % n]], work.particles[corners[0]].body});
    }
    std::sort(sides.begin(), sides.end(), [](const Side& s, const Side& t) { return s.low() < t.low(); });
    const auto is_left = [](const auto& a, const auto& b, const auto& c) { return cross(b - a, c - a) > 0; };
    int count = 0;
    for (std::size_t i = 0; i < sides.size(); ++i)
        for (std::size_t k = i + 1; k < sides.size() && sides[k].low() <= sides[i].high(); ++k) {
            const auto &s = sides[i], &t = sides[k];
            count += s.body != t.body && is_left(s.a, s.b, t.a) != is_left(s.a, s.b, t.b) &&
                     is_left(t.a, t.b, s.a) != is_left(t.a, t.b, s.b);
        }
    return count;
}

ContactState look_at(const ContactWork& work, const World<2, float>& world) {
    ContactState state;
    std::vector<Vec<2, double>> positions;
    for (const auto& position : world.particles.position) positions.push_back(cast<double>(position));
    for (const auto& stick : work.sticks)
        state.longest =
            std::max(state.longest, std::abs(distance(positions[stick.a], positions[stick.b]) / stick.rest - 1));
    for (const auto& velocity : world.particles.velocity)
        state.speed += double(norm(velocity)) / double(world.particles.size());
    state.is_lost = !std::isfinite(state.speed) || !std::isfinite(state.longest);
    state.crossed = crossed_sides(work, positions);
    return state;
}

} // namespace sinew::bench
