# SPDX-License-Identifier: BSD-3-Clause
import os

from spack_repo.builtin.build_systems.cmake import CMakePackage
from spack_repo.builtin.build_systems.cuda import CudaPackage
from spack_repo.builtin.build_systems.python import PythonExtension

from spack.package import (
    SkipTest,
    cache_extra_test_sources,
    check_outputs,
    conflicts,
    depends_on,
    extends,
    join_path,
    license,
    run_after,
    variant,
    version,
    when,
    which,
    working_dir,
)

CHECKOUT = os.path.abspath(os.path.join(os.path.dirname(__file__), *[os.pardir] * 5))


class Gale(CMakePackage, CudaPackage, PythonExtension):
    """Topological relations of large tetrahedral meshes, computed segment by segment and ahead of
    need, on CPUs and GPUs; critical points, Morse-Smale complexes and persistent homology of
    scalar fields on them."""

    # To be filled in by who hands this in, as are maintainers("..."), by their names on GitHub.
    homepage = "https://example.org/gale"

    # The sources are those of the checkout that this recipe lies in. scripts/release.sh makes the
    # recipe of a release of this one: build/spack/package.py.
    if os.path.exists(os.path.join(CHECKOUT, ".git")):
        git = f"file://{CHECKOUT}"

    license("BSD-3-Clause")

    test_requires_compiler = True

    # What test_imports imports.
    import_modules = ["gale"]

    version("main", branch="main")

    # Kokkos' backends, which cannot be added to those of the Kokkos that is linked. Without a
    # device, and where Kokkos has Serial alone, GALE's own loops still use all cores, by the
    # compiler's OpenMP.
    variant("serial", default=True, description="Kokkos' Serial backend")
    variant("openmp", default=False, description="Kokkos' OpenMP backend")
    variant("app", default=True, description="The gale command")
    variant("libdeflate", default=True, description="Compress in half of zlib's time")
    variant("kokkos_kernels", default=True, description="The explicit structure")
    variant("mpi", default=False, description="Meshes that lie on several MPI ranks")
    variant("python", default=False, description="The Python module gale")
    variant("vtk", default=True, description="Read files with what VTK brings")
    variant("shared", default=True, description="Build shared libraries")

    depends_on("c", type="build", when="+vtk")  # VTK finds HDF5 with it
    depends_on("cxx", type="build")
    depends_on("cmake@3.22:", type="build")
    depends_on("llvm-openmp", when="%apple-clang", type=("build", "link"))
    depends_on("kokkos@4.4:", type=("build", "link"))
    depends_on("kokkos-kernels@4.4:", when="+kokkos_kernels", type=("build", "link"))
    depends_on("vtk@9.1:", when="+vtk", type=("build", "link"))
    depends_on("libdeflate", when="+libdeflate", type=("build", "link"))
    depends_on("mpi", when="+mpi", type=("build", "link"))
    depends_on("cli11", when="+app", type=("build", "link"))
    depends_on("nlohmann-json", when="+app", type=("build", "link"))
    depends_on("googletest", type="test")
    depends_on("python@3.9:", type="test")

    with when("+python"):
        extends("python@3.9:")
        depends_on("py-nanobind@2:", type="build")
        depends_on("py-typing-extensions", type="build", when="^python@:3.10")  # nanobind's stubs
        depends_on("py-numpy", type=("build", "run"))
        depends_on("kokkos+pic", when="~shared", type=("build", "link"))

    depends_on("kokkos+shared", when="+shared", type=("build", "link"))
    for backend in ("serial", "openmp"):
        depends_on(f"kokkos+{backend}", when=f"+{backend}", type=("build", "link"))
        depends_on(
            f"kokkos-kernels+{backend}",
            when=f"+kokkos_kernels+{backend}",
            type=("build", "link"),
        )
    depends_on("kokkos-kernels+shared", when="+kokkos_kernels+shared", type=("build", "link"))

    # Kokkos is built for one architecture.
    for arch in CudaPackage.cuda_arch_values:
        this_gpu = f"+cuda cuda_arch={arch}"
        depends_on(f"kokkos{this_gpu}", when=this_gpu, type=("build", "link"))
        depends_on(
            f"kokkos-kernels{this_gpu}",
            when=f"+kokkos_kernels{this_gpu}",
            type=("build", "link"),
        )
    depends_on("kokkos+wrapper", when="+cuda %gcc", type=("build", "link"))

    conflicts("cuda_arch=none", when="+cuda", msg="name the GPU: cuda_arch=90, for example")
    conflicts("^kokkos@:4~cuda_lambda", when="+cuda", msg="GALE's kernels on a GPU are lambdas")
    conflicts("~serial", when="~openmp", msg="Kokkos needs a host backend: +serial or +openmp")
    for backend in ("rocm", "sycl", "openmptarget", "hpx", "threads"):
        conflicts(
            f"^kokkos+{backend}",
            msg=f"GALE has no code for Kokkos' backend +{backend}: Serial, OpenMP or CUDA",
        )
    conflicts(
        "^kokkos+cuda", when="~cuda", msg="this Kokkos has CUDA: take +cuda and its cuda_arch"
    )

    def cmake_args(self):
        backends = [b for b in ("serial", "openmp", "cuda") if self.spec.satisfies(f"+{b}")]
        args = [
            self.define_from_variant("BUILD_SHARED_LIBS", "shared"),
            self.define_from_variant("GALE_ENABLE_APP", "app"),
            self.define_from_variant("GALE_ENABLE_KOKKOS_KERNELS", "kokkos_kernels"),
            self.define_from_variant("GALE_ENABLE_LIBDEFLATE", "libdeflate"),
            self.define_from_variant("GALE_ENABLE_MPI", "mpi"),
            self.define_from_variant("GALE_ENABLE_PYTHON", "python"),
            self.define_from_variant("GALE_ENABLE_VTK", "vtk"),
            self.define("GALE_ENABLE_EXAMPLES", self.run_tests),
            self.define("GALE_ENABLE_TESTS", self.run_tests),
            self.define("GALE_REQUIRE_BACKENDS", [b.upper() for b in backends]),
            self.define("Kokkos_ROOT", self.spec["kokkos"].prefix),
        ]
        if self.spec.satisfies("+cuda"):
            args.append(self.define("CMAKE_CXX_COMPILER", self["kokkos"].kokkos_cxx))
        if self.spec.satisfies("+python"):
            modules = os.path.relpath(self.module.python_platlib, self.prefix)
            args.append(self.define("GALE_PYTHON_DIR", modules))
            where = self.spec["python"].command("-m", "nanobind", "--cmake_dir", output=str)
            args.append(self.define("nanobind_DIR", where.strip()))
        return args

    @run_after("install")
    def keep_examples(self):
        cache_extra_test_sources(self, ["examples"])

    def test_command(self):
        """find the critical points of a synthetic field"""
        if self.spec.satisfies("~app"):
            raise SkipTest("there is no command without +app")
        gale = which(self.prefix.bin.gale, required=True)
        out = gale("critical-points", "grid:32", output=str.split, error=str.split)
        check_outputs([r"minima\s+26", r"maxima\s+39"], out)

    def test_imports(self):
        """import the module"""
        if self.spec.satisfies("~python"):
            raise SkipTest("there is no module without +python")
        super().test_imports()

    def test_python(self):
        """find the critical points of a synthetic field with the module"""
        if self.spec.satisfies("~python"):
            raise SkipTest("there is no module without +python")
        script = "mesh, arrays = gale.read('grid:16'); mesh.critical_points(arrays['field'])"
        self.spec["python"].command("-c", f"import gale; {script}")

    def test_examples(self):
        """build the examples against the installed GALE and run them"""
        # The environment of tests has no CXX.
        compiler = host_compiler = self["cxx"].cxx
        if self.spec["kokkos"].satisfies("+wrapper"):
            compiler = self["kokkos"].kokkos_cxx
        environment = {"NVCC_WRAPPER_DEFAULT_COMPILER": host_compiler}
        # What GALE links, and nothing else: a test has less than a build, of which py-nanobind
        # makes its prefixes. Externals, whose prefix may be the system's, come last.
        linked = sorted(self.spec.traverse(deptype="link"), key=lambda spec: spec.external)
        prefixes = [prefix for spec in linked for prefix in spec.package.cmake_prefix_paths]
        source = join_path(self.test_suite.current_test_cache_dir, "examples")
        with working_dir("build", create=True):
            cmake = which(self.spec["cmake"].prefix.bin.cmake, required=True)
            cmake(
                source,
                self.define("CMAKE_PREFIX_PATH", prefixes),
                self.define("CMAKE_CXX_COMPILER", compiler),
                extra_env=environment,
            )
            cmake("--build", ".", extra_env=environment)
            ctest = which(self.spec["cmake"].prefix.bin.ctest, required=True)
            ctest("--output-on-failure")
