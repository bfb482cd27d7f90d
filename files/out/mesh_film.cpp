#include "files/out/mesh_film.h"

#include "sinew/math/format.h"

namespace sinew::files {

Failure MeshFilm::add(const Session& session, const MeshContent& content, std::string_view ending) {
    auto mesh = mesh_of(session, content);
    const bool begins = seconds_.empty();
    if (!begins && !mesh.has_form_of(form_))
        return format_text("a figure tears, is cut or is added at {:4} s, and a {} has one mesh for all frames; end "
                           "before (--seconds), leave the figure out (--of) or write a file a frame: NAME-%04d.obj",
                           session.seconds(), ending);
    if (positions_.size() + 3 * mesh.vertices.size() > max_numbers)
        return format_text("{} vertices in more than {} frames are too many: a {} has at most {} numbers",
                           mesh.vertices.size(), frames(), ending, max_numbers);
    for (const auto& p : mesh.vertices)
        for (int axis = 0; axis < 3; ++axis) positions_.push_back(float(p[axis]));
    turns_.push_back(std::move(mesh.turns));
    seconds_.push_back(session.seconds());
    if (begins) form_ = std::move(mesh);
    return {};
}

} // namespace sinew::files
