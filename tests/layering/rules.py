# SPDX-License-Identifier: GPL-3.0-or-later
"""The rules of the house, each a function from a source file to the violations in it.

A violation is one line of text: where, what, and what to do about it.
"""

import re
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

LIBRARIES = ("geometry", "contact", "dynamics", "apps")
"""In the order of the arrow: a file may include its own folder and those before it."""

APP_FOLDERS = ("grains", "scenario", "scene", "run", "viewer", "programs", "takeover", "study", "pictures", "validation", "command_line", "python")
"""The folders of apps, in the order of their arrow; main.cpp and the examples may include any."""

ONLY_HOME = {"fcl": "geometry/neighbor/broad_phase.cpp", "ccd": ""}
"""Package folder of the headers: the only file that may include them; none, of what tests alone compare with."""

CGAL_HOMES = ("geometry/base/predicates.cpp", "geometry/neighbor/space_order.cpp")
"""The only files outside geometry/mesh that may include CGAL."""

CGAL_HEADER = "geometry/mesh/repair/cgal_mesh.hpp"
"""The only header that may: sources beside it include it, headers do not."""

CGAL_CORE_HEADERS = {
    "CGAL/FPU.h",
    "CGAL/Gmpq.h",
    "CGAL/Gmpz.h",
    "CGAL/Hilbert_sort_median_3.h",
    "CGAL/Interval_nt.h",
    "CGAL/Mpzf.h",
    "CGAL/Uncertain.h",
    "CGAL/determinant.h",
    "CGAL/enum.h",
    "CGAL/number_utils.h",
    "CGAL/Simple_cartesian.h",
    "CGAL/Exact_predicates_inexact_constructions_kernel.h",
    "CGAL/predicates/sign_of_determinant.h",
}
"""Headers under the LGPL, which is all that the run-time core takes of CGAL."""

SPDX = "SPDX-License-Identifier: GPL-3.0-or-later"
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^>"]+)[>"]', re.MULTILINE)


@dataclass(frozen=True)
class Include:
    line: int
    quoted: bool
    header: str


@dataclass(frozen=True)
class Source:
    """A file of the tree: its path from the root, with slashes, and its text."""

    path: str
    text: str

    @property
    def folder(self):
        return self.path.split("/")[0]

    @property
    def directory(self):
        return self.path.rpartition("/")[0]

    @property
    def includes(self):
        return [
            Include(self.text.count("\n", 0, match.start()) + 1, match[1] == '"', match[2])
            for match in INCLUDE.finditer(self.text)
        ]


def layers(source, root):
    """No include against geometry <- contact <- dynamics <- apps, none of tests outside tests."""
    if source.folder not in LIBRARIES:
        return
    allowed = LIBRARIES[: LIBRARIES.index(source.folder) + 1]
    for include in source.includes:
        target = include.header.split("/")[0]
        if target in (*LIBRARIES, "tests") and target not in allowed:
            yield f'{source.path}:{include.line}: includes "{include.header}" against the arrow {" <- ".join(LIBRARIES)}'


def app_layers(source, root):
    """No include against the order of the folders of apps; sources of the program are in one of them."""
    parts = source.path.split("/")
    if parts[0] != "apps" or parts[1] == "examples" or not source.path.endswith((".cpp", ".hpp")):
        return
    if source.path == "apps/main.cpp":
        return
    if parts[1] not in APP_FOLDERS:
        yield f"{source.path}:1: is in none of the folders of apps: {', '.join(APP_FOLDERS)}"
        return
    allowed = APP_FOLDERS[: APP_FOLDERS.index(parts[1]) + 1]
    for include in source.includes:
        target = include.header.split("/")
        if target[0] == "apps" and target[1] not in allowed:
            yield (
                f'{source.path}:{include.line}: includes "{include.header}" against the order of apps: '
                f'{" <- ".join(APP_FOLDERS)}'
            )


def mesh_stays_outside_the_core(source, root):
    """The GPL parts of CGAL live in geometry/mesh, so the rest of geometry and contact do not lean on it."""
    if source.folder not in ("geometry", "contact") or source.path.startswith("geometry/mesh/"):
        return
    for include in source.includes:
        if include.header.startswith("geometry/mesh/"):
            yield f'{source.path}:{include.line}: the run-time core includes "{include.header}"; geometry/mesh is not part of it'


def includes_from_the_root(source, root):
    """Every quoted include names a file from the root of the tree."""
    for include in source.includes:
        if include.quoted and not (Path(root) / include.header).is_file():
            yield f'{source.path}:{include.line}: "{include.header}" is no file below the root; name it from there'


def packages_stay_home(source, root):
    """FCL, libccd and CGAL each in their own .cpp files."""
    if source.folder not in LIBRARIES:
        return
    for include in source.includes:
        where = f"{source.path}:{include.line}: includes <{include.header}>"
        package = include.header.split("/")[0]
        if package in ONLY_HOME and source.path != ONLY_HOME[package]:
            yield f"{where}; only {ONLY_HOME[package] or 'tests'} may"
        if package == "CGAL":
            yield from _cgal_violations(source, include.header, where)
        elif include.header == CGAL_HEADER and not (source.path.endswith(".cpp") and source.directory == CGAL_HEADER.rpartition("/")[0]):
            yield f"{where}, which includes CGAL; only sources beside it may"


def _cgal_violations(source, header, where):
    in_mesh = source.path.startswith("geometry/mesh/")
    if not source.path.endswith(".cpp") and source.path != CGAL_HEADER:
        yield f"{where}; CGAL belongs in .cpp files, out of sight of a user's compiler"
    elif not in_mesh and source.path not in CGAL_HOMES:
        yield f"{where}; outside geometry/mesh only {' and '.join(CGAL_HOMES)} may"
    elif not in_mesh and header not in CGAL_CORE_HEADERS:
        yield f"{where}; the run-time core takes only LGPL headers of CGAL (CGAL_CORE_HEADERS in tests/layering/rules.py)"


def licence_tag(source, root):
    """The SPDX tag on the first line, or on the second after a #! line."""
    head = source.text.split("\n")[:2]
    line = head[1] if len(head) > 1 and head[0].startswith("#!") else head[0]
    if SPDX not in line:
        yield f'{source.path}:1: no "{SPDX}" on the first line (after #!, the second)'


@lru_cache(maxsize=None)
def _reached_from(root):
    """For every file and every folder of the libraries: the files, and the folders, that its includes lead to."""
    files, folders = {}, {}
    for library in LIBRARIES:
        for path in sorted((Path(root) / library).rglob("*.?pp")):
            source = Source(path.relative_to(root).as_posix(), path.read_text(encoding="utf-8"))
            targets = {include.header for include in source.includes if include.quoted}
            files[source.path] = targets
            folders.setdefault(source.directory, set()).update(
                target.rpartition("/")[0] for target in targets if target.split("/")[0] in LIBRARIES
            )
    return {**closure(files), **closure(folders)}


def forget_tree():
    """To be called before a tree is read again."""
    _reached_from.cache_clear()
    _homes_of_types.cache_clear()
    _public_headers.cache_clear()
    _sources_of_classes.cache_clear()


NAMESPACE_OR_TYPE = re.compile(r"^(?:namespace (?P<namespace>[\w:]+) \{|(?:class|struct|enum class) (?:alignas\([^)]*\) )?(?P<type>\w+)\b(?! *<)(?![^\n]*;$))", re.MULTILINE)


def _types_of(source):
    """Name and line of every type that a header defines outside of others."""
    namespace = ""
    for match in NAMESPACE_OR_TYPE.finditer(source.text):
        if match["namespace"]:
            namespace = match["namespace"]
        else:
            yield f"{namespace}::{match['type']}", source.text.count("\n", 0, match.start()) + 1


@lru_cache(maxsize=None)
def _homes_of_types(root):
    """For every type of the libraries' headers, the first header by path that defines it."""
    homes = {}
    for library in LIBRARIES:
        for path in sorted((Path(root) / library).rglob("*.hpp")):
            source = Source(path.relative_to(root).as_posix(), path.read_text(encoding="utf-8"))
            for name, _ in _types_of(source):
                homes.setdefault(name, source.path)
    return homes


def one_home_for_each_type(source, root):
    """Two types of one name in one namespace are one type to the linker, which keeps the destructor of either for both, even
    where no source sees them together."""
    if source.folder not in LIBRARIES or not source.path.endswith(".hpp"):
        return
    homes = _homes_of_types(str(root))
    for name, line in _types_of(source):
        if homes[name] != source.path:
            yield f"{source.path}:{line}: {name} is defined in {homes[name]} too; give one another name"


INSTALL_LIST = "cmake/install.cmake"


def _named_headers(root):
    """What the install rules name."""
    rules = Path(root) / INSTALL_LIST
    named = re.search(r"plekton_public_headers\(public_headers\s([^)]*)\)", rules.read_text(encoding="utf-8")) if rules.is_file() else None
    return set(named[1].split()) if named else set()


@lru_cache(maxsize=None)
def _public_headers(root):
    """What is installed: the headers that the install rules name, and all that these include (cmake/public_headers.cmake)."""
    reached = _reached_from(root)
    found = _named_headers(root)
    return found.union(*(reached.get(header, ()) for header in found))


def public_headers_name_public_headers(source, root):
    """Comments in headers that are installed send nobody to headers that are not."""
    public = _public_headers(str(root))
    if source.path not in public:
        return
    for number, line in enumerate(source.text.split("\n"), 1):
        comment = line[line.index("//") :] if "//" in line else ""
        for header in re.findall(r"[\w/]+\.hpp", comment):
            if not any(path == header or path.endswith("/" + header) for path in public):
                yield f"{source.path}:{number}: names {header}, which is not installed as this is; say what stands there"


INTERNAL_FOLDERS = ("contact/counting", "contact/sphere_plane", "contact/surface_surface", "dynamics/hdf5", "dynamics/ondem")
"""Folders of which no header is installed."""


def _is_internal(path):
    return any(path.startswith(name + "/") for name in INTERNAL_FOLDERS)


def internal_headers_are_not_installed(source, root):
    """What is installed includes nothing of what is not for users: it would be installed too, and read by their compiler."""
    if source.path not in _public_headers(str(root)):
        return
    if _is_internal(source.path) and source.path in _named_headers(root):
        yield f"{source.path}: is installed, and its folder is internal; take it off the list in {INSTALL_LIST}"
    for include in source.includes:
        if include.quoted and _is_internal(include.header):
            yield (
                f'{source.path}:{include.line}: is installed, and so "{include.header}" would be, which is internal; '
                "include it in a source, or name it ahead"
            )


TOGETHER = "together"
"""Name of the folders of tests of more than one source."""


def tests_mirror_sources(source, root):
    """A test of the libraries is of the source at the same path, or says by its folder that it is of several together."""
    parts = source.path.split("/")
    if parts[0] != "tests" or parts[1] not in LIBRARIES or TOGETHER in parts or not source.path.endswith("_test.cpp"):
        return
    tested = source.path.removeprefix("tests/").removesuffix("_test.cpp")
    if not any((Path(root) / (tested + suffix)).is_file() for suffix in (".hpp", ".cpp")):
        yield f"{source.path}: there is no {tested}.hpp or .cpp; a test of several sources lies in {source.directory}/{TOGETHER}"


def tests_keep_to_themselves(source, root):
    """Files of tests are compiled together, so what helps one is in a namespace of that file's name. What is
    in none but the unnamed one is seen, where it collides, by the compiler."""
    path = Path(source.path)
    if not source.path.startswith("tests/") or not path.name.endswith("_test.cpp"):
        return
    namespaces = re.findall(r"^namespace ([\w:]+) \{", source.text, re.MULTILINE)
    if namespaces and not any(name.split("::")[-1] == path.stem for name in namespaces):
        yield f"{source.path}: its helpers meet those of other tests; put them in the namespace {namespaces[0]}::{path.stem}"


def closure(graph):
    """What can be reached from each of the places of a graph, itself only in a circle."""
    reached = {}
    for start in graph:
        found, open_ends = set(), list(graph[start])
        while open_ends:
            end = open_ends.pop()
            if end not in found:
                found.add(end)
                open_ends.extend(graph.get(end, ()))
        reached[start] = found
    return reached


def no_circles(source, root):
    """No file, and no folder, includes itself by way of others: nothing is in parts that need each other.

    The folders of apps have an order of their own.
    """
    if source.folder not in LIBRARIES:
        return
    reached = _reached_from(str(root))
    for include in source.includes:
        target = include.header.rpartition("/")[0]
        where = f'{source.path}:{include.line}: includes "{include.header}"'
        if source.path in reached.get(include.header, ()):
            yield f"{where}, which leads back to it; one of them is a part of the other, or a third is missing"
        elif source.folder != "apps" and target != source.directory and source.directory in reached.get(target, ()):
            yield f"{where}, whose folder leads back to {source.directory}; put it into a folder below both"


_COMMENTS_AND_TEXTS = re.compile(
    r"""R"(?P<end>[^\s()\\]*)\(.*?\)(?P=end)"|//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])'""", re.DOTALL
)


def _blank(match):
    return re.sub(r"[^\n]", " ", match[0])


def _code_of(text):
    """The text with comments and literal texts blank, on the same lines."""
    return _COMMENTS_AND_TEXTS.sub(_blank, text)


_NO_MEMBER = re.compile(r"(?:extern\s+)?template\s*[^<\s]|(?:using|typedef|friend|static_assert)\b|[^\w\[]")
"""How a declaration begins that defines no member: instantiations, other names, the rest of a list of initialisers."""


@dataclass(frozen=True)
class Declaration:
    """One at the scope of a namespace, up to its first brace or semicolon."""

    line: int
    namespace: str
    text: str
    has_braces: bool

    @property
    def own_type(self):
        """Name of the class that is defined here; of one inside another: none."""
        found = re.match(r"(?:class|struct)\s+(?:alignas\([^)]*\)\s*)?(\w+)\b(?!\s*::)", self.without_templates)
        return found[1] if found and self.has_braces else None

    @property
    def qualifiers(self):
        """What stands before the name of a member: its class, and what that is in."""
        if _NO_MEMBER.match(self.text):
            return []
        declarator = re.split(r"[(=]|(?<!:):(?!:)", self.without_templates)[0]
        found = re.search(r"(?<![\w:])((?:\w+::)+)(?:~?\w+)?\s*$", declarator)
        return found[1].split("::")[:-1] if found else []

    @property
    def without_templates(self):
        """Without what is in angle brackets and the name of an operator, in which there may be others."""
        text = re.sub(r"^template\s*(?=<)", "", re.split(r"\boperator\b", self.text)[0])
        shorter = re.sub(r"<[^<>]*>", "", text)
        while shorter != text:
            text, shorter = shorter, re.sub(r"<[^<>]*>", "", shorter)
        return text.strip()


def _declarations(text):
    """Those of a source at the scope of its namespaces, the unnamed ones left out of their names."""
    without_macros = re.sub(r"^[ \t]*#(?:\\\n|[^\n])*", _blank, _code_of(text), flags=re.MULTILINE)
    namespaces, depth, start, line = [], 0, 0, 1
    for match in re.finditer(r"[{};]", without_macros):
        end, head = match[0], without_macros[start : match.start()]
        first_line = line + head[: len(head) - len(head.lstrip())].count("\n")
        line += head.count("\n")
        start = match.end()
        if depth > 0:
            depth += {"{": 1, "}": -1, ";": 0}[end]
        elif end == "}":
            namespaces[-1:] = []
        elif end == "{" and (opened := re.search(r"\bnamespace\s*([\w:]*)\s*$|\bextern\s*$", head)):
            namespaces.append(opened[1] or "")
        else:
            depth = int(end == "{")
            if head.strip():
                yield Declaration(first_line, "::".join(filter(None, namespaces)), head.strip(), end == "{")


@lru_cache(maxsize=None)
def _sources_of_classes(root):
    """For every class with members outside of its braces: the sources with these, and the line of the first in each."""
    declared, namespaces = {}, set()
    for library in LIBRARIES:
        for path in sorted((Path(root) / library).rglob("*.?pp")):
            text = path.read_text(encoding="utf-8")
            for name in re.findall(r"^namespace ([\w:]+)", text, re.MULTILINE):
                namespaces.update(name.split("::"))
            if path.suffix == ".cpp":
                declared[path.relative_to(root).as_posix()] = list(_declarations(text))
    sources = {}
    for path, declarations in declared.items():
        own = {declaration.own_type for declaration in declarations}
        for declaration in declarations:
            qualifiers = declaration.qualifiers
            place = next((i for i, name in enumerate(qualifiers) if name not in namespaces), None)
            if place is not None and qualifiers[place] not in own:
                name = "::".join(filter(None, (declaration.namespace, *qualifiers[: place + 1])))
                sources.setdefault(name, {}).setdefault(path, declaration.line)
    return sources


def no_class_in_parts(source, root):
    """All that a class defines outside of its header is in one source, also what the classes in it define. One that is too
    long for that does too much."""
    if source.folder not in LIBRARIES or not source.path.endswith(".cpp"):
        return
    for name, lines in _sources_of_classes(str(root)).items():
        if source.path not in lines or len(lines) == 1:
            continue
        stem = re.sub(r"(?<!^)(?=[A-Z])", "_", name.split("::")[-1]).lower()
        home = min(lines, key=lambda path: (Path(path).stem != stem, path))
        if source.path != home:
            yield (
                f"{source.path}:{lines[source.path]}: defines members of {name}, as {home} does; move them there, "
                "or make functions or a class of their own of them"
            )


ELEMENTARY_HOMES = ("geometry/base/elementary.hpp", "geometry/base/elementary.cpp")
"""The only files that may have elementary functions of their own."""

_ELEMENTARY = (
    "pow|exp|exp2|expm1|log|log2|log10|log1p|sin|cos|tan|sincos|asin|acos|atan|atan2|sinh|cosh|tanh|asinh|acosh|atanh"
    "|cbrt|hypot|erf|erfc|tgamma|lgamma"
)
FORBIDDEN_BITS = (
    (
        re.compile(rf"(?<![\w:])(?:(?:std|Eigen|Eigen::numext|numext)?::)?(?:{_ELEMENTARY})[fl]?\s*\((?!\))"),
        "depends on the processor; take it from geometry/base/elementary.hpp",
    ),
    (
        re.compile(r"\b(?:AngleAxis\w*|Rotation2D\w*|(?:angularDistance|slerp|eulerAngles|computeDirect)(?=\s*\())"),
        "has sines and angles of the C library; take rotation_about() or geometry/base/elementary.hpp",
    ),
    (re.compile(r"\bstd::\w+_distribution\b"), "differs from library to library; see apps/grains/random.hpp"),
    (re.compile(r"\blong\s+double\b"), "has another size on other processors; see geometry/base/double_double.hpp"),
    (re.compile(r"\b_mm\d*_\w+"), "is of one processor; see geometry/base/pack.hpp"),
)
"""What in a library or program may give other bits on another processor, and what to take instead."""

FORBIDDEN_FLAGS = re.compile(
    r"-ffast-math|-Ofast|-funsafe-math-optimizations|-fassociative-math|-freciprocal-math|-ffp-contract=(?!off)\w+"
)


def same_bits_on_every_processor(source, root):
    """Nothing in the libraries and the program takes functions that differ from processor to processor."""
    if source.path.endswith(("CMakeLists.txt", ".cmake", "CMakePresets.json")):
        for match in FORBIDDEN_FLAGS.finditer(source.text):
            line = source.text.count("\n", 0, match.start()) + 1
            yield f"{source.path}:{line}: {match[0]} lets the compiler give other bits on other processors; leave it out"
    is_code = source.path.endswith((".cpp", ".hpp")) and not source.path.startswith("apps/examples/")
    if source.folder not in LIBRARIES or source.path in ELEMENTARY_HOMES or not is_code:
        return
    code = _code_of(source.text)
    for pattern, advice in FORBIDDEN_BITS:
        for match in pattern.finditer(code):
            line = code.count("\n", 0, match.start()) + 1
            yield f"{source.path}:{line}: {match[0].rstrip('(').strip()} {advice}"


EIGEN_HOME = "geometry/base/types.hpp"
"""Where the compiler is stopped if Eigen vectorises."""


def eigen_does_not_vectorise(source, root):
    """Whoever includes Eigen includes the file that refuses an Eigen that vectorises: its sums and products have another
    order, and fused operations, on each processor."""
    if source.folder not in LIBRARIES or source.path == EIGEN_HOME:
        return
    includes = [include for include in source.includes if include.header.startswith("Eigen/")]
    if not includes:
        return
    reached = _reached_from(str(root)).get(source.path, ())
    if EIGEN_HOME not in reached:
        yield f'{source.path}:{includes[0].line}: includes Eigen without "{EIGEN_HOME}", which sees to the same bits everywhere'


SUBRANGE = re.compile(
    r"\bstd::(?:ranges::(?:unique|remove|remove_if|partition|stable_partition|rotate|search|search_n|find_end|equal_range|subrange"
    r"|views)\b|views\b)"
)


def compiles_with_clang_too(source, root):
    """clang 14, which the sanitizers and fuzzers are compiled with on Debian 12, knows no views and subranges of the library
    beside it."""
    if not source.path.endswith((".cpp", ".hpp")):
        return
    code = _code_of(source.text)
    for match in SUBRANGE.finditer(code):
        line = code.count("\n", 0, match.start()) + 1
        yield f"{source.path}:{line}: {match[0]} does not compile with clang 14, as sanitizers do; take an algorithm of iterators"


RULES = (
    layers,
    app_layers,
    mesh_stays_outside_the_core,
    includes_from_the_root,
    packages_stay_home,
    licence_tag,
    no_circles,
    no_class_in_parts,
    same_bits_on_every_processor,
    eigen_does_not_vectorise,
    compiles_with_clang_too,
    one_home_for_each_type,
    public_headers_name_public_headers,
    internal_headers_are_not_installed,
    tests_mirror_sources,
    tests_keep_to_themselves,
)
