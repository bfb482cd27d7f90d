#include "files/out/frame_picture.h"

#include "sinew/picture/draw.h"
#include "sinew/world/edit.h"

namespace sinew::files {
namespace {

/// Mean position of a figure's particles; nothing if it is gone.
std::optional<sinew::Point> middle_of(const Session& session, const std::string& name) {
    return std::visit(
        [&](const auto& world) -> std::optional<sinew::Point> {
            const auto figure = find_figure(world, name);
            if (!figure) return std::nullopt;
            Vec3<double> sum{};
            double count = 0;
            for (const auto id : world.figures[*figure].particles)
                if (const auto row = row_of(world, id)) {
                    for (int i = 0; i < std::remove_cvref_t<decltype(world)>::dimension; ++i)
                        sum[i] += double(world.particles.position[*row][i]);
                    ++count;
                }
            if (count == 0) return std::nullopt;
            sinew::Point middle{};
            for (int i = 0; i < 3; ++i) middle[i] = sum[i] / count;
            return middle;
        },
        session.world());
}

/// The scene's view, moved so that the figure is in its middle.
View following(const Session& session, const sinew::Point& middle, int width, int height) {
    const auto& scene = session.scene();
    auto section = scene.view;
    if (scene.dimension == 2) {
        section.center = middle;
        section.height = height / session.view(width, height).scale();
    } else {
        auto& camera = section.camera;
        for (int i = 0; i < 3; ++i) {
            camera.eye[i] += middle[i] - camera.target[i];
            camera.target[i] = middle[i];
        }
    }
    return {scene, section, session.focus(), width, height};
}

} // namespace

void draw_frame(const Session& session, const ExportRequest& request, Picture& picture) {
    picture.width = request.size[0], picture.height = request.size[1];
    const auto middle = request.follow.empty() ? std::nullopt : middle_of(session, request.follow);
    const auto view = middle ? following(session, *middle, picture.width, picture.height)
                             : session.view(picture.width, picture.height);
    draw(session, view, picture, {}, request.figures);
    if (request.background) picture.background = *request.background;
    if (request.caption.empty()) return;
    const float letters = float(picture.height) / 20;
    const float light =
        0.3F * picture.background.red + 0.6F * picture.background.green + 0.1F * picture.background.blue;
    const float ink = light > 0.5F || picture.background.alpha == 0 ? 0.1F : 0.95F;
    picture.add_text(request.caption, {{float(picture.width) / 2, float(picture.height) - letters}}, letters,
                     {ink, ink, ink, 1});
}

} // namespace sinew::files
