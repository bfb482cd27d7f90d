#include "bindings/python/core/pinned_memory.h"
#include "bindings/python/core/simulation.h"

#include <cstring>
#include <pybind11/stl.h>

/// Reading: columns, names, particles, constraints, figures, events.
namespace sinew::python {
namespace {

/// An array on the memory of the simulation, which cannot be written to: edits wake sleeping bodies, and more.
py::array array_on(const sinew_view& view, const std::vector<py::ssize_t>& shape) {
    pin_memory(view.data);
    const py::capsule pin(view.data, [](void* block) { unpin_memory(block); });
    py::array array(type_of(view), shape, view.data, pin);
    array.attr("setflags")(py::arg("write") = false);
    return array;
}

/// The values of get(index, &value) for 0 <= index < count, as one array.
template <class Get> Ids ids_of(std::uint32_t count, const Get& get) {
    Ids ids{py::ssize_t(count)};
    auto* const out = ids.mutable_data();
    for (std::uint32_t i = 0; i < count; ++i) check(get(i, &out[i]));
    return ids;
}

std::uint32_t particle_count(sinew_world handle) {
    sinew_view view{};
    check(sinew_world_get_column(handle, SINEW_POSITION, &view));
    return view.rows;
}

Ids particle_ids(Simulation& simulation) {
    const Hold hold(simulation.mutex());
    const auto handle = simulation.handle();
    return ids_of(particle_count(handle),
                  [&](std::uint32_t row, std::uint64_t* id) { return sinew_world_particle_at(handle, row, id); });
}

py::array_t<std::int64_t> rows_of(Simulation& simulation, const Ids& ids) {
    const Hold hold(simulation.mutex());
    py::array_t<std::int64_t> rows(ids.size());
    for (py::ssize_t i = 0; i < ids.size(); ++i) {
        std::uint32_t row = 0;
        check(sinew_world_row_of(simulation.handle(), ids.data()[i], &row));
        rows.mutable_data()[i] = row;
    }
    return rows;
}

Ids constraint_ids(Simulation& simulation, std::uint32_t kind) {
    const Hold hold(simulation.mutex());
    std::uint32_t count = 0;
    check(sinew_world_constraint_count(simulation.handle(), kind, &count));
    return ids_of(count, [&](std::uint32_t row, std::uint64_t* id) {
        return sinew_world_constraint_at(simulation.handle(), kind, row, id);
    });
}

/// Names of all particles, by row; empty where there is none.
py::list particle_names(Simulation& simulation) {
    const Hold hold(simulation.mutex());
    py::list names;
    const auto count = particle_count(simulation.handle());
    for (std::uint32_t row = 0; row < count; ++row) {
        std::uint64_t id = 0;
        const char* name = nullptr;
        check(sinew_world_particle_at(simulation.handle(), row, &id));
        check(sinew_world_particle_name(simulation.handle(), id, &name));
        names.append(py::str(name));
    }
    return names;
}

/// Index, name, prefab and state of quarantine of each figure.
py::list figures(Simulation& simulation) {
    const Hold hold(simulation.mutex());
    sinew_info info{};
    check(sinew_world_get_info(simulation.handle(), &info));
    py::list all;
    for (std::uint32_t index = 0; index < info.figures; ++index) {
        sinew_figure figure{};
        if (sinew_world_figure_at(simulation.handle(), index, &figure) != SINEW_OK) continue;
        all.append(py::make_tuple(index, figure.name, figure.prefab, figure.is_quarantined != 0));
    }
    return all;
}

/// The same of the figure with this name, or None.
py::object find_figure(Simulation& simulation, const std::string& name) {
    const Hold hold(simulation.mutex());
    sinew_info info{};
    check(sinew_world_get_info(simulation.handle(), &info));
    for (std::uint32_t index = 0; index < info.figures; ++index) {
        sinew_figure figure{};
        if (sinew_world_figure_at(simulation.handle(), index, &figure) != SINEW_OK || name != figure.name) continue;
        return py::make_tuple(index, figure.name, figure.prefab, figure.is_quarantined != 0);
    }
    return py::none();
}

py::dict info(Simulation& simulation) {
    const auto now = simulation.ask<sinew_info>(sinew_world_get_info);
    return py::dict(py::arg("dimension") = now.dimension, py::arg("real_bytes") = now.real_bytes,
                    py::arg("particles") = now.particles, py::arg("constraints") = now.constraints,
                    py::arg("is_classic") = now.is_classic != 0, py::arg("y_is_down") = now.y_is_down != 0,
                    py::arg("rate") = now.rate, py::arg("seconds") = now.seconds, py::arg("per_metre") = now.per_metre,
                    py::arg("per_kilogram") = now.per_kilogram, py::arg("per_second") = now.per_second,
                    py::arg("size") = py::make_tuple(now.view_width, now.view_height), py::arg("asleep") = now.asleep);
}

py::tuple report(Simulation& simulation) {
    const auto now = simulation.ask<sinew_report>(sinew_world_get_report);
    return py::make_tuple(now.seconds, std::int64_t(now.steps), now.kinetic, now.potential, now.stored, now.energy_lost,
                          now.stretch_max, now.stretch_mean, now.max_speed);
}

py::list events(Simulation& simulation, std::uint32_t since) {
    const Hold hold(simulation.mutex());
    std::uint32_t count = 0;
    check(sinew_world_event_count(simulation.handle(), &count));
    py::list all;
    for (std::uint32_t index = since; index < count; ++index) {
        sinew_event event{};
        check(sinew_world_event_at(simulation.handle(), index, &event));
        all.append(py::make_tuple(event.seconds, event.what, event.where, event.islands, event.with, event.impulse));
    }
    return all;
}

/// A text that the simulation lends until its next call.
template <class Function> py::str text_of(Simulation& simulation, Function function) {
    const Hold hold(simulation.mutex());
    const char* text = nullptr;
    check(function(simulation.handle(), &text));
    return py::str(text);
}

} // namespace

py::array Simulation::column(int number) {
    const Hold hold(mutex_);
    if (ComputedColumns::has(number)) return computed_.show(handle_, number);
    sinew_view view{};
    check(sinew_world_get_column(handle_, sinew_column(number), &view));
    const auto shape = shape_of(view, number);
    return view.rows == 0 ? py::array(type_of(view), shape) : array_on(view, shape);
}

void bind_reading(py::module_& module, py::class_<Simulation, std::shared_ptr<Simulation>>& type) {
    type.def("info", info)
        .def("report", report)
        .def("hash", [](Simulation& self) { return self.ask<std::uint64_t>(sinew_world_state_hash); })
        .def("column", &Simulation::column)
        .def("particle_ids", particle_ids)
        .def("rows_of", rows_of)
        .def("particle_names", particle_names)
        .def("find_particle",
             [](Simulation& self, const std::string& name) {
                 return self.ask<sinew_particle>(sinew_world_find_particle, name.c_str());
             })
        .def("find_constraint",
             [](Simulation& self, const std::string& name) {
                 return self.ask<sinew_constraint>(sinew_world_find_constraint, name.c_str());
             })
        .def("constraint_ids", constraint_ids)
        .def("constraint",
             [](Simulation& self, std::uint64_t id) {
                 const auto state = self.ask<sinew_constraint_state>(sinew_world_get_constraint, id);
                 return py::make_tuple(state.measure, state.error, state.strain, state.tension);
             })
        .def("figures", figures)
        .def("find_figure", find_figure)
        .def("events", events)
        .def("scene_text", [](Simulation& self) { return text_of(self, sinew_world_scene_text); })
        .def("parameters", [](Simulation& self) { return text_of(self, sinew_world_parameters); });
    module.def("describe", [](const std::string& topic) {
        const char* text = nullptr;
        check(sinew_describe(topic.c_str(), &text));
        return py::str(text);
    });
}

} // namespace sinew::python
