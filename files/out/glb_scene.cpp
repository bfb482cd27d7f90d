#include "files/out/glb_scene.h"

#include "sinew/collide/decompose.h"

#include "files/out/gltf_document.h"
#include "files/out/rigid_fit.h"
#include "files/out/solids.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <tuple>

namespace sinew::files {
namespace {

/// Deviation from a rigid body, as a share of the extent, up to which a figure is a rigid node.
constexpr double rigid_tolerance = 1e-3;
/// Largest number of nodes, and of bytes: what readers still open.
constexpr std::size_t max_nodes = 20'000, max_bytes = std::size_t(1) << 30;

using Elements = std::span<const MeshElement>;
using Indices = std::vector<std::uint32_t>;

/// Translations, rotations and scales of a node: of all frames, or of the one that it keeps.
struct NodeMotion {
    std::vector<Vec3<double>> translation, scale;
    std::vector<Vec<4, double>> rotation;
};

template <class VecT> std::vector<float> numbers_of(const std::vector<VecT>& vectors) {
    std::vector<float> numbers;
    for (const auto& v : vectors)
        for (const double c : v.component) numbers.push_back(float(c));
    return numbers;
}

template <class VecT> bool varies(const std::vector<VecT>& vectors) {
    constexpr double least = 1e-7; // metres, or a part of a quaternion
    return std::ranges::any_of(vectors, [&](const VecT& v) { return norm(v - vectors.front()) > least; });
}

Indices vertices_of(const MeshFilm& film, Elements elements) {
    Indices vertices;
    for (const auto& element : elements) {
        const auto corners = film.form().corners_of(element);
        vertices.insert(vertices.end(), corners.begin(), corners.end());
    }
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
}

/// Corners of a polygon's triangles: of a plane one, which may be concave, by its convex parts.
void add_triangles(std::span<const std::uint32_t> corners, const MeshFilm& film, Indices& triangles) {
    const auto fan = [&](std::span<const std::uint32_t> part) {
        for (std::size_t i = 2; i < part.size(); ++i)
            for (const auto corner : {part[0], part[i - 1], part[i]}) triangles.push_back(corner);
    };
    std::vector<Vec2<double>> outline;
    for (const auto i : corners) outline.push_back({{film.position(0, i)[0], film.position(0, i)[1]}});
    const auto parts =
        film.form().flat && corners.size() > 3 ? collide::convex_parts(outline) : std::vector<collide::Corners>{};
    if (parts.empty()) return fan(corners);
    for (const auto& part : parts) {
        Indices known;
        for (const auto& p : part)
            known.push_back(corners[std::size_t(std::ranges::find(outline, p) - outline.begin())]);
        fan(known);
    }
}

/// Normals of vertices: area-weighted means of the triangles around.
std::vector<Vec3<float>> normals_of(std::span<const Vec3<float>> positions, std::span<const std::uint32_t> triangles) {
    std::vector<Vec3<float>> normals(positions.size());
    for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) {
        const auto &a = positions[triangles[i]], &b = positions[triangles[i + 1]], &c = positions[triangles[i + 2]];
        for (std::size_t k = 0; k < 3; ++k) normals[triangles[i + k]] += cross(b - a, c - a);
    }
    for (auto& normal : normals) {
        normal = direction(normal);
        if (normal == Vec3<float>{}) normal = {{0, 0, 1}};
    }
    return normals;
}

class SceneWriter {
  public:
    SceneWriter(const MeshFilm& film, double fps, std::vector<std::string>& notes) : film_(film), notes_(notes) {
        std::vector<float> times;
        for (std::size_t frame = 0; frame < film.frames(); ++frame) times.push_back(float(double(frame) / fps));
        document_.set_times(times);
        for (const auto& group : form().groups)
            materials_.push_back(document_.add_material(group.figure + "/" + group.part, group.color));
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
        if (rigid_) {
            set_rigid(figure_, *rigid_);
            tell_rigid(name_of(elements[0]), rigid_->error);
        }
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
                return fmt::format("{} has more than {} nodes; choose figures with --of", "the .glb", max_nodes);
        }
        return {};
    }

    bool rolls(Elements elements) const {
        return !form().turns.empty() &&
               std::ranges::any_of(elements, [](const auto& element) { return element.kind == ElementKind::ball; });
    }

    void tell_rigid(const std::string& what, double error) {
        if (error > 1e-5) notes_.push_back(fmt::format("{} is a rigid node, at most {:.2g} m off", what, error));
    }

    int add_node(const std::string& name, int parent, int mesh = -1) {
        ++nodes_;
        return document_.add_node(name, parent, mesh);
    }

    /// "curtain/ring_3": the figure, the part, and which of its kind.
    std::string part_name(const MeshElement& element) {
        const auto& group = form().group_of(element);
        return fmt::format("{}/{}_{}", group.figure, group.part, parts_[group.part]++);
    }

    void set_rigid(int node, const RigidMotion& motion) { set_motion(node, {motion.center, {}, motion.rotation}); }

    void set_motion(int node, const NodeMotion& motion) {
        document_.place(node, motion.translation[0], motion.rotation[0],
                        motion.scale.empty() ? Vec3<double>{{1, 1, 1}} : motion.scale[0]);
        if (varies(motion.translation)) document_.animate(node, "translation", numbers_of(motion.translation));
        if (varies(motion.rotation)) document_.animate(node, "rotation", numbers_of(motion.rotation));
        if (!motion.scale.empty() && varies(motion.scale)) document_.animate(node, "scale", numbers_of(motion.scale));
    }

    /// The mesh of rods, rings or balls of these measures in millionths of a metre, made once.
    template <class Make>
    int solid(ElementKind kind, std::uint32_t group, const std::array<double, 3>& measures, Make&& make) {
        std::array<long, 3> rounded{};
        for (std::size_t i = 0; i < 3; ++i) rounded[i] = long(measures[i] * 1e6);
        const auto [found, is_new] = solids_.try_emplace({kind, group, rounded}, 0);
        if (is_new) {
            const TriangleMesh mesh = make();
            const GltfDocument::Part part{materials_[group], mesh.indices};
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
        set_motion(add_node(part_name(ball), figure_, mesh), motion);
    }

    void add_line(const MeshElement& line) {
        const auto corners = form().corners_of(line);
        const double parts = double(corners.size() - 1);
        const auto radius = [&](double share) { return (line.width + (line.end_width - line.width) * share) / 2; };
        for (std::size_t i = 0; i + 1 < corners.size(); ++i)
            add_rod(line, corners[i], corners[i + 1], radius(double(i) / parts), radius(double(i + 1) / parts));
    }

    /// A straight part: from the first vertex along the node's y axis to the second. Its length is the first frame's,
    /// and scaled where it changes.
    void add_rod(const MeshElement& line, std::uint32_t from, std::uint32_t to, double begin, double end) {
        double length = 0;
        for (std::size_t frame = 0; frame < frames() && length < 1e-9; ++frame)
            length = norm(position(frame, to) - position(frame, from));
        if (length < 1e-9) return;
        const int mesh = solid(line.kind, line.group, {length, begin, end}, [&] {
            return line.kind == ElementKind::ring ? long_ring(length, line.width) : rod(length, begin, end);
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
        set_motion(add_node(part_name(line), figure_, mesh), motion);
    }

    /// All faces of a figure as one mesh.
    Failure add_faces(Elements faces) {
        if (faces.empty()) return {};
        const auto vertices = vertices_of(film_, faces);
        std::vector<GltfDocument::Part> parts;
        Indices triangles;
        for (const auto& face : faces) {
            Indices corners;
            add_triangles(form().corners_of(face), film_, corners);
            for (auto& corner : corners)
                corner = std::uint32_t(std::ranges::lower_bound(vertices, corner) - vertices.begin());
            triangles.insert(triangles.end(), corners.begin(), corners.end());
            if (parts.empty() || parts.back().material != materials_[face.group])
                parts.push_back({materials_[face.group], {}});
            parts.back().indices.insert(parts.back().indices.end(), corners.begin(), corners.end());
        }
        const auto& name = form().group_of(faces[0]);
        const auto called = fmt::format("{}/{}", name.figure, name.part);
        if (!rigid_)
            if (const auto motion = rigid_motion(film_, vertices, rigid_tolerance)) {
                tell_rigid(called, motion->error);
                const auto mesh = posed(vertices, triangles, 0, motion->center[0]);
                set_rigid(add_node(called, figure_, document_.add_mesh(called, mesh, parts)), *motion);
                return {};
            }
        return add_morphed(called, vertices, triangles, parts);
    }

    /// Vertices in a frame, about a point.
    TriangleMesh posed(const Indices& vertices, const Indices& triangles, std::size_t frame,
                       const Vec3<double>& about = {}) const {
        TriangleMesh mesh;
        for (const auto i : vertices) mesh.positions.push_back(cast<float>(position(frame, i) - about));
        mesh.normals = normals_of(mesh.positions, triangles);
        return mesh;
    }

    Failure add_morphed(const std::string& called, const Indices& vertices, const Indices& triangles,
                        const std::vector<GltfDocument::Part>& parts) {
        if (document_.bytes() + frames() * vertices.size() * sizeof(float) * 6 + 4 * frames() * frames() > max_bytes)
            return fmt::format(
                "{} frames of {} vertices are too much for a .glb, which has at most {} MB; a .pc2 takes "
                "them",
                frames(), vertices.size(), max_bytes >> 20);
        const auto first = posed(vertices, triangles, 0);
        std::vector<GltfDocument::Target> targets;
        bool moves = false;
        for (std::size_t frame = 1; frame < frames(); ++frame) {
            const auto now = posed(vertices, triangles, frame);
            GltfDocument::Target target;
            for (std::size_t i = 0; i < vertices.size(); ++i) {
                target.positions.push_back(now.positions[i] - first.positions[i]);
                target.normals.push_back(now.normals[i] - first.normals[i]);
                moves |= target.positions.back() != Vec3<float>{};
            }
            targets.push_back(std::move(target));
        }
        if (!moves) targets.clear();
        const int node = add_node(called, figure_, document_.add_mesh(called, first, parts, targets));
        if (!targets.empty()) document_.animate(node, "weights", one_at_a_time(targets.size()));
        return {};
    }

    /// Weights at frame i: target i is on, the others off; the first frame is the mesh itself.
    static std::vector<float> one_at_a_time(std::size_t targets) {
        std::vector<float> weights((targets + 1) * targets);
        for (std::size_t frame = 1; frame <= targets; ++frame) weights[frame * targets + frame - 1] = 1;
        return weights;
    }

    const MeshFilm& film_;
    std::vector<std::string>& notes_;
    GltfDocument document_;
    std::vector<int> materials_; ///< by group
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

Failure glb_of(const MeshFilm& film, double fps, std::string& bytes, std::vector<std::string>& notes) {
    return SceneWriter(film, fps, notes).write(bytes);
}

} // namespace sinew::files
