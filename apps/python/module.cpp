// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/python/bindings.hpp"
#include "apps/run/build_info.hpp"
#include "geometry/version.hpp"

PYBIND11_MODULE(_core, module) {
  using namespace plekton::python;
  module.doc() = "What plekton is made of; import plekton instead.";
  module.attr("__version__") = std::string(plekton::kVersion);
  bind_errors(module);
  bind_simulation(module);
  bind_stages(module);
  bind_geometry(module);
  bind_meshes(module);
  bind_results(module);
}
