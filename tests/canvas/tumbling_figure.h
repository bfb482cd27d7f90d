#pragma once

#include "sinew/picture/picture.h"

#include <array>
#include <cmath>

namespace sinew {

/// A figure of limbs and joints that tumbles on a soft background, about 60 items: what the painters are tried on.
struct TumblingFigure {
    using Point = Vec2<float>;
    static constexpr Color paper{0.957f, 0.945f, 0.922f, 1}, ink{0.16f, 0.19f, 0.25f, 1}, skin{0.93f, 0.45f, 0.33f, 1},
        shadow{0.16f, 0.19f, 0.25f, 0.06f}, cloth{0.25f, 0.53f, 0.65f, 1}, grid{0.16f, 0.19f, 0.25f, 0.06f};

    Picture picture;
    float turn = 0, lift = 0;

    /// What the figure looks like after `seconds`. The picture is refilled, not reallocated.
    const Picture& at(float seconds, int width = 640, int height = 480) {
        picture.clear();
        picture.width = width;
        picture.height = height;
        picture.background = paper;
        turn = 0.35f * std::sin(2.1f * seconds);
        lift = 40 * std::abs(std::sin(1.7f * seconds));
        room();
        rope(seconds);
        figure(seconds);
        return picture;
    }

  private:
    void line(Point a, Point b, float width, Color color) {
        picture.add(Shape::polyline, std::array{a, b}, width, color);
    }
    void disc(Point a, float diameter, Color color) { picture.add(Shape::disc, std::array{a}, diameter, color); }

    void ellipse(Point center, float rx, float ry, Color color) {
        std::array<Point, 64> rim;
        for (std::size_t i = 0; i < rim.size(); ++i) {
            const float angle = 2 * pi<float> * float(i) / float(rim.size());
            rim[i] = center + Point{rx * std::cos(angle), ry * std::sin(angle)};
        }
        picture.add(Shape::polygon, rim, 0, color);
    }

    /// A point of the figure, given upright about its hip, in the picture.
    Point position(float x, float y) const {
        const float s = std::sin(turn), c = std::cos(turn);
        const auto w = float(picture.width), h = float(picture.height);
        return Point{w / 2 + c * x - s * y, h * 0.58f - lift + s * x + c * y};
    }

    void room() {
        const auto w = float(picture.width), h = float(picture.height);
        for (int i = 1; i < 12; ++i) line({float(i) * w / 12, 0}, {float(i) * w / 12, h}, 1, grid);
        for (int i = 1; i < 9; ++i) line({0, float(i) * h / 9}, {w, float(i) * h / 9}, 1, grid);
        const float floor = h * 0.90f;
        picture.add(Shape::polygon, std::array{Point{0, floor}, Point{w, floor}, Point{w, h}, Point{0, h}}, 0,
                    {0.88f, 0.86f, 0.82f, 1});
        line({0, floor}, {w, floor}, 1.5f, {0.16f, 0.19f, 0.25f, 0.35f});
        for (int i = 0; i < 4; ++i)
            ellipse({w / 2, floor + 14}, 92 - 12 * float(i) - lift / 2, 11 - 2 * float(i), shadow);
    }

    void rope(float seconds) {
        std::array<Point, 25> points;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const float u = float(i) / float(points.size() - 1);
            points[i] = {60 + 110 * u, 40 + 380 * u * (1 - u) + 8 * std::sin(3 * seconds + 9 * u)};
        }
        picture.add(Shape::polyline, points, 5, {0.62f, 0.44f, 0.26f, 1});
        picture.add(Shape::polyline, points, 1.5f, {0.80f, 0.62f, 0.42f, 1});
        disc(points.front(), 11, ink);
        disc(points.back(), 11, ink);
    }

    void figure(float seconds) {
        const float swing = 18 * std::sin(4 * seconds);
        const Point head = position(0, -150), neck = position(0, -118), hip = position(0, -10);
        const Point shoulder[2] = {position(-34, -108), position(34, -108)};
        const Point elbow[2] = {position(-70, -70 + swing), position(74, -86 - swing)};
        const Point hand[2] = {position(-92, -22 + 2 * swing), position(100, -134 - swing)};
        const Point side[2] = {position(-20, -6), position(20, -6)};
        const Point knee[2] = {position(-36, 52 - swing / 2), position(40, 48 + swing / 2)};
        const Point foot[2] = {position(-44, 118 - swing), position(34, 116 + swing)};
        for (int i : {0, 1}) {
            line(side[i], knee[i], 15, ink);
            line(knee[i], foot[i], 13, ink);
        }
        picture.add(Shape::polygon, std::array{shoulder[0], shoulder[1], side[1], side[0]}, 0, cloth);
        picture.add(Shape::loop, std::array{shoulder[0], shoulder[1], side[1], side[0]}, 12, cloth);
        line(neck, hip, 2, {1, 1, 1, 0.5f});
        for (int i : {0, 1}) {
            line(shoulder[i], elbow[i], 13, skin);
            line(elbow[i], hand[i], 11, skin);
        }
        line(neck, head, 10, skin);
        disc(head, 46, skin);
        for (const Point& joint : {shoulder[0], shoulder[1], elbow[0], elbow[1], hand[0], hand[1], side[0], side[1],
                                   knee[0], knee[1], foot[0], foot[1]}) {
            disc(joint, 8, {1, 1, 1, 0.9f});
            disc(joint, 4, ink);
        }
    }
};

} // namespace sinew
