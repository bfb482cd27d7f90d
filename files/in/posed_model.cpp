#include "files/in/posed_model.h"

#include "sinew/math/format.h"
#include "sinew/scene/text.h"
#include "sinew/world/edit.h"

#include "files/in/bone_turns.h"
#include "files/in/gltf_amending.h"
#include "files/in/gltf_nodes.h"
#include "files/out/model_space.h"
#include "files/out/rigid_fit.h"

#include <algorithm>

namespace sinew::files {
namespace {

using Positions = std::vector<Vec3<double>>;

Vec<4, double> inverse(const Vec<4, double>& q) {
    return {{-q[0], -q[1], -q[2], q[3]}};
}

/// Rotation of a map without its scale; its columns are at right angles.
Vec<4, double> rotation_of(const Affine3& map) {
    const auto x = direction(map.x), z = direction(cross(map.x, map.y));
    const auto first = shortest_turn({{1, 0, 0}}, x);
    const auto z_now = turned(first, {{0, 0, 1}});
    if (dot(z_now, z) < -1 + 1e-12) return product({{x[0], x[1], x[2], 0}}, first);
    return product(shortest_turn(z_now, z), first);
}

/// A point in the coordinates of a map.
Vec3<double> local(const Affine3& map, const Vec3<double>& point) {
    const auto p = point - map.origin;
    const double volume = dot(cross(map.x, map.y), map.z);
    return Vec3<double>{{dot(p, cross(map.y, map.z)), dot(p, cross(map.z, map.x)), dot(p, cross(map.x, map.y))}} *
           inverse_or_zero(volume);
}

/// A ragdoll and the skeleton that it was made of.
struct Posed {
    std::string figure;
    std::vector<std::string> particles; ///< of joints, then of tips
    std::vector<std::size_t> nodes;     ///< of joints
    BoneTurns turns;
    std::vector<Positions> frames{};
};

/// Points of a skeleton that have particles, and its tips, which the figure may have.
Posed posed_of(const GltfSkeleton& skeleton) {
    const auto known = joint_particles(skeleton.joints, 1);
    std::vector<std::optional<std::size_t>> point_of(skeleton.joints.size());
    std::vector<BonePoint> points;
    Posed posed{.figure = {}, .particles = {}, .nodes = {}, .turns = BoneTurns({})};
    for (std::size_t i = 0; i < skeleton.joints.size(); ++i) {
        const auto above = skeleton.joints[i].parent;
        const auto parent = above ? point_of[*above] : std::nullopt;
        point_of[i] = parent;
        if (!known.is_own[i]) continue;
        point_of[i] = points.size();
        points.push_back({parent, skeleton.joints[i].at});
        posed.particles.push_back(known.names[i]);
        posed.nodes.push_back(skeleton.nodes[i]);
    }
    posed.turns = BoneTurns(std::move(points));
    return posed;
}

class PosedModel final : public Exporter {
  public:
    PosedModel(ExportRequest request, ImportFile model)
        : request_(std::move(request)), file_(std::move(model)), data_(file_), nodes_(data_.root()) {
        for (const auto& skeleton : nodes_.skeletons) skeletons_.push_back(posed_of(skeleton));
        std::erase_if(skeletons_, [](const Posed& posed) { return posed.nodes.size() < 2; });
        if (skeletons_.empty()) throw ImportError{"", "there is no skeleton in it for a ragdoll to move"};
    }

    Failure frame(const Session& session) override {
        if (frames_++ == 0)
            for (auto& posed : skeletons_) find_figure_of(posed, session);
        if (std::ranges::all_of(skeletons_, [](const Posed& posed) { return posed.figure.empty(); }))
            return concat("no figure has particles for the joints of ", file_.name,
                          ": the scene must be one that was imported from it");
        for (auto& posed : skeletons_)
            if (!posed.figure.empty()) {
                auto now = positions(posed, session);
                if (now.empty())
                    return format_text("{} has lost a joint at {:4} s: end before (--seconds)", posed.figure,
                                       session.seconds());
                posed.frames.push_back(std::move(now));
            }
        return {};
    }

    Failure finish() override {
        try {
            AmendedGltf document(data_, file_);
            std::vector<float> seconds;
            for (std::size_t i = 0; i < frames_; ++i) seconds.push_back(float(double(i) / request_.fps));
            document.set_times(seconds);
            for (auto& posed : skeletons_) {
                if (!posed.figure.empty())
                    animate(posed, document);
                else
                    notes_.push_back("no figure moves the skeleton with the joint " + posed.particles[0]);
            }
            written_ = {request_.path};
            return request_.take(request_.path, std::move(document).glb());
        } catch (const ImportError& error) {
            return concat(file_.name, ": ", error.place, ": ", error.message);
        } catch (const nlohmann::json::exception&) {
            return file_.name + ": its JSON is not that of a glTF file";
        }
    }

  private:
    const ExportRequest request_;
    const ImportFile file_;
    const GltfData data_;
    const GltfNodes nodes_;
    std::vector<Posed> skeletons_;
    std::size_t frames_ = 0;

    bool is_wanted(const std::string& figure) const {
        const bool is_named = request_.figures.empty() || std::ranges::count(request_.figures, figure) > 0;
        return is_named && std::ranges::count(skeletons_, figure, &Posed::figure) == 0;
    }

    /// The first figure with all particles of the skeleton that moves no other one.
    void find_figure_of(Posed& posed, const Session& session) {
        std::visit(
            [&](const auto& world) {
                for (const auto& figure : world.figures) {
                    if (!figure.in_use() || !is_wanted(figure.name)) continue;
                    const bool is_it = std::ranges::all_of(posed.particles, [&](const std::string& name) {
                        return find_particle(world, concat(figure.name, "/", name)).has_value();
                    });
                    if (!is_it) continue;
                    posed.figure = figure.name;
                    return add_tips(posed, world);
                }
            },
            session.world());
    }

    /// Ends of heads, hands and feet, which have no joint: a bone without a child turns with them.
    template <class WorldT> static void add_tips(Posed& posed, const WorldT& world) {
        auto points = posed.turns.points();
        for (std::size_t i = 0; i < posed.nodes.size(); ++i) {
            const auto parent = points[i].parent;
            const auto name = posed.particles[i] + "_end";
            if (!parent || std::ranges::count(posed.particles, name) > 0) continue;
            if (!find_particle(world, concat(posed.figure, "/", name))) continue;
            posed.particles.push_back(name);
            points.push_back({i, points[i].at * 1.5 - points[*parent].at * 0.5}); // as skeleton.cpp has it
        }
        posed.turns = BoneTurns(std::move(points));
    }

    /// Metres, y upwards; none where a particle is missing.
    static Positions positions(const Posed& posed, const Session& session) {
        const ModelSpace space(session.scene());
        Positions result;
        std::visit(
            [&]<int D, class Real>(const World<D, Real>& world) {
                for (const auto& name : posed.particles) {
                    const auto id = find_particle(world, concat(posed.figure, "/", name));
                    const auto row = id ? row_of(world, *id) : std::nullopt;
                    if (!row) return result.clear();
                    Vec3<double> p{};
                    for (int i = 0; i < D; ++i) p[i] = double(world.particles.position[*row][i]);
                    result.push_back(space.position(p));
                }
            },
            session.world());
        return result;
    }

    /// Translations and rotations of all joints, in the frame of the node above.
    void animate(Posed& posed, AmendedGltf& document) {
        Positions rest;
        for (const auto& point : posed.turns.points()) rest.push_back(point.at);
        const double scale = posed.turns.length(rest) * inverse_or_zero(posed.turns.length(posed.frames[0]));
        std::vector<std::vector<float>> translations(posed.nodes.size()), rotations(posed.nodes.size());
        std::vector<Vec<4, double>> before(posed.nodes.size());
        for (auto& frame : posed.frames) {
            for (auto& p : frame) p = p * scale;
            const auto& turns = posed.turns.follow(frame);
            std::vector<std::optional<std::size_t>> point_of(nodes_.maps.size());
            for (std::size_t k = 0; k < posed.nodes.size(); ++k) point_of[posed.nodes[k]] = k;
            auto maps = nodes_.maps;
            for (const auto i : nodes_.order) {
                const auto parent = nodes_.parents[i];
                const auto above = parent ? *maps[*parent] : Affine3{};
                if (const auto k = point_of[i]) {
                    maps[i] = turned_map(turns[*k], *nodes_.maps[i], frame[*k]);
                    put(translations[*k], local(above, frame[*k]));
                    auto q = product(inverse(rotation_of(above)), rotation_of(*maps[i]));
                    q = nearest_sign(q, before[*k]);
                    put(rotations[*k], q);
                    before[*k] = q;
                } else if (parent) {
                    maps[i] = above * GltfData::matrix_of(data_.root()["nodes"][i]);
                }
            }
        }
        for (std::size_t k = 0; k < posed.nodes.size(); ++k) {
            const auto node = posed.nodes[k];
            const auto map = GltfData::matrix_of(data_.root()["nodes"][node]);
            document.split_matrix(node, map.origin, rotation_of(map), {{norm(map.x), norm(map.y), norm(map.z)}});
            document.animate(node, "translation", translations[k]);
            document.animate(node, "rotation", rotations[k]);
        }
    }

    static Affine3 turned_map(const Vec<4, double>& turn, const Affine3& rest, const Vec3<double>& at) {
        return {turned(turn, rest.x), turned(turn, rest.y), turned(turn, rest.z), at};
    }

    template <int N> static void put(std::vector<float>& numbers, const Vec<N, double>& v) {
        for (const double c : v.component) numbers.push_back(float(c));
    }
};

} // namespace

std::unique_ptr<Exporter> open_posed_model(const ExportRequest& request, const ImportFile& model) {
    return std::make_unique<PosedModel>(request, model);
}

} // namespace sinew::files
