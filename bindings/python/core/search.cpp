#include "bindings/python/core/simulation.h"

/// Contacts and queries.
namespace sinew::python {
namespace {

py::object id_or_none(std::uint64_t id) {
    return id == SINEW_NO_ID ? py::object(py::none()) : py::object(py::int_(id));
}
py::object index_or_none(std::uint32_t index) {
    return index == ~0u ? py::object(py::none()) : py::object(py::int_(index));
}
py::tuple tuple_of(const sinew_point& point) {
    return py::make_tuple(point.x, point.y, point.z);
}

py::list contacts(Simulation& simulation) {
    const Hold hold(simulation.mutex());
    std::uint32_t count = 0;
    check(sinew_world_contact_count(simulation.handle(), &count));
    py::list all;
    for (std::uint32_t index = 0; index < count; ++index) {
        sinew_contact contact{};
        check(sinew_world_contact_at(simulation.handle(), index, &contact));
        all.append(py::make_tuple(contact.phase, contact.impulse, contact.blow, contact.blow_before,
                                  id_or_none(contact.particle), id_or_none(contact.other), id_or_none(contact.collider),
                                  index_or_none(contact.figure), index_or_none(contact.other_figure),
                                  contact.collider_name));
    }
    return all;
}

py::object nearest_particle(Simulation& simulation, const Points& at, double reach) {
    sinew_particle particle = 0;
    double distance = 0;
    const bool found =
        simulation.finds(sinew_world_nearest_particle, point_of(at, "a point"), reach, &particle, &distance);
    return found ? py::object(py::make_tuple(particle, distance)) : py::none();
}

py::object nearest_link(Simulation& simulation, const Points& at, double reach) {
    sinew_constraint link = 0;
    double t = 0, distance = 0;
    const bool found = simulation.finds(sinew_world_nearest_link, point_of(at, "a point"), reach, &link, &t, &distance);
    return found ? py::object(py::make_tuple(link, t, distance)) : py::none();
}

py::object cast_ray(Simulation& simulation, const Points& from, const Points& to, double radius, std::uint32_t mask) {
    sinew_ray_hit hit{};
    if (!simulation.finds(sinew_world_cast_ray, point_of(from, "a point"), point_of(to, "a point"), radius, mask, &hit))
        return py::none();
    return py::make_tuple(hit.share, tuple_of(hit.point), tuple_of(hit.normal), id_or_none(hit.particle),
                          id_or_none(hit.collider));
}

/// Ids of the particles, or links, that touch a region.
template <class Function> Ids overlapping(Simulation& simulation, Function function, const sinew_region& region) {
    const Hold hold(simulation.mutex());
    std::size_t count = 0;
    check(function(simulation.handle(), &region, nullptr, 0, &count));
    Ids ids{py::ssize_t(count)};
    if (count > 0) check(function(simulation.handle(), &region, ids.mutable_data(), count, &count));
    return ids;
}

sinew_region region_of(const Points& center, const Points& half, double radius, double turn, const Points& axis) {
    return {point_of(center, "a centre"), point_of(half, "half of the edges"), radius, turn, point_of(axis, "an axis")};
}

} // namespace

void bind_search(py::class_<Simulation, std::shared_ptr<Simulation>>& type) {
    type.def("list_contacts",
             [](Simulation& self, bool on) { self.call(sinew_world_list_contacts, std::uint32_t(on)); })
        .def("contacts", contacts)
        .def("nearest_particle", nearest_particle)
        .def("nearest_link", nearest_link)
        .def("cast_ray", cast_ray)
        .def("particles_in",
             [](Simulation& self, const Points& center, const Points& half, double radius, double turn,
                const Points& axis) {
                 return overlapping(self, sinew_world_overlapping_particles,
                                    region_of(center, half, radius, turn, axis));
             })
        .def("links_in", [](Simulation& self, const Points& center, const Points& half, double radius, double turn,
                            const Points& axis) {
            return overlapping(self, sinew_world_overlapping_links, region_of(center, half, radius, turn, axis));
        });
}

} // namespace sinew::python
