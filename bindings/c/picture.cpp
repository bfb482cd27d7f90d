#include "sinew/picture/draw.h"

#include "bindings/c/native/sized.h"
#include "bindings/c/simulation.h"

#include <cmath>
#include <limits>

using namespace sinew;
using namespace sinew::c;

namespace sinew::c {

static_assert(int(Shape::polyline) == SINEW_POLYLINE && int(Shape::loop) == SINEW_LOOP &&
              int(Shape::disc) == SINEW_DISC && int(Shape::polygon) == SINEW_POLYGON &&
              int(Shape::image) == SINEW_IMAGE && int(Shape::text) == SINEW_TEXT && int(Shape::pane) == SINEW_PANE);

void Drawn::hand_out(sinew_picture& out) {
    items.clear();
    for (const auto& item : picture.items)
        items.push_back({std::uint32_t(item.shape),
                         item.first,
                         item.count,
                         item.width,
                         {item.color.red, item.color.green, item.color.blue, item.color.alpha},
                         item.number,
                         item.across});
    const auto& paper = picture.background;
    const sinew_picture made{0,
                             std::uint32_t(picture.width),
                             std::uint32_t(picture.height),
                             {paper.red, paper.green, paper.blue, paper.alpha},
                             reinterpret_cast<const float*>(picture.points.data()),
                             std::uint32_t(picture.points.size()),
                             items.data(),
                             std::uint32_t(items.size()),
                             sizeof(sinew_item),
                             std::uint32_t(picture.texts.size()),
                             std::uint32_t(picture.images.size())};
    fill_sized(made, &out);
}

} // namespace sinew::c

namespace {

constexpr std::uint32_t longest_side = 16384; // pixels

bool is_size(std::uint32_t width, std::uint32_t height) {
    return width > 0 && height > 0 && width <= longest_side && height <= longest_side;
}

sinew_status no_size() {
    return fail(SINEW_BAD_ARGUMENT, "the sides of a picture are 1 to 16384 pixels");
}

} // namespace

extern "C" {

sinew_status sinew_world_draw(sinew_world simulation, uint32_t width, uint32_t height, uint32_t overlay_bits,
                              sinew_picture* picture) {
    if (const auto status = can_fill(picture)) return status;
    if (!is_size(width, height)) return no_size();
    return read(simulation, [&](Simulation& known, const Session& session) {
        auto& shown = known.drawn.picture;
        shown.width = int(width), shown.height = int(height);
        draw(session, session.view(int(width), int(height)), shown, OverlaySet(overlay_bits));
        known.drawn.hand_out(*picture);
        return SINEW_OK;
    });
}

sinew_status sinew_world_picture_text(sinew_world simulation, uint32_t index, const char** text) {
    if (!text) return null_argument();
    return read(simulation, [&](const Simulation& known, const Session&) {
        if (index >= known.drawn.picture.texts.size()) return fail(SINEW_NOT_FOUND, "there are fewer texts");
        *text = known.drawn.picture.texts[index].c_str();
        return SINEW_OK;
    });
}

sinew_status sinew_world_picture_image(sinew_world simulation, uint32_t index, const char** name) {
    if (!name) return null_argument();
    return read(simulation, [&](const Simulation&, const Session& session) {
        if (index >= session.images().size()) return fail(SINEW_NOT_FOUND, "there are fewer images");
        *name = session.images()[index].first.c_str();
        return SINEW_OK;
    });
}

sinew_status sinew_world_unproject(sinew_world simulation, uint32_t width, uint32_t height, double x, double y,
                                   sinew_point* position) {
    if (!position) return null_argument();
    if (!is_size(width, height)) return no_size();
    return read(simulation, [&](const Simulation&, const Session& session) {
        const auto at = session.view(int(width), int(height)).position_of({{x, y}}, 1);
        *position = {at[0], at[1], at[2]};
        return SINEW_OK;
    });
}

sinew_status sinew_world_project(sinew_world simulation, uint32_t width, uint32_t height, sinew_point position,
                                 double* x, double* y) {
    if (!x || !y) return null_argument();
    if (!is_size(width, height)) return no_size();
    return read(simulation, [&](const Simulation&, const Session& session) {
        const auto seen = session.view(int(width), int(height)).see(point_of(position).as<3, double>());
        if (!seen) return fail(SINEW_NOT_FOUND, "the position is behind the camera");
        *x = double(seen->pixel[0]);
        *y = double(seen->pixel[1]);
        return SINEW_OK;
    });
}

} // extern "C"
