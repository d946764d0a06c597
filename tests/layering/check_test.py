# SPDX-License-Identifier: GPL-3.0-or-later
"""The checker finds violations that are put there, and only those."""

import re
import sys
import tempfile
import unittest
from pathlib import Path

from check import violations
from rules import CGAL_CORE_HEADERS, SPDX

TAG = f"// {SPDX}\n"
CGAL_FOLDER = Path("/usr/include")


class SeededTree(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        for name in ("geometry/primitives/box.hpp", "contact/sphere_surface/patch.hpp", "dynamics/model/scene.hpp", "geometry/mesh/repair/repair.hpp", "tests/support/lattice.hpp"):
            self.write(name, TAG)

    def write(self, path, text):
        file = self.root / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")

    def violations_of(self, path, text):
        self.write(path, text)
        return violations(self.root)[0]

    def assert_flagged(self, path, text, reason):
        found = self.violations_of(path, text)
        self.assertEqual(len(found), 1, found)
        self.assertTrue(found[0].startswith(path), found[0])
        self.assertIn(reason, found[0])

    def assert_clean(self, path, text):
        self.assertEqual(self.violations_of(path, text), [])

    def test_a_clean_tree_has_no_violation(self):
        self.assert_clean("dynamics/model/scene.cpp", TAG + '#include "dynamics/model/scene.hpp"\n#include "contact/sphere_surface/patch.hpp"\n#include "geometry/primitives/box.hpp"\n')

    def test_includes_against_the_arrow_are_flagged(self):
        for path, header in (
            ("geometry/primitives/box.cpp", "contact/sphere_surface/patch.hpp"),
            ("contact/sphere_surface/patch.cpp", "dynamics/model/scene.hpp"),
            ("dynamics/model/scene.cpp", "tests/support/lattice.hpp"),
        ):
            with self.subTest(path=path):
                self.assert_flagged(path, TAG + f'#include "{header}"\n', "against the arrow")
                (self.root / path).unlink()

    def test_includes_against_the_order_of_the_folders_of_apps_are_flagged(self):
        for path in ("apps/scenario/units.hpp", "apps/run/run.hpp"):
            self.write(path, TAG)
        self.assert_clean("apps/run/frames.cpp", TAG + '#include "apps/scenario/units.hpp"\n#include "apps/run/run.hpp"\n')
        self.assert_clean("apps/main.cpp", TAG + '#include "apps/run/run.hpp"\n')
        self.assert_flagged("apps/scenario/units.cpp", TAG + '#include "apps/run/run.hpp"\n', "against the order of apps")

    def test_a_source_of_the_program_outside_its_folders_is_flagged(self):
        self.assert_clean("apps/examples/first_steps.cpp", TAG)
        self.assert_flagged("apps/units.cpp", TAG, "none of the folders of apps")

    def test_the_line_of_an_include_is_named_and_spaces_do_not_hide_it(self):
        self.assert_flagged("geometry/primitives/box.cpp", TAG + '\n  #  include <contact/sphere_surface/patch.hpp>\n', "geometry/primitives/box.cpp:3")

    def test_tests_may_include_everything(self):
        self.assert_clean("tests/geometry/primitives/box_test.cpp", TAG + '#include "dynamics/model/scene.hpp"\n#include <CGAL/Gmpq.h>\n')

    def test_an_include_that_does_not_start_at_the_root_is_flagged(self):
        self.assert_flagged("geometry/primitives/box.cpp", TAG + '#include "box.hpp"\n', "name it from there")

    def test_the_core_may_not_include_the_mesh_folder(self):
        self.assert_flagged("geometry/primitives/box.cpp", TAG + '#include "geometry/mesh/repair/repair.hpp"\n', "not part of it")

    def test_a_file_of_tests_without_a_namespace_of_its_name_is_flagged(self):
        path = "tests/geometry/primitives/box_test.cpp"
        self.assert_clean(path, TAG + "namespace plekton::geometry::box_test {\nnamespace {\n}\n}\n")
        self.assert_clean(path, TAG + "namespace plekton::geometry {\nnamespace box_test {\n}\n}\n")
        self.assert_clean(path, TAG + "namespace {\n}\n")
        self.assert_flagged(path, TAG + "namespace plekton::geometry {\nnamespace {\n}\n}\n", "plekton::geometry::box_test")

    def test_two_types_of_one_name_in_one_namespace_are_flagged(self):
        text = TAG + "namespace plekton::geometry {\n\nclass Box;\n\nclass Box final {\n};\n\n}  // namespace plekton::geometry\n"
        self.assert_clean("geometry/primitives/box.hpp", text)
        self.assert_clean("dynamics/model/box.hpp", text.replace("geometry", "dynamics"))
        self.assert_clean("geometry/mesh/repair/repair.hpp", TAG + "namespace plekton::geometry {\n\nstruct Box;\n\nstruct Boxes {\n  struct Box {};\n};\n\n}\n")
        self.assert_flagged("geometry/query/boxes.hpp", text, "geometry/primitives/box.hpp too")

    def test_packages_outside_their_file_are_flagged(self):
        for path, header, reason in (
            ("geometry/primitives/box.cpp", "fcl/fcl.h", "only geometry/neighbor/broad_phase.cpp"),
            ("geometry/primitives/box.cpp", "ccd/ccd.h", "only tests may"),
            ("geometry/neighbor/broad_phase.hpp", "fcl/fcl.h", "only geometry/neighbor/broad_phase.cpp"),
            ("geometry/primitives/box.cpp", "CGAL/Interval_nt.h", "only geometry/base/predicates.cpp"),
            ("geometry/mesh/repair/repair.hpp", "CGAL/Surface_mesh.h", "out of sight"),
            ("contact/sphere_surface/patch.cpp", "CGAL/Gmpq.h", "only geometry/base/predicates.cpp"),
            ("apps/main.cpp", "ccd/vec3.h", "only tests may"),
        ):
            with self.subTest(path=path, header=header):
                self.assert_flagged(path, TAG + f"#include <{header}>\n", reason)
                self.write(path, TAG)

    def test_packages_in_their_own_file_are_clean(self):
        self.assert_clean("geometry/neighbor/broad_phase.cpp", TAG + "#include <fcl/fcl.h>\n")
        self.assert_clean("tests/geometry/closest/together/ccd_queries_test.cpp", TAG + "#include <ccd/ccd.h>\n")
        self.assert_clean("geometry/base/predicates.cpp", TAG + "#include <CGAL/Interval_nt.h>\n")
        self.assert_clean("geometry/mesh/repair/repair.cpp", TAG + "#include <CGAL/Surface_mesh.h>\n")

    def test_the_header_with_cgal_is_for_sources_beside_it(self):
        name = "geometry/mesh/repair/cgal_mesh.hpp"
        self.write(name, TAG + "#pragma once\n#include <CGAL/Surface_mesh.h>\n")
        self.assert_clean("geometry/mesh/repair/wrap.cpp", TAG + f'#include "{name}"\n')
        self.assert_flagged("geometry/mesh/repair/wrap.hpp", TAG + f'#include "{name}"\n', "only sources beside it")
        self.write("geometry/mesh/repair/wrap.hpp", TAG)
        self.assert_flagged("apps/main.cpp", TAG + f'#include "{name}"\n', "only sources beside it")

    def test_a_gpl_header_in_the_core_is_flagged(self):
        self.assert_flagged("geometry/base/predicates.cpp", TAG + "#include <CGAL/Surface_mesh.h>\n", "only LGPL headers")

    def test_a_missing_licence_tag_is_flagged(self):
        self.assert_flagged("geometry/primitives/box.cpp", '#include "geometry/primitives/box.hpp"\n', "SPDX")
        self.assert_flagged("geometry/primitives/box.cpp", "", "SPDX")

    def test_a_licence_tag_may_follow_the_interpreter_line(self):
        self.assert_clean("apps/quickstart.sh", f"#!/bin/sh\n# {SPDX}\n")

    def test_files_that_include_each_other_are_flagged(self):
        self.write("geometry/base/a.hpp", TAG + '#include "geometry/base/b.hpp"\n')
        found = self.violations_of("geometry/base/b.hpp", TAG + '#include "geometry/base/a.hpp"\n')
        self.assertEqual(len(found), 2, found)
        self.assertIn("leads back to it", found[0])

    def test_folders_that_include_each_other_are_flagged(self):
        self.write("geometry/base/a.hpp", TAG)
        self.write("geometry/query/b.hpp", TAG)
        self.write("geometry/query/c.hpp", TAG + '#include "geometry/base/a.hpp"\n')
        found = self.violations_of("geometry/base/d.hpp", TAG + '#include "geometry/query/b.hpp"\n')
        self.assertEqual(len(found), 2, found)
        self.assertIn("whose folder leads back to geometry/base", found[0])

    def members(self, code, namespace="plekton::dynamics"):
        return TAG + f"namespace {namespace} {{\n{code}\n}}  // namespace {namespace}\n"

    def test_a_class_with_members_in_two_sources_is_flagged(self):
        for code in (
            "void Scene::check() const {\n}",
            "Scene::Scene(int size) : size_{size}, names_(size) {}",
            "Scene::~Scene() = default;",
            "Scene& Scene::operator=(Scene&&) = default;",
            "bool Scene::operator<(const Scene& other) const {\n  return size_ < other.size_;\n}",
            "Scene::operator bool() const {\n}",
            "std::vector<std::array<double, 2>> Scene::rows(int count) {\n}",
            "const geometry::Vec3&\nScene::place_of(NodeId node) const noexcept {\n}",
            "template <>\nvoid Scene::add<int>(int number) {\n}",
            "template <class T>\nvoid Scene<T>::add(T number) {\n}",
            "std::function<void(int)> Scene::told() const {\n}",
            "const std::array<int, 2> Scene::kSizes = {1, 2};",
            "void Scene::Part::move() {\n}",
            "struct Scene::Part : Base {\n  int size;\n};",
            "namespace {\nint size() {\n  return '{';\n}\n}  // namespace\nint Scene::size() const {\n}",
        ):
            with self.subTest(code=code):
                self.write("dynamics/model/scene.cpp", self.members("std::size_t Scene::size() const {\n}"))
                reason = "members of plekton::dynamics::Scene, as dynamics/model/scene.cpp"
                self.assert_flagged("dynamics/model/check.cpp", self.members(code), reason)

    def test_the_line_of_the_first_member_in_the_other_source_is_named(self):
        self.write("dynamics/model/scene.cpp", self.members("int Scene::size() {\n}"))
        free = "int free_size() {\n  if (true) {\n    return Scene::none();\n  }\n}\n"
        code = self.members(free + "\n/// Its place.\nint Scene::place() {\n}\nint Scene::last() {\n}")
        self.assert_flagged("dynamics/model/check.cpp", code, "dynamics/model/check.cpp:10:")

    def test_the_source_of_the_name_of_the_class_is_its_own_wherever_it_stands(self):
        self.write("contact/tracking/all_pairs.cpp", self.members("int PairList::size() {\n}", "plekton::contact"))
        self.write("contact/tracking/pair_list.cpp", self.members("int PairList::last() {\n}", "plekton::contact"))
        found = self.violations_of("contact/tracking/words.cpp", self.members("int contact::PairList::next() {\n}", "plekton"))
        flagged = [violation.split(":")[0] for violation in found]
        self.assertEqual(flagged, ["contact/tracking/all_pairs.cpp", "contact/tracking/words.cpp"])

    def test_what_is_no_member_of_a_class_may_be_in_any_source(self):
        self.write("dynamics/model/scene.cpp", self.members("int Scene::size() const {\n}"))
        self.write("geometry/primitives/box.hpp", TAG + "namespace plekton::geometry {\n}\n")
        for code in (
            "Scene::Part part_of(const Scene& scene) {\n  return Scene::Part(scene);\n}",
            "std::vector<Scene::Part> parts = {Scene::none()};",
            "const int size = Scene::count();",
            "bool operator==(const Scene& a, const Scene::Part& b) {\n}",
            "template int Scene::count<int>() const;",
            "extern template class Scene::Parts<int>;",
            "using Scene::Part;",
            "using Part = Scene::Part;",
            "// int Scene::count() {}\n/* int Scene::count() {} */",
            'const char* text = R"(\nint Scene::count() {}\n)";',
            "void geometry::grow(Box& box) {\n}",
            "#define COUNT \\\nint Scene::count()",
        ):
            with self.subTest(code=code):
                self.write("dynamics/model/others.cpp", self.members(code))
                self.assert_clean("dynamics/model/parts.cpp", self.members(code))

    def test_classes_of_one_name_in_other_namespaces_and_sources_are_not_confused(self):
        member = "int Scene::size() const {\n}"
        self.write("dynamics/model/scene.cpp", self.members(member))
        self.assert_clean("apps/scene/scene.cpp", self.members(member, "plekton::apps"))
        own = "namespace {\nclass Scene {\n  int size() const;\n};\n" + member + "\n}  // namespace"
        self.assert_clean("dynamics/model/own.cpp", self.members(own))
        self.assert_clean("tests/dynamics/model/scene_test.cpp", self.members(member, "plekton::scene_test"))

    def test_an_installed_header_that_names_one_that_is_not_is_flagged(self):
        self.write("cmake/install.cmake", f"# {SPDX}\nplekton_public_headers(public_headers\n  dynamics/model/scene.hpp\n  geometry/mesh/repair/repair.hpp)\n")
        self.write("dynamics/model/scene.hpp", TAG + '#include "geometry/primitives/box.hpp"\n/// As geometry/primitives/box.hpp and repair.hpp.\n')
        self.assert_clean("contact/sphere_surface/patch.hpp", TAG + "/// Not installed: see tests/support/lattice.hpp.\n")
        self.assert_flagged("geometry/primitives/box.hpp", TAG + "\n/// See patch.hpp.\n", "geometry/primitives/box.hpp:3")

    def test_installed_headers_that_include_internal_ones_are_flagged(self):
        self.write("cmake/install.cmake", f"# {SPDX}\nplekton_public_headers(public_headers\n  dynamics/model/scene.hpp\n  dynamics/ondem/vtk.hpp)\n")
        self.assert_flagged("dynamics/ondem/vtk.hpp", TAG, "its folder is internal")
        (self.root / "dynamics/ondem/vtk.hpp").unlink()
        self.write("contact/counting/wrap.hpp", TAG)
        self.assert_clean("contact/sphere_surface/patch.hpp", TAG + '#include "contact/counting/wrap.hpp"\n')
        self.write("dynamics/model/scene.hpp", TAG + '#include "contact/base/motion.hpp"\n')
        self.assert_flagged("contact/base/motion.hpp", TAG + '#include "contact/counting/wrap.hpp"\n', "contact/base/motion.hpp:2: is installed")

    def test_tests_without_a_source_at_their_path_are_flagged(self):
        test = TAG + "namespace plekton::geometry::{}_test {{\n}}\n"
        self.assert_clean("tests/geometry/primitives/box_test.cpp", test.format("box"))
        self.assert_clean("tests/geometry/primitives/together/boxes_in_boxes_test.cpp", test.format("boxes_in_boxes"))
        self.assert_flagged("tests/geometry/primitives/crate_test.cpp", test.format("crate"), "there is no geometry/primitives/crate.hpp")

    def test_functions_that_differ_between_processors_are_flagged(self):
        for code, reason in (
            ("double a = std::sin(x);", "std::sin depends on the processor"),
            ("double a = atan2 (y, x);", "atan2 depends on the processor"),
            ("double a = 2.0*::pow(x, 3);", "::pow depends on the processor"),
            ("float a = expf(x);", "expf depends on the processor"),
            ("auto a = values.array().exp2(b);", "exp2 depends on the processor"),
            ("double a = Eigen::numext::log(x);", "depends on the processor"),
            ("Eigen::AngleAxisd turn(angle, axis);", "rotation_about"),
            ("auto q = p.slerp(0.5, r);", "rotation_about"),
            ("std::normal_distribution<double> normal;", "random.hpp"),
            ("long double sum = 0;", "double_double.hpp"),
            ("auto v = _mm256_fmadd_pd(a, b, c);", "pack.hpp"),
        ):
            with self.subTest(code=code):
                self.assert_flagged("dynamics/model/scene.cpp", TAG + code + "\n", reason)

    def test_functions_with_the_same_bits_everywhere_are_clean(self):
        self.assert_clean(
            "dynamics/model/scene.cpp",
            TAG + '// std::sin(x) in a comment\nconst char* text = "pow(x, 2)";\n'
            "double a = elementary::sin(x) + std::sqrt(y) + std::abs(z) + std::floor(z) + std::fmod(x, y);\n"
            "double cosine(double x); double b = cosine(x) + expected(x) + catalog(x) + hash.log_of(3);\n",
        )
        self.assert_clean("geometry/base/elementary.cpp", TAG + "double sin(double x) noexcept { return x; }\n")
        self.assert_clean("tests/geometry/base/elementary_test.cpp", TAG + "double a = std::sin(x);\n")

    def test_flags_that_let_the_compiler_reorder_are_flagged(self):
        tag = f"# {SPDX}\n"
        self.assert_flagged("cmake/options.cmake", tag + "add_compile_options(-O3 -ffast-math)\n", "-ffast-math")
        self.assert_flagged("cmake/options.cmake", tag + "add_compile_options(-ffp-contract=fast)\n", "-ffp-contract=fast")
        self.assert_clean("cmake/options.cmake", tag + "add_compile_options(-ffp-contract=off)\n")

    def test_eigen_without_the_file_that_refuses_its_vectors_is_flagged(self):
        self.write("geometry/base/types.hpp", TAG + "#include <Eigen/Core>\n")
        self.write("geometry/primitives/box.hpp", TAG + '#include "geometry/base/types.hpp"\n')
        self.assert_clean("geometry/primitives/box.cpp", TAG + '#include "geometry/primitives/box.hpp"\n#include <Eigen/LU>\n')
        self.assert_flagged("geometry/primitives/ball.cpp", TAG + "#include <Eigen/LU>\n", "same bits everywhere")

    def test_what_clang_does_not_compile_is_flagged(self):
        for code in ("auto rest = std::ranges::unique(all);", "for (int i : std::views::iota(0, 3)) use(i);"):
            with self.subTest(code=code):
                self.assert_flagged("contact/tracking/rekey.hpp", TAG + code + "\n", "does not compile with clang 14")
        self.assert_clean(
            "contact/tracking/rekey.hpp", TAG + "std::ranges::sort(all); // std::views\nall.erase(std::unique(a, b), b);\n"
        )

    def test_build_folders_are_not_read(self):
        self.assert_clean("build/dev/generated.cpp", "no tag\n")


class ListOfCoreHeaders(unittest.TestCase):
    @unittest.skipUnless((CGAL_FOLDER / "CGAL").is_dir(), "CGAL's headers are not in /usr/include")
    def test_holds_headers_under_the_lgpl_only(self):
        for header in sorted(CGAL_CORE_HEADERS):
            with self.subTest(header=header):
                text = (CGAL_FOLDER / header).read_text(encoding="utf-8", errors="replace")
                tag = re.search(r"SPDX-License-Identifier: *(\S+)", text)
                self.assertIsNotNone(tag)
                self.assertTrue(tag[1].startswith("LGPL-"), f"{header}: {tag[1]}")


if __name__ == "__main__":
    sys.dont_write_bytecode = True
    unittest.main()
