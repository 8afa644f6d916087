// SPDX-License-Identifier: GPL-3.0-or-later
// The solver's scene as a Python class; users see it through icesolve/scene.py. Numbers in SI.
#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>

#include "common/base/error.hpp"
#include "common/base/parallel.hpp"
#include "solver/case/read_case.hpp"
#include "solver/run/check_start.hpp"
#include "solver/run/make_world.hpp"
#include "solver/run/run.hpp"

namespace py = pybind11;

namespace {

ice::World* open_world(const std::string& file, const std::vector<std::string>& overrides,
                       int threads) {
    // The same checks as icesolve's: a scene that it would refuse never reaches Python.
    ice::set_thread_count(threads);
    auto world = std::make_unique<ice::World>(ice::build_world(ice::read_case(file, overrides)));
    ice::check_start(*world, false);
    world->applied_loads.resize(world->scene.bodies.size());
    return world.release();
}

// One row per body of `width` numbers that lie `stride` bytes apart, in the world's own memory.
py::array rows(py::object owner, double* first, std::size_t count, std::size_t width,
               std::size_t stride, bool writable) {
    // A view, not a copy: `owner` keeps the world alive as long as an array of it is.
    const std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(count),
                                         static_cast<py::ssize_t>(width)};
    const std::vector<py::ssize_t> strides{static_cast<py::ssize_t>(stride), sizeof(double)};
    py::array_t<double> view(shape, strides, first, owner);
    if (!writable) view.attr("setflags")(py::arg("write") = false);
    return view;
}

template <class Value>
py::array values(py::object owner, std::vector<Value>& of_bodies) {
    py::array_t<Value> view(static_cast<py::ssize_t>(of_bodies.size()), of_bodies.data(), owner);
    view.attr("setflags")(py::arg("write") = false);
    return view;
}

// A property that shows one row of the bodies' vectors each, read-only.
template <class Member>
auto vectors(Member member) {
    return [member](py::object self) {
        auto& of_bodies = self.cast<ice::World&>().scene.bodies.*member;
        using Row = typename std::remove_reference_t<decltype(of_bodies)>::value_type;
        return rows(self, reinterpret_cast<double*>(of_bodies.data()), of_bodies.size(),
                    sizeof(Row) / sizeof(double), sizeof(Row), false);
    };
}

template <class Member>
auto applied(Member member) {
    return [member](py::object self) {
        auto& loads = self.cast<ice::World&>().applied_loads;
        return rows(self, (loads.front().*member).data(), loads.size(), 3, sizeof(ice::WaterLoad),
                    true);
    };
}

// One contact: bodies, place [m], normal, gap [m] at the step's start, impulses on b [N s].
struct TouchRow {
    std::int32_t a, b;
    double point[3], normal[3], gap, normal_impulse, friction_impulse[3];
};

void copy(const ice::Vec3& from, double (&to)[3]) {
    for (int k = 0; k < 3; ++k) to[k] = from[k];
}

py::array_t<TouchRow> contacts(const ice::World& world) {
    // Before the first step there are contacts without constraints, or neither.
    const std::size_t count = std::min(world.contacts.size(), world.constraints.size());
    py::array_t<TouchRow> out(static_cast<py::ssize_t>(count));
    for (std::size_t k = 0; k < count; ++k) {
        const ice::Contact& at = world.contacts[k];
        const ice::Constraint& with = world.constraints[k];
        TouchRow& row = out.mutable_at(static_cast<py::ssize_t>(k));
        row.a = at.a;
        row.b = at.b;
        row.gap = at.gap;
        row.normal_impulse = with.total_normal();
        copy(at.point, row.point);
        copy(at.normal, row.normal);
        copy(with.total_tangent(), row.friction_impulse);
    }
    return out;
}

py::dict forces(const ice::World& world) {
    const ice::StepRecord now = ice::measure_step(world);
    py::dict out;
    out["contact"] = now.contact_force;
    out["friction"] = now.friction_force;
    out["moment"] = now.moment;
    return out;
}

double energy_residual(const ice::World& world) {
    return world.ledger.residual(ice::potential_energy(world.scene, world.parameters));
}

}  // namespace

PYBIND11_MODULE(_world, m) {
    // errors of input become Python's ValueError, with fault and remedy as text
    py::register_exception_translator([](std::exception_ptr error) {
        try {
            if (error) std::rethrow_exception(error);
        } catch (const ice::Error& fault) {
            PyErr_SetString(PyExc_ValueError, fault.what());
        }
    });
    PYBIND11_NUMPY_DTYPE(TouchRow, a, b, point, normal, gap, normal_impulse, friction_impulse);
    using ice::Bodies, ice::WaterLoad, ice::World;
    py::class_<World>(m, "World")
        .def(py::init(&open_world), py::arg("case"), py::arg("overrides"), py::arg("threads"))
        // a step needs no Python object: other threads run meanwhile
        .def("step", &ice::step, py::call_guard<py::gil_scoped_release>())
        .def("forces", &forces)
        .def("contacts", &contacts)
        .def("energy_residual", &energy_residual)
        .def_readonly("time", &World::time)
        .def_readonly("steps", &World::steps)
        .def_property_readonly("time_step", [](const World& w) { return w.parameters.time_step; })
        .def_property_readonly("duration", [](const World& w) { return w.parameters.duration; })
        .def_property_readonly("dimension", [](const World& w) { return w.scene.dimension; })
        .def_property_readonly("ship_work", [](const World& w) { return w.ledger.ship_work; })
        .def_property_readonly("applied_work", [](const World& w) { return w.ledger.applied_work; })
        .def_property_readonly("position", vectors(&Bodies::position))
        .def_property_readonly("orientation_xyzw", vectors(&Bodies::orientation))
        .def_property_readonly("velocity", vectors(&Bodies::velocity))
        .def_property_readonly("angular_velocity", vectors(&Bodies::angular_velocity))
        .def_property_readonly(
            "mass",
            [](py::object self) { return values(self, self.cast<World&>().scene.bodies.mass); })
        .def_property_readonly(
            "held",
            [](py::object self) { return values(self, self.cast<World&>().scene.bodies.held); })
        .def_property_readonly("applied_force", applied(&WaterLoad::force))
        .def_property_readonly("applied_moment", applied(&WaterLoad::moment));
}
