# SPDX-License-Identifier: GPL-3.0-or-later
"""PEP 517 backend: builds the compiled part of clatter with CMake and packs it as a wheel.

Nothing of it comes from an index of packages: CMake, a compiler and the libraries are those of the system.
"""

from __future__ import annotations

import base64
import hashlib
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import tomllib
import zipfile
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
SOURCES = ("CMakeLists.txt", "CMakePresets.json", "LICENSE", "README.md", "pyproject.toml", "analytic", "numeric", "validation",
           "notebooks-data", "tests/packages.bash")
DATA_LICENCE = ROOT / "validation" / "measured" / "data-licence.txt"  # of the measured drops, which the module carries
LEFT_OUT = {"__pycache__", "node_modules"}
# Libraries that every Debian has; others come with the wheel, as auditwheel would have it.
EVERYWHERE = re.compile(r"(linux-vdso|ld-linux.*|lib(c|m|dl|pthread|rt|gcc_s|stdc\+\+))\.so\.\d+")
EARLIEST = (1980, 1, 1, 0, 0, 0)  # of a zip file, so that equal files make an equal wheel

Settings = Mapping[str, Any] | None


def project() -> dict[str, Any]:
    """The table [project] with the version, which stands in CMakeLists.txt."""
    table: dict[str, Any] = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    found = re.search(r"project\(clatter VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))
    if not found:
        raise RuntimeError("CMakeLists.txt: no version of the project")
    table["version"] = found[1]
    return table


def metadata() -> str:
    """PKG-INFO, core metadata 2.1."""
    table = project()
    lines = ["Metadata-Version: 2.1", f"Name: {table['name']}", f"Version: {table['version']}",
             f"Summary: {table['description']}", f"License: {table['license']['text']}",
             f"Keywords: {','.join(table['keywords'])}", f"Requires-Python: {table['requires-python']}",
             *(f"Classifier: {name}" for name in table["classifiers"]),
             *(f"Requires-Dist: {name}" for name in table["dependencies"])]
    for extra, names in table["optional-dependencies"].items():
        lines += [f"Provides-Extra: {extra}", *(f'Requires-Dist: {name}; extra == "{extra}"' for name in names)]
    lines.append("Description-Content-Type: text/markdown")
    return "\n".join(lines) + "\n\n" + (ROOT / table["readme"]).read_text(encoding="utf-8")


def wheel_tag() -> str:
    """Of this interpreter and machine: the module is compiled for both."""
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{re.sub('[-.]', '_', sysconfig.get_platform())}"


def needed_packages() -> str:
    """Debian's packages that the build needs, from the list that the launcher installs."""
    text = (ROOT / "tests" / "packages.bash").read_text(encoding="utf-8")
    found = re.search(r"^program_packages=\(([^)]*)\)", text, re.MULTILINE)
    return " ".join([*(found[1].split() if found else []), "pybind11-dev", "python3-dev"])


def run(*command: str | Path) -> None:
    """@raise RuntimeError: with what may be missing."""
    try:
        subprocess.run([str(part) for part in command], check=True)
    except (OSError, subprocess.CalledProcessError) as error:
        raise RuntimeError(f"{error}\nThe build needs Debian's packages:\n  apt-get install {needed_packages()}") from None


def say(words: str) -> None:
    """On the terminal: pip keeps for a failure what a build prints, unless it is called with -v, as where there is no terminal."""
    try:
        with open("/dev/tty", "w", encoding="utf-8") as terminal:
            print(f"\nclatter: {words}", end="", file=terminal, flush=True)
    except OSError:
        print(f"clatter: {words}", file=sys.stderr, flush=True)


def compile_in(work: Path, jobs: int) -> None:
    """Compiles, and says at each tenth of the steps how far it is.  @raise RuntimeError: with what the compiler said."""
    say(f"compiling with {jobs} jobs, some ten minutes of processor time in all")
    command = ["cmake", "--build", str(work), "--parallel", str(jobs), "--target", "clatter_python"]
    said, tenth = [], 0
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, encoding="utf-8", errors="replace",
                          env=dict(os.environ, NINJA_STATUS="[%f/%t] ")) as build:
        for line in build.stdout or ():
            said.append(line)
            counter = re.match(r"\[(\d+)/(\d+)\] ", line)
            if counter and 10 * int(counter[1]) // int(counter[2]) > tenth:
                tenth = 10 * int(counter[1]) // int(counter[2])
                say(f"{counter[1]} of {counter[2]} steps")
    if build.returncode:
        raise RuntimeError("".join(said[-100:]) + "clatter: the build failed")


def build_and_install(stage: Path, settings: Settings) -> None:
    """The package, compiled for this interpreter as the launcher compiles the program, in stage/clatter."""
    work = Path(str((settings or {}).get("build-dir") or ROOT / "build" / f"wheel-{wheel_tag()}"))
    if not os.access(ROOT, os.W_OK) and not settings:
        work = stage.parent / "build"
    jobs = int(os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL") or len(os.sched_getaffinity(0)))
    run("cmake", "--preset", "release", "-S", ROOT, "-B", work, "-DCLATTER_PYTHON=ON",
        f"-DCLATTER_PYTHON_EXECUTABLE={sys.executable}", "-DCLATTER_PYTHON_DIR=.", "-DCLATTER_PYTHON_RPATH=$ORIGIN")
    compile_in(work, jobs)
    run("cmake", "--install", work, "--prefix", stage, "--component", "python", "--strip")
    bring_libraries(stage / "clatter")


def bring_libraries(package: Path) -> None:
    """Copies what the module is linked with and not every system has beside it, with the terms of Debian's package of it.

    @raise RuntimeError: a library is not there.
    """
    module = next(package.glob("_clatter*.so"))
    told = subprocess.run(["ldd", str(module)], check=True, capture_output=True, text=True).stdout
    for name, place in re.findall(r"^\s*(\S+) => (/\S+|not found)", told, re.MULTILINE):
        if EVERYWHERE.fullmatch(name):
            continue
        if place == "not found":
            raise RuntimeError(f"{name}: not found, with which {module.name} is linked")
        library = Path(place).resolve()
        shutil.copyfile(library, package / name)
        owned = shutil.which("dpkg") and subprocess.run(["dpkg", "-S", str(library)], capture_output=True, text=True).stdout
        if owned:  # else it is of this machine alone
            owner = owned.partition(":")[0]
            (package / "licences").mkdir(exist_ok=True)
            shutil.copyfile(f"/usr/share/doc/{owner}/copyright", package / "licences" / f"{owner}.txt")


def digest(data: bytes) -> str:
    """As RECORD has it."""
    return "sha256=" + base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()


def write_wheel(path: Path, files: Mapping[str, bytes], dist_info: str) -> None:
    """The files and their RECORD."""
    record = "".join(f"{name},{digest(data)},{len(data)}\n" for name, data in files.items()) + f"{dist_info}/RECORD,,\n"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as wheel:
        for name, data in {**files, f"{dist_info}/RECORD": record.encode()}.items():
            entry = zipfile.ZipInfo(name, EARLIEST)
            entry.external_attr = (0o755 if ".so" in name else 0o644) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            wheel.writestr(entry, data)


def dist_info_files(dist_info: str) -> dict[str, bytes]:
    """Metadata of the wheel."""
    wheel = f"Wheel-Version: 1.0\nGenerator: clatter\nRoot-Is-Purelib: false\nTag: {wheel_tag()}\n"
    return {f"{dist_info}/METADATA": metadata().encode(), f"{dist_info}/WHEEL": wheel.encode(),
            f"{dist_info}/LICENSE": (ROOT / "LICENSE").read_bytes(),
            f"{dist_info}/data-licence.txt": DATA_LICENCE.read_bytes()}


def build_wheel(wheel_directory: str, config_settings: Settings = None, metadata_directory: str | None = None) -> str:
    """Hook of PEP 517.  config_settings: build-dir, the folder that CMake builds in."""
    table = project()
    dist_info = f"clatter-{table['version']}.dist-info"
    name = f"clatter-{table['version']}-{wheel_tag()}.whl"
    with tempfile.TemporaryDirectory() as folder:
        stage = Path(folder) / "stage"
        build_and_install(stage, config_settings)
        files = {path.relative_to(stage).as_posix(): path.read_bytes() for path in sorted(stage.rglob("*")) if path.is_file()}
        write_wheel(Path(wheel_directory) / name, {**files, **dist_info_files(dist_info)}, dist_info)
    return name


def prepare_metadata_for_build_wheel(metadata_directory: str, config_settings: Settings = None) -> str:
    """Hook of PEP 517: without a build."""
    dist_info = f"clatter-{project()['version']}.dist-info"
    (Path(metadata_directory) / dist_info).mkdir()
    for name, data in dist_info_files(dist_info).items():
        (Path(metadata_directory) / name).write_bytes(data)
    return dist_info


def source_files() -> Iterator[Path]:
    """What a build needs."""
    for name in SOURCES:
        top = ROOT / name
        for path in [top] if top.is_file() else sorted(top.rglob("*")):
            if path.is_file() and not LEFT_OUT & set(path.parts):
                yield path


def build_sdist(sdist_directory: str, config_settings: Settings = None) -> str:
    """Hook of PEP 517."""
    base = f"clatter-{project()['version']}"
    with tempfile.TemporaryDirectory() as folder, \
            tarfile.open(Path(sdist_directory) / f"{base}.tar.gz", "w:gz", format=tarfile.PAX_FORMAT) as archive:
        for path in source_files():
            archive.add(path, f"{base}/{path.relative_to(ROOT).as_posix()}")
        info = Path(folder) / "PKG-INFO"
        info.write_text(metadata(), encoding="utf-8")
        archive.add(info, f"{base}/PKG-INFO")
    return f"{base}.tar.gz"
