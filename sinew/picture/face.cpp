#include "sinew/picture/face.h"

#include "sinew/picture/outline.h"
#include "sinew/scene/look_section.h"

#include <array>

namespace sinew {
namespace {

/// Polyline on the face: offsets to the right and upwards from the middle, in radii.
using Line = std::span<const Vec2<double>>;

constexpr double eye_right = 0.36, eye_above = 0.12, eye_width = 0.2, line_width = 0.1;

/// Draws on a sphere of radius 1.
class FacePainter {
  public:
    FacePainter(const Head& head, const View& view, const Color& color, Picture& picture)
        : head_(head), view_(view), color_(color), picture_(picture) {}

    void dot(double x, double y, double width) {
        if (see({{x, y}})) picture_.add(Shape::disc, shape_, float(width * head_.radius) * scale_, color_);
        shape_.clear();
    }

    /// Draws a short line if all of the points face the viewer, otherwise nothing.
    void line(Line points, double width) {
        bool seen = true;
        for (const auto& point : points) seen = see(point) && seen;
        if (seen) picture_.add(Shape::polyline, shape_, float(width * head_.radius) * scale_, color_);
        shape_.clear();
    }

  private:
    const Head& head_;
    const View& view_;
    const Color& color_;
    Picture& picture_;
    Pixels shape_;
    float scale_ = 1;

    /// Appends a point of the face to shape_; false if the point is on the far side or behind the eye.
    bool see(const Vec2<double>& at) {
        constexpr double edge = 0.12; // least cosine between normal and view direction: grazing points are left out
        const double out = square_root(max(0.0, 1 - ::sinew::dot(at, at)));
        const auto way = head_.right * at[0] + head_.above * at[1] + head_.front * out;
        if (::sinew::dot(way, view_.towards_eye()) < edge) return false;
        const auto seen = view_.see(head_.middle + way * head_.radius);
        if (!seen) return false;
        shape_.push_back(seen->pixel);
        scale_ = seen->scale;
        return true;
    }
};

void paint_closed_eye(FacePainter& painter, double x) {
    const std::array<Vec2<double>, 3> lid = {
        {{{x - 0.14, eye_above}}, {{x, eye_above - 0.06}}, {{x + 0.14, eye_above}}}};
    painter.line(lid, line_width);
}

void paint_crossed_eye(FacePainter& painter, double x) {
    constexpr double arm = 0.12;
    for (const double way : {-1.0, 1.0}) {
        const std::array<Vec2<double>, 2> bar = {
            {{{x - arm, eye_above - way * arm}}, {{x + arm, eye_above + way * arm}}}};
        painter.line(bar, line_width);
    }
}

} // namespace

Head head_at(std::span<const Vec3<double>> positions, bool flat, const View& view, double radius) {
    Head head{.middle = positions.back(), .above = view.above(), .right = view.right(), .radius = radius};
    if (positions.size() >= 2) {
        const auto up = direction(positions.back() - positions[positions.size() - 2]);
        if (up != Vec3<double>{}) head.above = up;
    }
    auto across = flat ? Vec3<double>{{head.above[1], -head.above[0], 0}} : head.right;
    if (!flat && positions.size() >= 4) across = positions[1] - positions[0];
    const auto beside = direction(across - head.above * dot(across, head.above));
    if (beside != Vec3<double>{}) head.right = beside;
    head.front = cross(head.right, head.above);
    return head;
}

void paint_face(const Head& head, std::string_view expression, const View& view, const Color& color, Picture& picture) {
    if (expression == expressions[0]) return;
    FacePainter painter(head, view, color, picture);
    for (const double x : {-eye_right, eye_right}) {
        if (expression == "asleep")
            paint_closed_eye(painter, x);
        else if (expression == "dizzy")
            paint_crossed_eye(painter, x);
        else
            painter.dot(x, eye_above, eye_width);
    }
    constexpr std::array<Vec2<double>, 5> smile = {
        {{{-0.3, -0.34}}, {{-0.17, -0.43}}, {{0, -0.46}}, {{0.17, -0.43}}, {{0.3, -0.34}}}};
    constexpr std::array<Vec2<double>, 2> straight = {{{{-0.16, -0.42}}, {{0.16, -0.42}}}};
    painter.line(expression == "awake" ? Line(smile) : Line(straight), line_width);
}

} // namespace sinew
