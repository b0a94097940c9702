"""Barchan from the repository in which this recipe lies. MPI and OpenMP are always there; +cuda adds GPUs of NVIDIA."""

from pathlib import Path

from spack_repo.builtin.build_systems.cmake import CMakePackage, generator
from spack_repo.builtin.build_systems.cuda import CudaPackage

from spack.package import *


class Barchan(CMakePackage, CudaPackage):
    """Grain-scale simulation of dunes under water: discrete elements in a large-eddy simulation of the flow."""

    git = Path(__file__).resolve().parents[6].as_uri()

    license("BSD-3-Clause")

    version("main", branch="main")

    generator("ninja")
    extends("python")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("python@3.11:", type=("build", "run"))
    for module in ("numpy", "h5py", "matplotlib", "scipy", "pillow"):
        depends_on(f"py-{module}", type="run")

    depends_on("kokkos@4.6:5 +openmp cxxstd=20")
    depends_on("mpi")
    depends_on("hdf5+mpi")
    depends_on("fftw@3:", when="~cuda")
    depends_on("cli11@2:")
    depends_on("eigen@3.3:")
    depends_on("fmt@9:")
    depends_on("nlohmann-json@3:")
    depends_on("tomlplusplus@3:")
    depends_on("zlib-api")

    with when("+cuda"):
        depends_on("kokkos+cuda+wrapper")
        for arch in CudaPackage.cuda_arch_values:
            depends_on(f"kokkos cuda_arch={arch}", when=f"cuda_arch={arch}")
        conflicts("cuda_arch=none", msg="name the card: cuda_arch=80 for the A100, cuda_arch=90 for the H100")

    def cmake_args(self):
        arguments = [
            self.define("BARCHAN_ENABLE_NATIVE", False),  # Spack's compiler wrapper knows the processor
            self.define("BARCHAN_ENABLE_TESTS", self.run_tests),
            self.define("BARCHAN_ENABLE_BENCHMARKS", False),
            self.define("BARCHAN_INSTALL_PYTHONDIR", python_platlib),
        ]
        if self.spec.satisfies("+cuda"):
            arguments.append(self.define("BARCHAN_ENABLE_PCH", False))
            arguments.append(self.define("CMAKE_CXX_COMPILER", self["kokkos"].kokkos_cxx))
        return arguments

    def setup_run_environment(self, env):
        env.set("BARCHAN_PYTHON", self["python"].command.path)
