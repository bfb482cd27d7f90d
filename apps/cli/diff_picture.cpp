#include "apps/cli/diff_picture.h"

#include "sinew/picture/draw.h"

#include "apps/cli/scrap.h"
#include "canvas/beside.h"
#include "canvas/formats.h"

#include <array>
#include <cmath>
#include <numbers>

namespace sinew::cli {
namespace {

constexpr Color ring_color{0.85F, 0.1F, 0.1F, 1};

std::optional<Vec3<double>> position_of(const Session& session, Row row) {
    return std::visit(
        [&]<int D, class Real>(const World<D, Real>& world) -> std::optional<Vec3<double>> {
            if (row >= world.particles.size()) return std::nullopt;
            Vec3<double> position{};
            for (int k = 0; k < D; ++k) position[k] = double(world.particles.position[row][k]);
            return position;
        },
        session.world());
}

void add_ring(Picture& picture, const Vec2<float>& middle) {
    constexpr std::size_t corners = 32;
    const double radius = picture.height / 20.0;
    std::array<Vec2<float>, corners> ring;
    for (std::size_t i = 0; i < corners; ++i) {
        const double turn = 2 * std::numbers::pi * double(i) / corners;
        ring[i] = middle + Vec2<float>{{float(radius * std::cos(turn)), float(radius * std::sin(turn))}};
    }
    picture.add(Shape::loop, ring, float(picture.height / 160.0), ring_color);
}

void draw_one(const Session& session, const View& view, std::optional<Row> row, Picture& picture) {
    draw(session, view, picture);
    const auto position = row ? position_of(session, *row) : std::nullopt;
    if (const auto seen = position ? view.see(*position) : std::nullopt) add_ring(picture, seen->pixel);
}

} // namespace

void draw_difference(const std::filesystem::path& path, const Compared& first, const Compared& second,
                     std::optional<Row> row) {
    const auto [width, height] = first.session.scene().view.size;
    const auto whole = canvas::size_beside(2, width, height);
    auto [writer, failure] = canvas::open(path, {.width = whole.width, .height = whole.height});
    settle(failure);
    Picture left, right, both;
    left.width = right.width = width, left.height = right.height = height;
    draw_one(first.session, first.session.view(width, height), row, left);
    draw_one(second.session, second.session.view(width, height), row, right);
    const std::array parts = {canvas::Labelled{&left, first.label}, canvas::Labelled{&right, second.label}};
    canvas::put_beside(parts, both);
    settle(writer->frame(both));
    settle(writer->finish());
}

} // namespace sinew::cli
