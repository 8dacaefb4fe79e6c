"""The Spack recipe against the build that it drives: usage test_recipe.py SOURCE_DIR [unittest's arguments]

Spack itself isn't needed: its directives are replaced by ones that remember what they were told, and what else a recipe
may import by doubles that have no more than the real ones.
"""
import builtins
import contextlib
import dis
import importlib.util
import os
import re
import sys
import types
import unittest
import unittest.mock
from pathlib import Path

SOURCE = Path(sys.argv.pop(1))
REPOSITORY = SOURCE / "spack" / "spack_repo" / "gale"

# What CMake calls it -> what Spack calls it.
PACKAGES = {
    "Kokkos": "kokkos",
    "KokkosKernels": "kokkos-kernels",
    "VTK": "vtk",
    "MPI": "mpi",
    "CLI11": "cli11",
    "nlohmann_json": "nlohmann-json",
    "GTest": "googletest",
    "Python3": "python",
}
EXPORTED = set((Path(__file__).parent / "spack_package_v2.2.txt").read_text().split("\n", 1)[1].split())
BUILT_INTO_CMAKE = {"BUILD_SHARED_LIBS", "CMAKE_CXX_COMPILER", "CMAKE_PREFIX_PATH", "Kokkos_ROOT", "nanobind_DIR"}
EXTERNAL = {"kokkos"}  # of the system
BACKENDS = {"serial", "openmp", "cuda"}
CUDA_ARCHS = ("70", "90")


class SkipTest(Exception):
    """What a test of Spack's raises where it has nothing to test."""


class Program:
    """Remembers its calls, as (arguments, keywords), and answers."""

    def __init__(self, path):
        self.path = path
        self.calls = []

    def __call__(self, *arguments, **keywords):
        self.calls.append((arguments, keywords))
        return f"{self.path}/answer\n"


class PythonExtension:
    """As Spack's: with a test that runs whatever the variants are, and needs what only +python has."""

    def test_imports(self):
        self.module.python("-c", "", *self.import_modules)


class Directives:
    """Stands for Spack's directives: calls[name] lists each call's (arguments, keywords)."""

    NAMES = ("version", "variant", "depends_on", "conflicts", "requires", "license", "maintainers")

    def __init__(self):
        self.calls = {name: [] for name in self.NAMES}
        self.programs = {}

    def which(self, path, required):
        return self.programs.setdefault(path, Program(path))

    def install(self):
        package = types.ModuleType("spack.package")
        package.__all__ = sorted(EXPORTED)
        for name in EXPORTED:
            setattr(package, name, None)
        for name in self.NAMES:
            setattr(package, name, lambda *args, _name=name, **keywords: self.calls[_name].append((args, keywords)))
        package.extends = lambda spec: self.calls["depends_on"].append(((spec,), {"type": ("build", "run")}))
        package.run_after = lambda phase: lambda function: function
        package.when = self.when
        package.SkipTest = SkipTest
        package.which = self.which
        package.join_path = os.path.join
        package.working_dir = lambda path, create: contextlib.nullcontext()
        package.check_outputs = lambda expected, found: None
        build_systems = "spack_repo.builtin.build_systems"
        cmake = types.ModuleType(f"{build_systems}.cmake")
        cmake.CMakePackage = type("CMakePackage", (), {})
        cuda = types.ModuleType(f"{build_systems}.cuda")
        cuda.CudaPackage = type("CudaPackage", (), {"cuda_arch_values": CUDA_ARCHS})
        python = types.ModuleType(f"{build_systems}.python")
        python.PythonExtension = PythonExtension
        parents = ["spack", "spack_repo", "spack_repo.builtin", build_systems]
        for module in [types.ModuleType(name) for name in parents] + [package, cmake, cuda, python]:
            sys.modules[module.__name__] = module

    @contextlib.contextmanager
    def when(self, condition):
        """What is said inside has this condition as well."""
        before = len(self.calls["depends_on"])
        yield
        for _, keywords in self.calls["depends_on"][before:]:
            keywords["when"] = condition + keywords.get("when", "")

    def dependencies(self):
        """{(spec, condition)} of all depends_on."""
        return {(args[0], keywords.get("when")) for args, keywords in self.calls["depends_on"]}

    def packages(self, variants, run_tests):
        """What there is for these variants: {its name: whether it is linked}."""
        found = {}
        for (spec,), keywords in self.calls["depends_on"]:
            said = re.findall(r"([+~])(\w+)", keywords.get("when", ""))
            if all(variants.get(name, False) == (sign == "+") for sign, name in said):
                if run_tests or keywords.get("type") != "test":
                    name = re.match(r"[\w-]+", spec).group(0)
                    linked = "link" in keywords.get("type", ("build", "link"))
                    found[name] = found.get(name, False) or linked
        return found


class Spec:
    """Has the variants that are said, and those packages that the recipe depends on then."""

    def __init__(self, variants, packages):
        self.variants = variants
        self.packages = packages

    def __getitem__(self, name):
        if name not in self.packages:
            raise KeyError(f"No spec with name {name}")
        return self.node(name)

    def node(self, name):
        has_wrapper = name == "kokkos" and self.variants["cuda"]
        prefix = Prefix("/usr" if name in EXTERNAL else f"/opt/{name}")
        return types.SimpleNamespace(prefix=prefix, command=Program(f"/opt/{name}"), external=name in EXTERNAL,
                                     package=types.SimpleNamespace(cmake_prefix_paths=[prefix]),
                                     satisfies=lambda text: text == "+wrapper" and has_wrapper)

    def traverse(self, deptype):
        """The package itself and what it links. Of what it is only built with, a test cannot ask for the prefixes."""
        assert deptype == "link"
        return [self.node(name) for name in ["gale"] + [name for name, linked in self.packages.items() if linked]]

    def satisfies(self, text):
        return self.variants[text[1:]] == (text[0] == "+")


class Prefix(str):
    """A folder, whose attributes are what is in it."""

    def __getattr__(self, name):
        return Prefix(f"{self}/{name}")


def load_recipe():
    directives = Directives()
    directives.install()
    path = REPOSITORY / "packages" / "gale" / "package.py"
    module_spec = importlib.util.spec_from_file_location("gale_recipe", path)
    module = importlib.util.module_from_spec(module_spec)
    module_spec.loader.exec_module(module)
    return module.Gale, directives


def make_package(recipe, directives, variants, run_tests=False):
    """The package, as far as the recipe may ask it."""
    packages = directives.packages(variants, run_tests)
    of_python = {"python": Program("python"), "python_platlib": "/opt/gale/lib/python3/site-packages"}

    class Package(recipe):
        spec = Spec(variants, packages)
        prefix = Prefix("/opt/gale")
        test_suite = types.SimpleNamespace(current_test_cache_dir="/cache")
        module = types.SimpleNamespace(**(of_python if variants["python"] else {}))

        def __getitem__(self, name):
            if name not in packages:
                raise KeyError(f"No spec with name {name}")
            return types.SimpleNamespace(cxx="/opt/gcc/bin/g++", kokkos_cxx="nvcc_wrapper")

        def define(self, option, value):
            return option, value

        def define_from_variant(self, option, variant):
            return option, variants[variant]

    Package.run_tests = run_tests
    return Package()


def code_of(code):
    """A code object and all that is defined in it."""
    yield code
    for constant in code.co_consts:
        if isinstance(constant, types.CodeType):
            yield from code_of(constant)


class Recipe(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.recipe, cls.directives = load_recipe()
        cls.variants = {args[0]: keywords for args, keywords in cls.directives.calls["variant"]}
        cls.cmake = (SOURCE / "CMakeLists.txt").read_text()
        cls.options = set(re.findall(r"^option\((\w+)", cls.cmake, re.M))
        for part in (cls.cmake, (SOURCE / "bindings" / "python" / "CMakeLists.txt").read_text()):
            cls.options |= set(re.findall(r"^set\((\w+) [^)]* CACHE ", part, re.M))

    def all_variants(self, **changed):
        return {**dict.fromkeys(self.variants, False), "cuda": False, **changed}

    def cmake_args(self, variants, run_tests):
        """What the recipe would pass to CMake, as {option: value}."""
        return dict(make_package(self.recipe, self.directives, variants, run_tests).cmake_args())

    def test_repository_is_where_its_namespace_says(self):
        text = (REPOSITORY / "repo.yaml").read_text()
        self.assertEqual(re.search(r"^  namespace: (\w+)$", text, re.M).group(1), REPOSITORY.name)
        self.assertRegex(text, r"(?m)^  api: v2\.\d+$")

    def test_sources_are_this_checkout_where_it_is_one(self):
        found = getattr(self.recipe, "git", None)
        self.assertEqual(found, f"file://{SOURCE.resolve()}" if (SOURCE / ".git").exists() else None)

    def test_no_version_names_what_does_not_exist(self):
        self.assertEqual(self.directives.calls["version"], [(("main",), {"branch": "main"})])

    def test_variants(self):
        self.assertEqual(set(self.variants), {"serial", "openmp", "app", "kokkos_kernels", "libdeflate", "mpi", "python", "vtk", "shared"})
        self.assertEqual({base.__name__ for base in self.recipe.__bases__}, {"CMakePackage", "CudaPackage", "PythonExtension"})

    def test_other_backends_of_kokkos_conflict(self):
        conflicts = {args[0] for args, _ in self.directives.calls["conflicts"]}
        self.assertLessEqual({"^kokkos+rocm", "^kokkos+sycl"}, conflicts)

    def test_what_is_installed_is_tested(self):
        tests = {name for name in dir(self.recipe) if name.startswith("test_") and callable(getattr(self.recipe, name))}
        self.assertEqual(tests, {"test_command", "test_examples", "test_imports", "test_python"})
        for name in tests:
            self.assertTrue(getattr(self.recipe, name).__doc__, name)  # Spack prints it

    def test_names_are_those_that_spack_exports(self):
        path = REPOSITORY / "packages" / "gale" / "package.py"
        known = set(self.recipe.cmake_args.__globals__) | set(dir(builtins))
        for code in code_of(compile(path.read_text(), str(path), "exec")):
            for step in dis.get_instructions(code):
                if step.opname == "LOAD_GLOBAL":  # what no import brings is there at some times of a build only, or never
                    self.assertTrue(step.argval in known, f"{code.co_name} uses {step.argval}")

    def test_lines_are_as_spack_style_wants_them(self):
        for number, line in enumerate((REPOSITORY / "packages" / "gale" / "package.py").read_text().split("\n"), 1):
            self.assertLessEqual(len(line), 99, f"line {number}")
            self.assertFalse(line.startswith("from spack.package import *"), "spack style takes such names as undefined")

    def test_each_dependency_says_what_it_is_for(self):
        for (spec,), keywords in self.directives.calls["depends_on"]:
            self.assertIn("type", keywords, spec)

    def test_no_condition_is_about_what_it_adds(self):
        for spec, condition in self.directives.dependencies():
            added = re.match(r"[\w-]+", spec).group(0)
            self.assertNotIn(f"^{added}", condition or "", f"spack audit calls the condition of {spec} self-referential")

    def test_tests_run_or_are_skipped_for_all_variants(self):
        """In the environment that Spack gives tests, which has no CXX, and with no package but those of the variants."""
        tests = [name for name in dir(self.recipe) if name.startswith("test_") and callable(getattr(self.recipe, name))]
        self.assertIn("test_imports", tests)  # which PythonExtension brings
        needed = {"test_command": "app", "test_imports": "python", "test_python": "python"}
        for name in tests:
            for on in (False, True):
                variants = self.all_variants(**dict.fromkeys(self.variants, on), cuda=False)
                package = make_package(self.recipe, self.directives, variants, run_tests=False)
                with self.subTest(name, all_variants=on), unittest.mock.patch.dict(os.environ, clear=True):
                    if name in needed and not on:
                        self.assertRaises(SkipTest, getattr(package, name))
                    else:
                        getattr(package, name)()

    def test_examples_are_compiled_by_what_compiled_gale(self):
        for cuda, compiler in ((False, "/opt/gcc/bin/g++"), (True, "nvcc_wrapper")):
            self.directives.programs.clear()
            make_package(self.recipe, self.directives, self.all_variants(cuda=cuda)).test_examples()
            calls = self.directives.programs["/opt/cmake/bin/cmake"].calls
            self.assertIn(("CMAKE_CXX_COMPILER", compiler), calls[0][0])
            for _, keywords in calls:
                self.assertEqual(keywords["extra_env"], {"NVCC_WRAPPER_DEFAULT_COMPILER": "/opt/gcc/bin/g++"})
            self.assertTrue(self.directives.programs["/opt/cmake/bin/ctest"].calls)

    def test_examples_find_what_gale_links(self):
        self.directives.programs.clear()
        make_package(self.recipe, self.directives, self.all_variants(**dict.fromkeys(self.variants, True))).test_examples()
        prefixes = dict(self.directives.programs["/opt/cmake/bin/cmake"].calls[0][0][1:])["CMAKE_PREFIX_PATH"]
        self.assertEqual(prefixes[0], "/opt/gale")
        self.assertLessEqual({"/opt/vtk", "/opt/mpi", "/opt/kokkos-kernels"}, set(prefixes))
        self.assertEqual(set(prefixes) & {"/opt/py-nanobind", "/opt/python", "/opt/cmake"}, set())
        self.assertEqual(prefixes[-1], "/usr", "what Spack built is found before the system's")

    def test_command_finds_what_the_recipe_expects(self):
        source = (REPOSITORY / "packages" / "gale" / "package.py").read_text()
        for kind, count in (("minima", 26), ("maxima", 39)):  # of grid:32, as the tests of algorithms have them
            self.assertIn(rf"{kind}\s+{count}", source)

    def test_options_exist(self):
        for options in (self.cmake_args(self.all_variants(), True),
                        self.cmake_args(self.all_variants(cuda=True, python=True), False)):
            self.assertEqual(set(options) - self.options - BUILT_INTO_CMAKE, set())

    def test_each_variant_changes_an_option(self):
        without = self.cmake_args(self.all_variants(), False)
        for variant in self.all_variants():
            changed = self.cmake_args(self.all_variants(**{variant: True}), False)
            with self.subTest(variant=variant):
                self.assertNotEqual(changed, without)
        self.assertTrue(self.cmake_args(self.all_variants(vtk=True), False)["GALE_ENABLE_VTK"])
        self.assertTrue(self.cmake_args(self.all_variants(mpi=True), False)["GALE_ENABLE_MPI"])
        self.assertTrue(self.cmake_args(self.all_variants(shared=True), False)["BUILD_SHARED_LIBS"])

    def test_python_goes_below_the_prefix(self):
        """CMake finds the way from the module to the libraries by that."""
        options = self.cmake_args(self.all_variants(python=True), False)
        self.assertEqual(options["GALE_PYTHON_DIR"], "lib/python3/site-packages")

    def test_python_without_typings_overloads_gets_them(self):
        """nanobind, which writes the module's stub, imports them, and doesn't depend on them."""
        self.assertIn(("py-typing-extensions", "+python^python@:3.10"), self.directives.dependencies())

    def test_tests_are_built_when_they_are_run(self):
        for run_tests in (False, True):
            self.assertIs(self.cmake_args(self.all_variants(), run_tests)["GALE_ENABLE_TESTS"], run_tests)

    def test_backends_are_forwarded_and_required(self):
        for package, condition in (("kokkos", ""), ("kokkos-kernels", "+kokkos_kernels")):
            for backend in BACKENDS - {"cuda"}:
                self.assertIn((f"{package}+{backend}", f"{condition}+{backend}"), self.directives.dependencies())
            for arch in CUDA_ARCHS:
                self.assertIn((f"{package}+cuda cuda_arch={arch}", f"{condition}+cuda cuda_arch={arch}"),
                              self.directives.dependencies())
        for backend in BACKENDS:
            options = self.cmake_args(self.all_variants(**{backend: True}), False)
            self.assertEqual(options["GALE_REQUIRE_BACKENDS"], [backend.upper()])

    def test_cuda_needs_an_architecture(self):
        conflicts = [(args[0], keywords.get("when")) for args, keywords in self.directives.calls["conflicts"]]
        self.assertIn(("cuda_arch=none", "+cuda"), conflicts)

    def test_depends_on_all_that_cmake_looks_for(self):
        text = self.cmake + (SOURCE / "cmake" / "gale-dependencies.cmake").read_text()
        wanted = set(re.findall(r"gale_find\((\w+) ", text)) - {"Threads", "OpenMP", "ParaView"}  # no variant has the plugin
        packages = {re.match(r"[\w-]+", spec).group(0) for spec, _ in self.directives.dependencies()}
        self.assertLessEqual({f"lib{name}" for name in re.findall(r"find_library\(\w+ (\w+)", text)}, packages)
        self.assertEqual({PACKAGES[name] for name in wanted} - packages, set())
        for name in ("googletest", "python"):
            kinds = [kw.get("type") for args, kw in self.directives.calls["depends_on"] if args[0].startswith(name)]
            self.assertIn("test", kinds)


if __name__ == "__main__":
    unittest.main()
