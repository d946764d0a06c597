// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/python/bindings.hpp"
#include "apps/run/stage_watch.hpp"
#include "apps/scenario/problems.hpp"
#include "apps/scenario/units.hpp"
#include "apps/viewer/view_error.hpp"
#include "dynamics/checkpoint/checkpoint_file.hpp"
#include "dynamics/measures/diverged.hpp"
#include "dynamics/output/file.hpp"
#include "geometry/base/regular_file.hpp"
#include "geometry/base/state_tree.hpp"
#include "geometry/mesh/io/import.hpp"
#include "geometry/mesh/io/mesh_file.hpp"

#include <exception>
#include <initializer_list>
#include <stdexcept>
#include <string_view>

namespace plekton::python {
namespace {

/// The classes, kept as long as the interpreter lives.
struct ErrorClasses {
  PyObject* error;
  PyObject* input;
  PyObject* mesh;
  PyObject* diverged;
  PyObject* output;
  PyObject* checkpoint;
};
ErrorClasses classes;

PyObject* add_class(py::module_& module, const char* name, const char* doc,
                    std::initializer_list<PyObject*> bases) {
  py::tuple all(bases.size());
  std::size_t i = 0;
  for (PyObject* base : bases) all[i++] = py::reinterpret_borrow<py::object>(base);
  PyObject* made =
      PyErr_NewExceptionWithDoc(("plekton." + std::string(name)).c_str(), doc, all.ptr(), nullptr);
  if (made == nullptr) throw py::error_already_set();
  module.add_object(name, made);
  return made;
}

/// Names of files in a message may be any bytes: those that are no UTF-8 become what they are in the
/// names that Python has of files.
void set_error(PyObject* type, std::string_view text) {
  const auto message = py::reinterpret_steal<py::object>(
      PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "surrogateescape"));
  if (message) PyErr_SetObject(type, message.ptr());
}

void set_diverged(const dynamics::Diverged& error) {
  const py::object made = py::reinterpret_borrow<py::object>(classes.diverged)(error.what());
  made.attr("step") = error.step();
  made.attr("node") = geometry::index_of(error.node());
  PyErr_SetObject(classes.diverged, made.ptr());
}

/// What is derived before what it is derived from. Lack of memory is left to pybind11.
void translate(std::exception_ptr pointer) {
  if (!pointer) return;
  try {
    std::rethrow_exception(pointer);
  } catch (const dynamics::Diverged& error) {
    set_diverged(error);
  } catch (const geometry::UnwrittenMesh& error) {
    set_error(classes.output, error.what());
  } catch (const geometry::MeshError& error) {
    set_error(classes.mesh, error.what());
  } catch (const dynamics::OutputError& error) {
    set_error(classes.output, error.what());
  } catch (const dynamics::CheckpointError& error) {
    set_error(classes.checkpoint, error.what());
  } catch (const geometry::StateMismatch& error) {
    set_error(classes.checkpoint, error.what());
  } catch (const apps::InputError& error) {
    set_error(classes.input, error.what());
  } catch (const apps::UnitError& error) {
    set_error(classes.input, error.what());
  } catch (const apps::ViewError& error) {
    set_error(classes.input, error.what());
  } catch (const geometry::UnreadableFile& error) {
    set_error(classes.input, error.what());
  } catch (const std::invalid_argument& error) {
    set_error(classes.input, error.what());
  } catch (const std::out_of_range& error) {
    set_error(classes.input, error.what());
  } catch (const apps::StageFailed& error) {
    set_error(classes.error, error.what());
  } catch (const std::logic_error& error) {
    set_error(classes.error, error.what());
  }
}

}  // namespace

void bind_errors(py::module_& module) {
  classes.error = add_class(module, "Error", "Anything that plekton refuses or fails at.",
                            {PyExc_RuntimeError});
  classes.input =
      add_class(module, "InputError",
                "What was given cannot be used: a scenario, a number, a file. The message lists "
                "every problem, a line each.",
                {classes.error, PyExc_ValueError});
  classes.mesh = add_class(module, "MeshError", "A mesh that cannot be read, repaired or used.",
                           {classes.input});
  classes.diverged =
      add_class(module, "Diverged",
                "The simulation has become meaningless. `step` and `node` say where it was seen.",
                {classes.error});
  classes.output = add_class(module, "OutputError", "A result could not be written.",
                             {classes.error, PyExc_OSError});
  classes.checkpoint =
      add_class(module, "CheckpointError",
                "A checkpoint that cannot be read, or is one of another scene.", {classes.error});
  py::register_local_exception_translator(&translate);
}

}  // namespace plekton::python
