// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

/// plekton/_core, of which plekton/__init__.py makes the module that users see. Nothing is computed
/// here: all of it calls what the program calls.
namespace plekton::python {

namespace py = pybind11;

void bind_errors(py::module_& module);
void bind_simulation(py::module_& module);
void bind_stages(py::module_& module);
void bind_geometry(py::module_& module);
void bind_meshes(py::module_& module);
void bind_results(py::module_& module);

}  // namespace plekton::python
