#include "bindings/python/core/simulation.h"

/// Edits, pins, colliders and the pointer.
namespace sinew::python {
namespace {

/// Calls function(handle, id, point) for ids and rows of points: as many points as ids, or one for all. Nothing is
/// changed where an id or a number is wrong.
template <class Function>
void for_points(Simulation& simulation, Function function, const Ids& ids, const Points& points) {
    const Hold hold(simulation.mutex());
    const bool is_one = points.shape(0) == 1;
    check_points(points, is_float(simulation.handle()));
    for (py::ssize_t i = 0; i < ids.size(); ++i) {
        std::uint32_t row = 0;
        check(sinew_world_row_of(simulation.handle(), ids.data()[i], &row));
    }
    for (py::ssize_t i = 0; i < ids.size(); ++i)
        check(function(simulation.handle(), ids.data()[i], point_at(points, is_one ? 0 : i)));
}

template <class Function> auto edit_points(Function function) {
    return
        [function](Simulation& self, const Ids& ids, const Points& points) { for_points(self, function, ids, points); };
}

std::uint64_t add_particle(Simulation& simulation, const Points& position, const Points& velocity, double mass,
                           double radius) {
    const sinew_particle_spec spec{point_of(position, "a position"), point_of(velocity, "a velocity"), mass, radius};
    return simulation.ask<sinew_particle>(sinew_world_add_particle, &spec);
}

std::uint64_t add_constraint(Simulation& simulation, std::uint32_t kind, const Ids& particles, double low, double high,
                             double compliance, double max_force, double breaking_strain) {
    const sinew_constraint_spec spec{low, high, compliance, max_force, breaking_strain};
    return simulation.ask<sinew_constraint>(sinew_world_add_constraint, kind, particles.data(),
                                            std::size_t(particles.size()), &spec);
}

void move_collider(Simulation& simulation, std::uint64_t collider, const Points& position, double turn,
                   const Points& axis) {
    const auto about = point_of(axis, "an axis");
    simulation.call(sinew_world_move_collider, collider, point_of(position, "a position"), turn, &about);
}

} // namespace

void bind_edit(py::class_<Simulation, std::shared_ptr<Simulation>>& type) {
    type.def("add_particle", add_particle)
        .def("add_constraint", add_constraint)
        .def("remove_particle", [](Simulation& self, std::uint64_t id) { self.call(sinew_world_remove_particle, id); })
        .def("remove_constraint",
             [](Simulation& self, std::uint64_t id) { self.call(sinew_world_remove_constraint, id); })
        .def("set_positions", edit_points(sinew_world_set_position))
        .def("set_velocities", edit_points(sinew_world_set_velocity))
        .def("apply_forces", edit_points(sinew_world_apply_force))
        .def("apply_impulses", edit_points(sinew_world_apply_impulse))
        .def("set_mass",
             [](Simulation& self, std::uint64_t id, double mass) { self.call(sinew_world_set_mass, id, mass); })
        .def("pin",
             [](Simulation& self, std::uint64_t id) { return self.ask<sinew_pin>(sinew_world_pin_particle, id); })
        .def("move_pin", [](Simulation& self, std::uint64_t pin,
                            const Points& to) { self.call(sinew_world_move_pin, pin, point_of(to, "a target")); })
        .def("unpin", [](Simulation& self, std::uint64_t pin) { self.call(sinew_world_unpin, pin); })
        .def("find_collider",
             [](Simulation& self, const std::string& name) {
                 return self.ask<sinew_collider>(sinew_world_find_collider, name.c_str());
             })
        .def("move_collider", move_collider)
        .def("grab", [](Simulation& self, const Points& at,
                        double radius) { return self.finds(sinew_world_grab, point_of(at, "a point"), radius); })
        .def("grab_particle",
             [](Simulation& self, std::uint64_t id) { return self.finds(sinew_world_grab_particle, id); })
        .def("drag", [](Simulation& self, const Points& to) { self.call(sinew_world_drag, point_of(to, "a point")); })
        .def("let_go", [](Simulation& self) { self.call(sinew_world_let_go); })
        .def("point_at",
             [](Simulation& self, const Points& at) { self.call(sinew_world_point_at, point_of(at, "a point")); })
        .def("cut",
             [](Simulation& self, const Points& from, const Points& to) {
                 return self.ask<std::uint32_t>(sinew_world_cut, point_of(from, "a point"), point_of(to, "a point"));
             })
        .def("set", [](Simulation& self, const std::string& pair) { self.call(sinew_world_set, pair.c_str()); });
}

} // namespace sinew::python
