#include "bench/textbook.h"

#include "bench/shuffle.h"

#include <cmath>

namespace sinew::bench {

Textbook::Textbook(const Work& work, const Effort& effort, Order order) : effort_(effort), gravity_(work.gravity) {
    const float h = float(frame / effort.substeps);
    for (std::size_t i = 0; i < work.positions.size(); ++i) {
        const auto now = work.positions[i], before = now - work.velocities[i] * h;
        points_.push_back({now[0], now[1], now[2], before[0], before[1], before[2], work.inverse_masses[i]});
    }
    for (const auto& stick : work.sticks) sticks_.push_back({stick.a, stick.b, float(stick.rest)});
    for (const auto& strut : work.struts) struts_.push_back({strut.a, strut.b, float(strut.min)});
    if (order == Order::shuffled) shuffle(sticks_, 1);
}

void Textbook::step() {
    for (int substep = 0; substep < effort_.substeps; ++substep) {
        move(float(frame / effort_.substeps));
        for (int i = 0; i < effort_.iterations; ++i) satisfy();
    }
}

/// Verlet: x + (x - x_old) + a h^2.
void Textbook::move(float h) {
    for (auto& point : points_) {
        if (point.inverse_mass == 0) continue;
        const float x = point.x, y = point.y, z = point.z;
        point.x += point.x - point.old_x + gravity_[0] * h * h;
        point.y += point.y - point.old_y + gravity_[1] * h * h;
        point.z += point.z - point.old_z + gravity_[2] * h * h;
        point.old_x = x, point.old_y = y, point.old_z = z;
    }
}

void Textbook::satisfy() {
    const auto correct = [this](std::uint32_t first, std::uint32_t second, float wanted, bool at_least) {
        Point &a = points_[first], &b = points_[second];
        const float dx = b.x - a.x, dy = b.y - a.y, dz = b.z - a.z;
        const float length = std::sqrt(dx * dx + dy * dy + dz * dz);
        const float mobility = a.inverse_mass + b.inverse_mass;
        if (mobility == 0 || length < 1e-9F || (at_least && length >= wanted)) return;
        const float s = (length - wanted) / (length * mobility);
        a.x += dx * s * a.inverse_mass, a.y += dy * s * a.inverse_mass, a.z += dz * s * a.inverse_mass;
        b.x -= dx * s * b.inverse_mass, b.y -= dy * s * b.inverse_mass, b.z -= dz * s * b.inverse_mass;
    };
    for (const auto& stick : sticks_) correct(stick.a, stick.b, stick.length, false);
    for (const auto& strut : struts_) correct(strut.a, strut.b, strut.length, true);
}

Found Textbook::position(std::size_t particle) const {
    const auto& point = points_[particle];
    return {{double(point.x), double(point.y), double(point.z)}};
}

} // namespace sinew::bench
