#!/usr/bin/env python3
"""Each recipe of pkgconfig/recipes is read and executed as its package manager would, with stand-ins for the manager's
own functions, from an archive of the source into an empty prefix; what is installed there is then used.

usage: recipes.py FOLDER [RECIPE...]     by default conda spack guix vcpkg yggdrasil; d = 2 and 3
Fails where a recipe asks CMake for an option that it does not use, or installs something that does not work. Guix needs
guile, conda python3-yaml; a recipe whose tool is missing is skipped, and the script says so.
"""
import importlib.util
import os
import re
import shutil
import subprocess
import sys
import types
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
RECIPES = ROOT / "pkgconfig/recipes"
# One way to compile for all, so that ccache gives the second recipe what the first one compiled.
CMAKE = shutil.which("cmake")
FAST = "-DJAM_DIMENSIONS=2;3 -DCMAKE_BUILD_TYPE=Release -DJAM_WERROR=ON"


class Trial:
    """One recipe: an unpacked source, an empty prefix, and a cmake in PATH that adds FAST and keeps what it printed."""

    def __init__(self, folder, name):
        self.folder = folder / name
        shutil.rmtree(self.folder, ignore_errors=True)
        self.prefix, self.log = self.folder / "prefix", self.folder / "log"
        for path in (self.prefix, self.folder / "bin"):
            path.mkdir(parents=True)
        self.log.touch()
        cmake = self.folder / "bin/cmake"
        options = " ".join(f"'{option}'" for option in FAST.split(" "))
        cmake.write_text(f'#!/bin/sh\ncase $1 in --build | --install | -P) exec {CMAKE} "$@" ;; esac\n'
                         f'exec {CMAKE} "$@" {options}\n')  # fmt: skip
        cmake.chmod(0o755)
        if shutil.which("ccache"):
            os.environ.update({f"CMAKE_{language}_COMPILER_LAUNCHER": "ccache" for language in ("C", "CXX")})
        self.env = {**os.environ, "PATH": f"{cmake.parent}:{os.environ['PATH']}", "PREFIX": str(self.prefix), "prefix": str(self.prefix),
                    "PYTHON": sys.executable, "CMAKE_ARGS": "", "CMAKE_BUILD_PARALLEL_LEVEL": os.environ.get("JAM_JOBS", "2"),
                    "CCACHE_BASEDIR": str(self.folder), "CCACHE_NOHASHDIR": "1"}  # fmt: skip
        self.source = self.unpack()

    def unpack(self):
        source = self.folder / "libjam"
        shutil.rmtree(source, ignore_errors=True)
        source.mkdir()
        subprocess.run(["tar", "-xzf", next(self.folder.parent.glob("libjam-*.tar.gz")), "-C", source, "--strip-components=1"], check=True)
        return source

    def run(self, command, **more):
        """A list, or a text of the shell. What it prints goes to the log, whose end is shown where it fails."""
        shell = ["bash", "-euc", command] if isinstance(command, str) else [str(word) for word in command]
        before = self.log.stat().st_size
        with self.log.open("ab") as log:
            status = subprocess.run(shell, cwd=self.source, env={**self.env, **more}, stdout=log, stderr=log).returncode
        text = self.log.read_text(errors="replace")[before:]
        unused = re.search(r"Manually-specified variables were not used[^\n]*\n(\s+JAM_\w+\n?)+", text)
        if status or unused:
            sys.exit(f"{self.folder.name}: {shell[-1]}: {unused[0] if unused else text[-3000:]}")
        return text

    def use(self, python=None):
        """A program of CMake, and the module where there is one, by what is installed below the prefix alone."""
        self.run([CMAKE, "-S", HERE / "consumer", "-B", self.folder / "consumer", f"-DCMAKE_PREFIX_PATH={self.prefix}"])
        self.run(["cmake", "--build", self.folder / "consumer"])
        self.run([self.folder / "consumer/consumer"])
        if python:
            self.run([sys.executable, "-c", "import importlib.metadata as m, jam; assert m.version('jamming') and jam.__file__.startswith("
                      f"'{self.prefix}'); jam.System.random(n=20, dim=2)"], PYTHONPATH=str(python))  # fmt: skip


def conda(trial):
    """Outputs one after the other, the module's on top of the library's; their tests as they stand."""
    try:
        import yaml
    except ImportError:
        return "skipped: python3-yaml is not installed"
    site = trial.prefix / "lib/python/site-packages"
    kept = {}
    for output in yaml.safe_load((RECIPES / "recipe.yaml").read_text())["outputs"]:
        trial.unpack()
        for line in output["build"]["script"]:
            trial.run(line, SP_DIR=str(site))
        files = {path: path.stat().st_mtime_ns for path in trial.prefix.rglob("*") if path.is_file()}
        changed = [str(path) for path in kept if files[path] != kept[path]]
        if changed:
            sys.exit(f"conda: {output['package']['name']} installs over the package before: {changed}")
        kept = files
        for test in output["tests"]:
            for line in test.get("script", []):
                trial.run(f"export PATH={trial.prefix}/bin:$PATH; {line}")
            for module in test.get("python", {}).get("imports", []):
                trial.run([sys.executable, "-c", f"import {module}"], PYTHONPATH=str(site))
    trial.use(site)


def spack(trial):
    """Both ends of the variants. BLAS and LAPACK are those that are named, not what CMake would find."""
    made = types.SimpleNamespace(variants=set(), when=set())

    class Package:
        def define(self, name, value):
            return f"-D{name}={('OFF', 'ON')[value] if isinstance(value, bool) else value}"

        def define_from_variant(self, name, variant):
            assert variant in made.variants, variant
            return self.define(name, self.spec.satisfies("+" + variant))

    def directive(*given, **more):
        made.when |= set(re.findall(r"[+~](\w+)", more.get("when", "").split("^")[0]))

    package = types.ModuleType("spack.package")
    for name in ("maintainers", "license", "version", "depends_on", "extends", "conflicts"):
        setattr(package, name, directive)
    package.variant = lambda name, **more: made.variants.add(name)
    package.python = types.SimpleNamespace(path=sys.executable)
    package.python_platlib = str(trial.prefix / "lib/python/site-packages")
    base = "spack_repo.builtin.build_systems.cmake"
    sys.modules.update({"spack.package": package, base: types.SimpleNamespace(CMakePackage=Package)})
    sys.modules.update({name: types.ModuleType(name) for name in ("spack", *(base.rsplit(".", k)[0] for k in (1, 2, 3)))})
    described = importlib.util.spec_from_file_location("libjam_package", RECIPES / "package.py")
    module = importlib.util.module_from_spec(described)
    described.loader.exec_module(module)
    assert made.when <= made.variants, made.when - made.variants
    found = subprocess.run(["ldconfig", "-p"], capture_output=True, text=True, check=True).stdout
    blas = re.search(r"/\S*/libopenblas\.so\.0", found)
    if not blas:
        return "skipped: libopenblas0 is not installed"
    libs = types.SimpleNamespace(libs=types.SimpleNamespace(joined=lambda between: blas[0]))

    class Spec(dict):
        def satisfies(self, wanted):
            return (wanted[1:] in self["on"]) == (wanted[0] == "+")

    for chosen in (set(), made.variants):
        libjam = module.Libjam()
        libjam.spec = Spec(on=chosen, blas=libs, lapack=libs)
        trial.run(["cmake", "-S", ".", "-B", "build", "-G", "Ninja", f"-DCMAKE_INSTALL_PREFIX={trial.prefix}",
                   "-DCMAKE_BUILD_TYPE=Release", *libjam.cmake_args()])  # fmt: skip
        trial.run("cmake --build build; cmake --install build")
        needed = trial.run(f"readelf -d {next(trial.prefix.glob('lib*/**/libjam.so'))}")
        assert ("[libopenblas.so.0]" in needed) == ("lapack" in chosen), needed
        trial.use(package.python_platlib if "python" in chosen else None)


def guix(trial):
    """recipes.scm gives the flags that the package's forms evaluate to."""
    if not shutil.which("guile"):
        return "skipped: guile is not installed"
    text = trial.run(["guile", "--no-auto-compile", "-s", HERE / "recipes.scm", RECIPES / "guix.scm"],
                     GUIX_PYTHON_VERSION="%d.%d" % sys.version_info[:2])  # fmt: skip
    flags = re.findall(r"(?m)^flag (.*)", text)
    check = re.search(r"(?m)^check (.*)", text)[1]
    configure = ["cmake", "-S", ".", "-B", "build", "-DCMAKE_BUILD_TYPE=RelWithDebInfo", f"-DCMAKE_INSTALL_PREFIX={trial.prefix}",
                 "-DCMAKE_INSTALL_LIBDIR=lib", "-DCMAKE_INSTALL_RPATH_USE_LINK_PATH=TRUE", *flags]  # fmt: skip
    trial.run(configure)
    assert int(re.search(r"Total Tests: (\d+)", trial.run(f"cd build; {check} -N"))[1]) > 10  # these it would run
    trial.run([*configure, "-DJAM_BUILD_TESTS=OFF"])
    trial.run("cmake --build build; cmake --install build")
    trial.use(next(trial.prefix.glob("lib/python*/site-packages")))


def vcpkg(trial):
    """recipes.cmake has vcpkg's functions, with its moves of files; the rules about folders are those of its checks."""
    trial.run(["cmake", f"-DSOURCE={trial.source}", f"-DPREFIX={trial.prefix}", f"-DPORT_FOLDER={RECIPES / 'vcpkg'}", "-P",
               HERE / "recipes.cmake"])  # fmt: skip
    for path in ("share/libjam/copyright", "share/libjam/usage", "share/jam/jamConfig.cmake", "lib/pkgconfig/jam.pc"):
        assert (trial.prefix / path).is_file(), path
    assert not list(trial.prefix.rglob("lib/cmake"))
    moved = trial.prefix.rename(trial.folder / "moved")  # a folder of vcpkg's is moved about
    trial.prefix = moved
    trial.use()
    trial.run(f"PKG_CONFIG_PATH={moved}/lib/pkgconfig pkg-config --cflags jam | grep {moved}")


def yggdrasil(trial):
    """The script of BinaryBuilder, in folders as it has them."""
    text = (RECIPES / "build_tarballs.jl").read_text()
    source = trial.folder / "srcdir"
    source.mkdir()
    trial.source.rename(source / "libjam-1")
    trial.source = source
    (source / "spectra-1/include").mkdir(parents=True)
    (source / "spectra-1/include/Spectra").symlink_to("/usr/include/Spectra")
    (trial.folder / "toolchain.cmake").touch()
    trial.run('install_license() { install -D -t "$prefix/share/licenses/libjam" "$@"; }\n' + re.search(r'(?s)raw"""(.*?)"""', text)[1],
              WORKSPACE=str(trial.folder), CMAKE_TARGET_TOOLCHAIN=str(trial.folder / "toolchain.cmake"),
              nproc=trial.env["CMAKE_BUILD_PARALLEL_LEVEL"])  # fmt: skip
    for product in re.findall(r'LibraryProduct\("(\w+)"', text):
        assert (trial.prefix / f"lib/{product}.so").exists(), product
    trial.use()


if __name__ == "__main__":
    folder = Path(sys.argv[1]).resolve()
    folder.mkdir(parents=True, exist_ok=True)
    subprocess.run(["sh", ROOT / "pkgconfig/archive.sh", "HEAD", folder], check=True)
    known = {one.__name__: one for one in (conda, spack, guix, vcpkg, yggdrasil)}
    for name in sys.argv[2:] or known:
        print(f"{name}: {known[name](Trial(folder, name)) or 'built, installed and used'}", flush=True)
