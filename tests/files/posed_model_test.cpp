#include "sinew/session/session.h"

#include "files/in/posed_model.h"
#include "tests/files/imported.h"
#include "tests/files/moving_nodes.h"

#include <map>

/// A model whose skeleton was imported goes out again, moved by its ragdoll.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

constexpr float fps = 30;

files::ImportFile model_file(const std::string& name) {
    const std::filesystem::path path = std::filesystem::path(source_dir()) / "tests/files/gltf" / name;
    return {name, "it", text_of(path), path.parent_path()};
}

using Places = std::map<std::string, Vec3<double>>;

Places places_of(const Session& session) {
    Places places;
    std::visit(
        [&]<int D, class Real>(const World<D, Real>& world) {
            for (const auto& [name, id] : world.figures[0].particle_names) {
                Vec3<double> p{};
                for (int i = 0; i < D; ++i) p[i] = double(world.particles.position[*row_of(world, id)][i]);
                places[std::string(name)] = p;
            }
        },
        session.world());
    return places;
}

struct Fall {
    std::string bytes;
    std::vector<Places> seen;
};

/// Falls for so many frames.
Fall fall_of(const std::string& name, int frames) {
    auto opened = open_imported(files::import_file(model_file(name)));
    Session session(std::move(*opened));
    Fall fall;
    files::ExportRequest request{.path = "fall.glb", .fps = double(fps)};
    request.take = [&](const std::filesystem::path&, std::string_view bytes) {
        fall.bytes = bytes;
        return files::Failure();
    };
    const auto exporter = files::open_posed_model(request, model_file(name));
    for (int i = 0; i < frames; ++i) {
        EXPECT_EQ(exporter->frame(session), std::nullopt);
        fall.seen.push_back(places_of(session));
        session.step(), session.step();
    }
    EXPECT_EQ(exporter->finish(), std::nullopt);
    return fall;
}

std::string particle_called(std::string name) {
    for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' ? c : '_';
    return name;
}

TEST(PosedModel, JointsAreWhereTheRagdollsParticlesWere) {
    for (const char* name : {"human.glb", "rigged.glb"}) {
        const auto fall = fall_of(name, 30);
        const GlbFile file(fall.bytes);
        std::size_t compared = 0;
        double moved = 0;
        for (std::size_t frame = 0; frame < fall.seen.size(); frame += 29)
            for (const auto& joint : file.json["skins"][0]["joints"]) {
                const auto called = file.json["nodes"][joint.get<std::size_t>()]["name"].get<std::string>();
                const auto found = fall.seen[frame].find(particle_called(called));
                if (found == fall.seen[frame].end()) continue; // fingers
                const auto at = world_pose(file, joint.get<std::size_t>(), float(frame) / fps).at;
                EXPECT_LE(norm(at - found->second), 1e-4) << name << " " << called << " " << frame;
                moved = max(moved, norm(found->second - fall.seen[0].at(found->first)));
                ++compared;
            }
        EXPECT_GE(compared, 40u) << name;
        EXPECT_GT(moved, 0.3) << name; // metres
    }
}

TEST(PosedModel, KeepsTheModelAndItsPoseAtRest) {
    for (const char* name : {"human.glb", "rigged.glb"}) {
        const GlbFile before(model_file(name).bytes), after(fall_of(name, 1).bytes);
        for (const char* part : {"meshes", "skins", "materials", "scenes"})
            EXPECT_EQ(before.json.value(part, GlbFile::Json()), after.json.value(part, GlbFile::Json())) << part;
        EXPECT_EQ(after.binary.substr(0, before.binary.size()), before.binary);
        for (const auto& joint : before.json["skins"][0]["joints"]) {
            const auto rest = world_pose(before, joint.get<std::size_t>(), 0),
                       now = world_pose(after, joint.get<std::size_t>(), 0);
            EXPECT_LE(norm(rest.at - now.at), 1e-5);
            EXPECT_LE(1 - absolute(dot(rest.turn.number, now.turn.number)), 1e-6);
        }
    }
}

TEST(PosedModel, RefusesAModelWithoutSkeletonAndASceneWithoutItsFigure) {
    EXPECT_THROW(files::open_posed_model({.path = "a.glb"}, model_file("tablecloth.gltf")), files::ImportError);
    auto opened = open_imported(import_sample("obj/napkin.obj"));
    const Session session(std::move(*opened));
    const auto exporter = files::open_posed_model({.path = "a.glb"}, model_file("human.glb"));
    EXPECT_NE(exporter->frame(session)->find("no figure has particles for the joints"), std::string::npos);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
