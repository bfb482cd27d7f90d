#include "files/out/glb_scene.h"

#include "sinew/math/format.h"
#include "sinew/scene/text.h"

#include "files/out/face_mesh.h"
#include "files/out/joint_skin.h"
#include "files/out/node_motion.h"
#include "files/out/rigid_fit.h"
#include "files/out/solids.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace sinew::files {
namespace {

/// Deviation from a rigid body, as a share of the extent, up to which a figure is a rigid node.
constexpr double rigid_tolerance = 1e-3;
/// Largest number of nodes, and of bytes: what readers still open.
constexpr std::size_t max_nodes = 20'000, max_bytes = std::size_t(1) << 30;

using Elements = std::span<const MeshElement>;

class SceneWriter {
  public:
    SceneWriter(const MeshFilm& film, const GlbMotion& motion, std::vector<std::string>& notes)
        : film_(film), tolerance_(motion.tolerance), joints_(motion.joints), notes_(notes), document_(motion.fps) {
        for (const auto& group : form().groups) materials_.push_back(material_of(group));
    }

    Failure write(std::string& bytes) {
        const auto& all = form().elements;
        for (std::size_t first = 0, end = 0; first < all.size(); first = end) {
            while (end < all.size() && name_of(all[end]) == name_of(all[first])) ++end;
            if (auto failure = add_figure(Elements(all).subspan(first, end - first))) return failure;
        }
        bytes = document_.glb();
        return {};
    }

  private:
    const SceneMesh& form() const { return film_.form(); }
    const std::string& name_of(const MeshElement& element) const { return form().group_of(element).figure; }

    int material_of(const MeshGroup& group) {
        const auto name = group.figure + "/" + group.part;
        if (!group.image) return document_.add_material(name, group.color);
        const auto [found, is_new] = textures_.try_emplace({*group.image, group.repeats}, 0);
        if (is_new) found->second = document_.add_texture(*form().images[*group.image].second, group.repeats);
        return document_.add_material(name, group.color, found->second);
    }

    /// Frames of what is below the present figure's node: one if the figure is rigid.
    std::size_t frames() const { return rigid_ ? 1 : film_.frames(); }
    Vec3<double> position(std::size_t frame, std::uint32_t vertex) const {
        return film_.position(frame, vertex) - (rigid_ ? rigid_->center[0] : Vec3<double>{});
    }

    Failure add_figure(Elements elements) {
        const auto vertices = vertices_of(film_, elements);
        rigid_ = rolls(elements) ? std::nullopt : rigid_motion(film_, vertices, rigid_tolerance);
        figure_ = add_node(name_of(elements[0]), -1);
        parts_.clear(), largest_ball_ = 0, first_group_ = elements[0].group;
        if (rigid_) set_rigid(figure_, vertices, *rigid_, name_of(elements[0]));
        std::vector<MeshElement> faces;
        for (const auto& element : elements) {
            if (element.kind == ElementKind::face) faces.push_back(element);
            if (element.kind == ElementKind::ball) largest_ball_ = max(largest_ball_, element.width / 2);
        }
        if (auto failure = add_faces(faces)) return failure;
        for (const auto& element : elements) {
            if (element.kind == ElementKind::ball) add_ball(element);
            if (element.kind == ElementKind::line || element.kind == ElementKind::ring) add_line(element);
            if (nodes_ > max_nodes)
                return concat("the .glb has more than ", max_nodes, " nodes; choose figures with --of");
        }
        return {};
    }

    bool rolls(Elements elements) const {
        return !form().turns.empty() &&
               std::ranges::any_of(elements, [](const auto& element) { return element.kind == ElementKind::ball; });
    }

    int add_node(const std::string& name, int parent, int mesh = -1) {
        ++nodes_;
        return document_.add_node(name, parent, mesh);
    }

    /// "curtain/ring_3": the figure, the part, and which of its kind.
    std::string part_name(const MeshElement& element) {
        const auto& group = form().group_of(element);
        return concat(group.figure, "/", group.part, "_", parts_[group.part]++);
    }

    void set_rigid(int node, std::span<const std::uint32_t> vertices, const RigidMotion& motion,
                   const std::string& what) {
        double reach = 0;
        for (const auto i : vertices) reach = max(reach, norm(film_.position(0, i) - motion.center[0]));
        animate(document_, node, {motion.center, {}, motion.rotation}, tolerance_, reach);
        if (motion.error > 1e-5)
            notes_.push_back(format_text("{} is a rigid node, at most {:2} m off", what, motion.error));
    }

    /// The mesh of rods, rings or balls of these measures in millionths of a metre, made once.
    template <class Make>
    int solid(ElementKind kind, std::uint32_t group, const std::array<double, 3>& measures, Make&& make) {
        std::array<long, 3> rounded{};
        for (std::size_t i = 0; i < 3; ++i) rounded[i] = long(measures[i] * 1e6);
        const auto [found, is_new] = solids_.try_emplace({kind, group, rounded}, 0);
        if (is_new) {
            const TriangleMesh mesh = make();
            const GltfDocument::Part part{materials_[group], mesh.indices, !mesh.on_image.empty()};
            found->second = document_.add_mesh(form().groups[group].part, mesh, std::span(&part, 1));
        }
        return found->second;
    }

    void add_ball(const MeshElement& ball) {
        const auto vertex = form().corners_of(ball)[0];
        const double radius = ball.width / 2;
        // Discs about one centre, such as a wheel's tyre and hub, are as much higher as they lie further to the front.
        const double height = 0.1 * largest_ball_ * (1 + 0.1 * double(ball.group - first_group_));
        const int mesh = solid(ball.kind, ball.group, {radius, height, 0},
                               [&] { return form().flat ? disc(radius, height) : sphere(radius); });
        NodeMotion motion;
        for (std::size_t frame = 0; frame < frames(); ++frame) {
            const auto turn = film_.turn(frame, vertex);
            motion.translation.push_back(position(frame, vertex));
            motion.rotation.push_back(frame == 0 ? turn : nearest_sign(turn, motion.rotation.back()));
        }
        animate(document_, add_node(part_name(ball), figure_, mesh), motion, tolerance_, radius);
    }

    void add_line(const MeshElement& line) {
        const auto corners = form().corners_of(line);
        const double parts = double(corners.size() - 1);
        const auto radius = [&](double share) { return (line.width + (line.end_width - line.width) * share) / 2; };
        for (std::size_t i = 0; i + 1 < corners.size(); ++i)
            add_rod(line, corners[i], corners[i + 1], radius(double(i) / parts), radius(double(i + 1) / parts));
    }

    /// A rod; with an image that repeats, a whole number of them.
    static TriangleMesh rod_of(const MeshElement& line, double length, double begin, double end) {
        auto mesh = rod(length, begin, end);
        if (line.image_length > 0) lay_image(mesh, length, begin, max(1.0, std::round(length / line.image_length)));
        return mesh;
    }

    /// A straight part: from the first vertex along the node's y axis to the second. Its length is the first frame's,
    /// and scaled where it changes.
    void add_rod(const MeshElement& line, std::uint32_t from, std::uint32_t to, double begin, double end) {
        double length = 0;
        for (std::size_t frame = 0; frame < frames() && length < 1e-9; ++frame)
            length = norm(position(frame, to) - position(frame, from));
        if (length < 1e-9) return;
        const int mesh = solid(line.kind, line.group, {length, begin, end}, [&] {
            return line.kind == ElementKind::ring ? long_ring(length, line.width) : rod_of(line, length, begin, end);
        });
        NodeMotion motion;
        Vec3<double> before{{0, 1, 0}};
        for (std::size_t frame = 0; frame < frames(); ++frame) {
            const auto along = position(frame, to) - position(frame, from);
            const auto now = norm(along) > 0 ? direction(along) : before;
            const auto turn = shortest_turn(before, now);
            motion.translation.push_back(position(frame, from));
            motion.rotation.push_back(frame == 0 ? turn : product(turn, motion.rotation.back()));
            motion.scale.push_back({{1, norm(along) / length, 1}});
            before = now;
        }
        animate(document_, add_node(part_name(line), figure_, mesh), motion, tolerance_, length);
    }

    /// All faces of a figure as one mesh: rigid, or with a target for each key.
    Failure add_faces(Elements faces) {
        if (faces.empty()) return {};
        const auto mesh = face_mesh(film_, faces, materials_);
        const auto& group = form().group_of(faces[0]);
        const auto called = concat(group.figure, "/", group.part);
        const auto motion = rigid_ ? std::nullopt : rigid_motion(film_, mesh.vertices, rigid_tolerance);
        if (rigid_ || motion) {
            const auto about = rigid_ ? rigid_->center[0] : motion->center[0];
            const int node =
                add_node(called, figure_, document_.add_mesh(called, posed(mesh, film_, 0, about), mesh.parts));
            if (motion) set_rigid(node, mesh.vertices, *motion, called);
            return {};
        }
        return joints_ > 0 ? add_skinned(called, mesh) : add_morphed(called, mesh);
    }

    /// The mesh stands beside the figure's node: a skin disregards the nodes above its mesh.
    Failure add_skinned(const std::string& called, const FaceMesh& mesh) {
        const auto skin = joint_skin(mesh, film_, joints_);
        std::vector<int> nodes;
        for (const auto& motion : skin.joints) {
            nodes.push_back(add_node(concat(called, "_joint_", nodes.size()), figure_));
            animate(document_, nodes.back(), motion, tolerance_, 1);
        }
        const int node = add_node(called, -1, document_.add_mesh(called, posed(mesh, film_, 0), mesh.parts));
        document_.add_skin(node, nodes, skin);
        notes_.push_back(format_text("{} follows {} joints, at most {:2} m off, {:2} m in the mean", called,
                                     nodes.size(), skin.error, skin.mean));
        return {};
    }

    Failure add_morphed(const std::string& called, const FaceMesh& mesh) {
        const auto keys = keys_of(mesh, film_, tolerance_);
        if (document_.bytes() + keys.size() * mesh.vertices.size() * sizeof(float) * 6 > max_bytes)
            return format_text("{} keys of {} vertices are too much for a .glb, which has at most {} MB; a .pc2 takes "
                               "them, or allow a larger --error",
                               keys.size(), mesh.vertices.size(), max_bytes >> 20);
        const auto first = posed(mesh, film_, 0);
        std::vector<GltfDocument::Target> targets;
        for (const auto key : std::span(keys).subspan(1)) {
            const auto now = posed(mesh, film_, key);
            GltfDocument::Target target;
            for (std::size_t i = 0; i < now.positions.size(); ++i) {
                target.positions.push_back(now.positions[i] - first.positions[i]);
                target.normals.push_back(now.normals[i] - first.normals[i]);
            }
            targets.push_back(std::move(target));
        }
        const int node = add_node(called, figure_, document_.add_mesh(called, first, mesh.parts, targets));
        if (!targets.empty()) document_.animate_targets(node, keys);
        return {};
    }

    const MeshFilm& film_;
    const double tolerance_; ///< metres
    const std::size_t joints_;
    std::vector<std::string>& notes_;
    GltfDocument document_;
    std::vector<int> materials_;                             ///< by group
    std::map<std::pair<std::uint32_t, bool>, int> textures_; ///< by image, and whether it repeats
    std::map<std::tuple<ElementKind, std::uint32_t, std::array<long, 3>>, int> solids_;
    std::size_t nodes_ = 0;

    // of the present figure
    int figure_ = 0; ///< its node
    std::optional<RigidMotion> rigid_;
    std::map<std::string, int> parts_; ///< nodes by part
    double largest_ball_ = 0;          ///< radius, metres
    std::uint32_t first_group_ = 0;
};

} // namespace

Failure glb_of(const MeshFilm& film, const GlbMotion& motion, std::string& bytes, std::vector<std::string>& notes) {
    return SceneWriter(film, motion, notes).write(bytes);
}

} // namespace sinew::files
