#include "apps/window/icons.h"

#include <array>
#include <cmath>
#include <initializer_list>

namespace sinew::window {
namespace {

/// Draws in a square from -1 to 1.
struct Pen {
    ImDrawList& list;
    ImVec2 middle;
    float size;
    ImU32 color;

    ImVec2 at(ImVec2 point) const { return {middle.x + point.x * size, middle.y + point.y * size}; }
    float thick() const { return size * 0.19F; }

    void line(std::initializer_list<ImVec2> points, bool closed = false) const {
        for (const auto& point : points) list.PathLineTo(at(point));
        list.PathStroke(color, closed ? ImDrawFlags_Closed : 0, thick());
    }
    void fill(std::initializer_list<ImVec2> points) const {
        for (const auto& point : points) list.PathLineTo(at(point));
        list.PathFillConvex(color);
    }
    void ring(ImVec2 point, float radius) const { list.AddCircle(at(point), radius * size, color, 20, thick()); }
    void dot(ImVec2 point, float radius) const { list.AddCircleFilled(at(point), radius * size, color, 20); }
    void arc(ImVec2 point, float radius, float from, float to) const {
        list.PathArcTo(at(point), radius * size, from, to, 18);
        list.PathStroke(color, 0, thick());
    }
    void curve(ImVec2 a, ImVec2 b, ImVec2 c, ImVec2 d) const {
        list.AddBezierCubic(at(a), at(b), at(c), at(d), color, thick(), 18);
    }
};

struct Icon {
    std::string_view name;
    void (*draw)(const Pen&);
};

constexpr std::array icons = {
    Icon{"grab",
         [](const Pen& pen) {
             pen.fill({{-0.75F, -0.95F}, {0.75F, 0.1F}, {0.05F, 0.2F}, {-0.75F, 0.85F}});
             pen.line({{0.0F, 0.1F}, {0.5F, 0.95F}});
         }},
    Icon{"select",
         [](const Pen& pen) {
             pen.line({{-0.9F, -0.45F}, {-0.9F, -0.9F}, {-0.45F, -0.9F}});
             pen.line({{0.45F, -0.9F}, {0.9F, -0.9F}, {0.9F, -0.45F}});
             pen.line({{0.9F, 0.45F}, {0.9F, 0.9F}, {0.45F, 0.9F}});
             pen.line({{-0.45F, 0.9F}, {-0.9F, 0.9F}, {-0.9F, 0.45F}});
             pen.dot({0, 0}, 0.4F);
         }},
    Icon{"join",
         [](const Pen& pen) {
             pen.ring({-0.6F, 0.6F}, 0.32F), pen.ring({0.6F, -0.6F}, 0.32F);
             pen.line({{-0.36F, 0.36F}, {0.36F, -0.36F}});
         }},
    Icon{"wall",
         [](const Pen& pen) {
             pen.fill({{-0.95F, 0.45F}, {-0.75F, 0.85F}, {0.95F, -0.45F}, {0.75F, -0.85F}});
         }},
    Icon{"terrain",
         [](const Pen& pen) {
             pen.curve({-0.95F, 0.3F}, {-0.4F, -1.3F}, {0.1F, 1.2F}, {0.95F, -0.4F});
             pen.line({{-0.95F, 0.85F}, {0.95F, 0.85F}});
         }},
    Icon{"pin",
         [](const Pen& pen) {
             pen.dot({0, -0.45F}, 0.5F);
             pen.line({{0, 0}, {0, 0.95F}});
         }},
    Icon{"cut",
         [](const Pen& pen) {
             pen.ring({-0.55F, 0.6F}, 0.32F), pen.ring({0.55F, 0.6F}, 0.32F);
             pen.line({{-0.35F, 0.32F}, {0.5F, -0.95F}}), pen.line({{0.35F, 0.32F}, {-0.5F, -0.95F}});
         }},
    Icon{"rope",
         [](const Pen& pen) {
             pen.curve({-0.95F, 0.7F}, {-0.2F, -1.7F}, {0.2F, 1.7F}, {0.95F, -0.7F});
         }},
    Icon{"polygon",
         [](const Pen& pen) {
             pen.line({{-0.15F, -0.9F}, {0.9F, -0.35F}, {0.6F, 0.8F}, {-0.55F, 0.75F}, {-0.95F, -0.2F}}, true);
         }},
    Icon{"cloth",
         [](const Pen& pen) {
             pen.line({{-0.85F, -0.85F}, {0.85F, -0.85F}, {0.85F, 0.85F}, {-0.85F, 0.85F}}, true);
             pen.line({{-0.28F, -0.85F}, {-0.28F, 0.85F}}), pen.line({{0.28F, -0.85F}, {0.28F, 0.85F}});
             pen.line({{-0.85F, -0.28F}, {0.85F, -0.28F}}), pen.line({{-0.85F, 0.28F}, {0.85F, 0.28F}});
         }},
    Icon{"spawn",
         [](const Pen& pen) {
             pen.line({{0, -0.85F}, {0, 0.85F}}), pen.line({{-0.85F, 0}, {0.85F, 0}});
         }},
    Icon{"remove",
         [](const Pen& pen) {
             pen.line({{-0.9F, -0.6F}, {0.9F, -0.6F}}), pen.line({{-0.3F, -0.9F}, {0.3F, -0.9F}});
             pen.line({{-0.65F, -0.55F}, {-0.5F, 0.9F}, {0.5F, 0.9F}, {0.65F, -0.55F}});
         }},
    Icon{"measure",
         [](const Pen& pen) {
             pen.line({{-0.95F, 0.55F}, {0.55F, -0.95F}, {0.95F, -0.55F}, {-0.55F, 0.95F}}, true);
             pen.line({{-0.35F, -0.05F}, {-0.1F, 0.2F}}), pen.line({{0.1F, -0.5F}, {0.35F, -0.25F}});
         }},
    Icon{"undo",
         [](const Pen& pen) {
             pen.arc({0.1F, 0.25F}, 0.62F, -2.6F, 1.2F);
             pen.fill({{-0.95F, -0.05F}, {-0.5F, -0.75F}, {-0.05F, -0.05F}});
         }},
    Icon{"redo",
         [](const Pen& pen) {
             pen.arc({-0.1F, 0.25F}, 0.62F, 1.94F, 5.74F);
             pen.fill({{0.95F, -0.05F}, {0.5F, -0.75F}, {0.05F, -0.05F}});
         }},
    Icon{"restart",
         [](const Pen& pen) {
             pen.arc({0, 0.05F}, 0.72F, -0.9F, 4.2F);
             pen.fill({{-0.75F, -0.9F}, {0.05F, -0.72F}, {-0.52F, -0.1F}});
         }},
    Icon{"back",
         [](const Pen& pen) {
             pen.fill({{0.75F, -0.8F}, {0.75F, 0.8F}, {-0.45F, 0}});
             pen.line({{-0.65F, -0.75F}, {-0.65F, 0.75F}});
         }},
    Icon{"step",
         [](const Pen& pen) {
             pen.fill({{-0.75F, -0.8F}, {0.45F, 0}, {-0.75F, 0.8F}});
             pen.line({{0.65F, -0.75F}, {0.65F, 0.75F}});
         }},
    Icon{"play",
         [](const Pen& pen) {
             pen.fill({{-0.55F, -0.85F}, {0.85F, 0}, {-0.55F, 0.85F}});
         }},
    Icon{"pause",
         [](const Pen& pen) {
             pen.fill({{-0.65F, -0.8F}, {-0.2F, -0.8F}, {-0.2F, 0.8F}, {-0.65F, 0.8F}});
             pen.fill({{0.2F, -0.8F}, {0.65F, -0.8F}, {0.65F, 0.8F}, {0.2F, 0.8F}});
         }},
};

} // namespace

void draw_icon(ImDrawList& list, std::string_view name, ImVec2 middle, float size, ImU32 color) {
    const Pen pen{list, middle, size, color};
    for (const auto& icon : icons)
        if (icon.name == name) return icon.draw(pen);
    pen.dot({0, 0}, 0.5F);
}

} // namespace sinew::window
