#include "bindings/c/simulation.h"

#include <map>

/// Pointers of the caller for objects of a simulation.
namespace sinew::c {

/// By kind of object and its id, which no later object has.
struct UserData {
    std::map<std::pair<int, std::uint64_t>, void*> pointers;
};

} // namespace sinew::c

using namespace sinew;
using namespace sinew::c;

namespace {

using Key = std::pair<int, std::uint64_t>;

template <class WorldT> std::optional<Key> key_of(const WorldT& world, int object, std::uint64_t id) {
    switch (object) {
    case SINEW_OF_PARTICLE:
        if (!row_of(world, id_of<ParticleTag>(id))) return std::nullopt;
        break;
    case SINEW_OF_CONSTRAINT:
        if (!constraint_state(world, constraint_of(id))) return std::nullopt;
        break;
    case SINEW_OF_COLLIDER:
        if (!world.collider_handles.find(id_of<ColliderTag>(id))) return std::nullopt;
        break;
    case SINEW_OF_FIGURE:
        if (id >= world.figures.size() || !has_figure(world, FigureIndex(id))) return std::nullopt;
        return Key{object, number_of(figure_id(world, FigureIndex(id)))};
    default:
        return std::nullopt;
    }
    return Key{object, id};
}

/// Calls work(simulation, key) for an object that exists.
template <class Work> sinew_status of_object(sinew_world simulation, int object, std::uint64_t id, const Work& work) {
    if (object < SINEW_OF_PARTICLE || object > SINEW_OF_FIGURE)
        return fail(SINEW_BAD_ARGUMENT, "no kind of object has this number");
    return read(simulation, [&](Simulation& known, const Session& session) {
        const auto key = std::visit([&](const auto& world) { return key_of(world, object, id); }, session.world());
        return key ? work(known, *key) : bad_id("object");
    });
}

} // namespace

extern "C" {

sinew_status sinew_world_set_user_data(sinew_world simulation, sinew_object object, uint64_t id, void* data) {
    return of_object(simulation, object, id, [&](Simulation& known, const Key& key) {
        if (!known.user_data) known.user_data = std::make_shared<UserData>();
        if (data)
            known.user_data->pointers[key] = data;
        else
            known.user_data->pointers.erase(key);
        return SINEW_OK;
    });
}

sinew_status sinew_world_get_user_data(sinew_world simulation, sinew_object object, uint64_t id, void** data) {
    if (!data) return null_argument();
    return of_object(simulation, object, id, [&](const Simulation& known, const Key& key) {
        *data = nullptr;
        if (!known.user_data) return SINEW_OK;
        const auto found = known.user_data->pointers.find(key);
        if (found != known.user_data->pointers.end()) *data = found->second;
        return SINEW_OK;
    });
}

} // extern "C"
