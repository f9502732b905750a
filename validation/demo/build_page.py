#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds the page of `clatter demo`, one file with both models in it, compiled to WebAssembly.

Needs Debian 12's emscripten (3.1.6), nodejs, npm, zopfli and the program's packages. GSL and Qhull come as source from the archive that
this machine's own lists of packages name.
"""

import argparse
import base64
import gzip
import hashlib
import os
import re
import resource
import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
INCLUDE = re.compile(r'^#include "([^"]+)"', re.MULTILINE)
# Debian's emscripten asks for Node.js packages of Debian's, wherever its Node.js comes from.
ENVIRONMENT = {**os.environ, "NODE_PATH": "/usr/share/nodejs", "EM_COMPILER_WRAPPER": os.environ.get("CMAKE_CXX_COMPILER_LAUNCHER", "")}
PAGE = HERE / "page.html"
# CTest's status for a test that was skipped.
SKIPPED = 77
# Headers of Debian's packages that are the same for every machine; the folder that holds them has this machine's, too.
HEADERS = ("boost", "fmt", "gsl", "libqhull_r", "nlohmann", "toml++")
# As in CMakeLists.txt: it has names that others of its folder have.
ALONE = {"validation/explain/space_steps.cpp"}
# The page has no command line.
COMMAND = re.compile(r"_commands?\.cpp$")
FLAGS = ["-O2", "-fexceptions"]
# What surrounds the models is loaded by everybody and takes no time to speak of.
SMALL = ["-Os"]
CXX_FLAGS = ["-std=c++20", "-DNDEBUG", "-ffp-contract=off", "-DFMT_HEADER_ONLY", "-DTOML_HEADER_ONLY=1"]
LINK_FLAGS = ["-sSINGLE_FILE=1", "-sALLOW_MEMORY_GROWTH=1", "-sMODULARIZE=1", "-sEXPORT_NAME=clatterModule",
              "-sENVIRONMENT=web,worker,node", "-sFILESYSTEM=0", "-sTOTAL_STACK=4194304",
              "-sEXPORTED_RUNTIME_METHODS=ccall"]
GSL_FILES = """
block/init blas/blas
cblas/dasum cblas/daxpy cblas/dcopy cblas/ddot cblas/dgemm cblas/dgemv cblas/dger cblas/dnrm2 cblas/dscal cblas/dswap
cblas/dtrmm cblas/dtrmv cblas/dtrsm cblas/dtrsv cblas/idamax cblas/xerbla
err/error err/message err/strerror err/stream
linalg/householder linalg/qr
matrix/copy matrix/getset matrix/init matrix/matrix matrix/oper matrix/prop matrix/rowcol matrix/submatrix matrix/swap
matrix/view
ode-initval2/rk4 ode-initval2/rk8pd ode-initval2/rkck ode-initval2/rkf45 ode-initval2/step
roots/fdfsolver roots/newton
specfunc/lambert
sys/coerce sys/expm1 sys/fdiv sys/hypot sys/infnan sys/ldfrexp sys/log1p sys/minmax sys/pow_int
vector/copy vector/init vector/oper vector/prop vector/subvector vector/swap vector/vector vector/view
""".split()
# All that computes; stat_r.c, whose numbers nobody reads here, belongs to it.
QHULL_FILES = """
geom2_r geom_r global_r io_r libqhull_r mem_r merge_r poly2_r poly_r qset_r random_r rboxlib_r stat_r user_r usermem_r userprintf_r
userprintf_rbox_r
""".split()
# For any machine whose C library is complete.
GSL_CONFIG = """
#define HAVE_DECL_ISNAN 1
#define HAVE_DECL_ISINF 1
#define HAVE_DECL_ISFINITE 1
#define HAVE_DECL_FINITE 0
#define HAVE_IEEE_COMPARISONS 1
#define HAVE_IEEE_DENORMALS 1
#define HAVE_DECL_EXPM1 1
#define HAVE_DECL_LOG1P 1
#define HAVE_DECL_HYPOT 1
#define HAVE_DECL_LDEXP 1
#define HAVE_DECL_FREXP 1
#define RELEASED
#define GSL_COERCE_DBL(x) (x)
#define RETURN_IF_NULL(x) if (!x) { return ; }
"""


def run(*command, **options):
    return subprocess.run([str(part) for part in command], check=True, **options)


def write(path, text):
    """Unless it says so already: what is newer is compiled anew."""
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")


def fetch_sources(folder):
    """Source packages of GSL and Qhull, by a list of packages of its own made from this machine's."""
    wanted = [package for package, file in (("gsl", "gsl_math.h"), ("qhull", "src/libqhull_r/libqhull_r.h")) if not (folder / package / file).exists()]
    if not wanted:
        return
    parts, lists = folder / "apt", folder / "lists"
    for path in (parts, lists / "partial"):
        path.mkdir(parents=True, exist_ok=True)
    for file in [Path("/etc/apt/sources.list"), *sorted(Path("/etc/apt/sources.list.d").glob("*"))]:
        if not file.is_file() or file.suffix not in (".list", ".sources"):
            continue
        text = file.read_text(encoding="utf-8")
        text = re.sub(r"^Types:.*$", "Types: deb-src", text, flags=re.MULTILINE) if file.suffix == ".sources" else \
            re.sub(r"^deb\s", "deb-src ", text, flags=re.MULTILINE)
        write(parts / file.name, text)
    options = ["-q", "-o", "Dir::Etc::SourceList=/dev/null", "-o", f"Dir::Etc::SourceParts={parts}", "-o", f"Dir::State::Lists={lists}",
               "-o", "APT::Sandbox::User=root"]
    for command in (["update", "-o", "APT::Update::Error-Mode=any"], ["source", "--download-only", *wanted]):
        done = subprocess.run(["apt-get", *options, *command], cwd=folder, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            said = [line for line in done.stderr.splitlines() if line.startswith("E:")]
            sys.exit(f"build_page.py: the source of {' and '.join(wanted)}, which comes through apt-get {command[0]}, is out of reach: "
                     f"{said[0] if said else 'no reason given'}")
    for package in wanted:
        archive, = folder.glob(f"{package}_*.orig.tar.*[!c]")  # a signature beside it ends in .asc
        (folder / package).mkdir(exist_ok=True)
        run("tar", "xf", archive, "--strip-components=1", "-C", folder / package)


def needed():
    """Headers and sources, api.cpp and what it needs: with a header the source of its name, and those of its folder that have no header."""
    def implementing(header):
        path = ROOT / header
        own = path.with_suffix(".cpp")
        without = [source for source in path.parent.glob("*.cpp") if not source.with_suffix(".hpp").exists() and not COMMAND.search(source.name)]
        return {str(source.relative_to(ROOT)) for source in {own, *without} if source.exists()}

    start = str((HERE / "api.cpp").relative_to(ROOT))
    seen, waiting = {start}, [start]
    while waiting:
        path = ROOT / waiting.pop()
        if not path.exists():
            continue  # made by the build
        for header in INCLUDE.findall(path.read_text(encoding="utf-8")):
            new = {header, *implementing(header)} - seen
            seen |= new
            waiting += new
    return sorted(seen)


def version_of_project():
    return re.search(r"project\(clatter VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))[1]


def generated(folder):
    """The sources that the build makes, as CMakeLists.txt does."""
    template = (ROOT / "validation/output/version.hpp.in").read_text(encoding="utf-8")
    write(folder / "generated/validation/output/version.hpp", template.replace("@PROJECT_VERSION@", version_of_project()))
    files = [f"validation/cases/{path.name}" for path in sorted((ROOT / "validation/cases").iterdir())]
    run("cmake", f"-DROOT={ROOT}", f"-DOUTPUT={folder}/embedded.new", f"-DFILES={'|'.join([*files, 'notebooks-data/tradeoff.csv'])}", "-P",
        ROOT / "validation/embedded/embed.cmake")
    write(folder / "generated/embedded.cpp", (folder / "embedded.new").read_text(encoding="utf-8"))


def units(folder):
    """Files of one folder are compiled together, as in the program."""
    by_folder = {}
    for name in needed():
        if not name.endswith(".cpp"):
            continue
        by_folder.setdefault(name.removesuffix(".cpp") if name in ALONE else name.rpartition("/")[0], []).append(name)
    for name, files in by_folder.items():
        unit = folder / "units" / (name.replace("/", "_") + ".cpp")
        write(unit, "".join(f'#include "{file}"\n' for file in files))
        yield unit
    yield folder / "generated/embedded.cpp"


def ninja(folder):
    include = folder / "include"
    include.mkdir(exist_ok=True)
    for name in HEADERS:
        if not (include / name).exists():
            (include / name).symlink_to(f"/usr/include/{name}")
    # The kernel's header, and what else glibc alone has.
    write(include / "linux/magic.h", "#define PROC_SUPER_MAGIC 0x9fa0\n#define ALLPERMS 07777\n")
    write(folder / "gsl/config.h", GSL_CONFIG)
    gsl = folder / "gsl"
    folders = [f"-I{ROOT}", f"-I{folder / 'generated'}", f"-isystem{include}", "-isystem/usr/include/eigen3"]
    # The files of one folder in one go: emcc takes longer to start than to compile one of them.
    lines = ["rule c", f"  command = mkdir -p $place && cd $place && emcc $flags {' '.join(FLAGS)} -w -c $in",
             "rule cxx",
             f"  command = em++ {' '.join(FLAGS + CXX_FLAGS + folders)} $small -include {HERE}/library.hpp -MD -MF $out.d -c $in -o $out",
             "  depfile = $out.d", "  deps = gcc",
             "rule link", f"  command = em++ {' '.join(FLAGS + LINK_FLAGS)} $in -o $out"]
    objects = []
    for number, unit in enumerate(units(folder)):
        objects.append(f"objects/{number:03d}-{unit.stem}.o")
        lines.append(f"build {objects[-1]}: cxx {unit}")
        if unit.stem.startswith("validation"):
            lines.append(f"  small = {' '.join(SMALL)}")
    for name in sorted({file.split("/")[0] for file in GSL_FILES}):
        files = [file for file in GSL_FILES if file.startswith(name + "/")]
        made = [f"objects/gsl/{file}.o" for file in files]
        lines.extend([f"build {' '.join(made)}: c {' '.join(f'{gsl}/{file}.c' for file in files)}", f"  place = objects/gsl/{name}",
                      f"  flags = -I{gsl} -I{gsl}/{name} -I{include}"])
        objects += made
    qhull = folder / "qhull/src"
    made = [f"objects/qhull/{file}.o" for file in QHULL_FILES]
    lines.extend([f"build {' '.join(made)}: c {' '.join(f'{qhull}/libqhull_r/{file}.c' for file in QHULL_FILES)}", "  place = objects/qhull",
                  f"  flags = -I{qhull}"])
    objects += made
    lines.append(f"build module.js: link {' '.join(objects)}")
    write(folder / "build.ninja", "\n".join(lines) + "\n")


def build_module(folder):
    fetch_sources(folder)
    ninja(folder)
    run("ninja", "-C", folder, "--quiet", "-k", "0", env=ENVIRONMENT)
    return folder / "module.js"


def notices():
    """What is compiled in, with the versions of Debian's packages."""
    def version(match):
        name = {"gsl": "libgsl-dev", "qhull": "libqhull-dev"}.get(match[1], match[1])
        return subprocess.run(["dpkg-query", "-W", "-f=${Version}", name], capture_output=True, text=True, check=True).stdout
    return re.sub(r"\{([a-z0-9.-]+)\}", version, (HERE / "notices.txt").read_text(encoding="utf-8"))


def digest(parts):
    """Of names and contents."""
    whole = hashlib.sha256()
    for name, content in parts:
        whole.update(f"{name} {len(content)} ".encode() + content)
    return whole.hexdigest()


def digest_of_models(module):
    """Of all that the compiled models follow from, the versions of Debian's packages included."""
    files = [name for name in needed() if (ROOT / name).exists()]
    made = sorted(path for path in (module / "generated").rglob("*") if path.is_file())
    options = repr([FLAGS, SMALL, CXX_FLAGS, LINK_FLAGS, HEADERS, GSL_FILES, GSL_CONFIG, QHULL_FILES])
    return digest([*((name, (ROOT / name).read_bytes()) for name in [*files, "validation/demo/library.hpp"]),
                   *((str(path.relative_to(module)), path.read_bytes()) for path in made), ("options", options.encode()),
                   ("versions", notices().encode())])


def digest_of_page():
    """Of what the page has beside the models; parts of other projects are as package-lock.json has them."""
    return digest([(path.name, path.read_bytes()) for path in sorted((HERE / "page").iterdir()) if path.is_file()])


def said_by(page, name):
    found = re.search(rf'<meta name="{name}" content="(\w*)">', page)
    return found[1] if found else ""


def unpacked(page):
    """The module of a page, as the compiler wrote it."""
    loader, code = (re.search(rf'<script type="text/plain" id="{name}">(.*?)</script>', page, re.DOTALL)[1] for name in ("module", "module-code"))
    place = 'wasmBinaryFile="data:application/octet-stream;base64,'
    return loader.replace(place, place + base64.b64encode(gzip.decompress(base64.b64decode(code))).decode(), 1)


def check(models):
    page = PAGE.read_text(encoding="utf-8")
    wrong = [what for what, name, now in (("models", "clatter-models", models), ("page", "clatter-page", digest_of_page())) if said_by(page, name) != now]
    if wrong:
        print(f"validation/demo/page.html was built from other sources ({' and '.join(wrong)} changed since).\n"
              "Before a release renew it:  validation/demo/build_page.py build/page --renew")
        sys.exit(SKIPPED)
    print("validation/demo/page.html is the page of these sources")


def bundle(folder, module, models):
    """By Node.js, whose packages are as package-lock.json has them."""
    for path in folder.glob("*.ts"):  # of an earlier version
        if not (HERE / "page" / path.name).exists():
            path.unlink()
    for path in (HERE / "page").iterdir():
        if path.is_file():
            shutil.copyfile(path, folder / path.name)
    lock = (folder / "package-lock.json").read_bytes()
    installed = folder / "installed"
    if not installed.exists() or installed.read_bytes() != lock:
        run("npm", "ci", "--ignore-scripts", "--no-audit", "--no-fund", "--loglevel=error", cwd=folder)
        installed.write_bytes(lock)
    (folder / "notices.txt").write_text(notices(), encoding="utf-8")
    run("node", "build.mjs", module, version_of_project(), models, digest_of_page(), folder / "notices.txt", folder / "page.html", cwd=folder)


def arguments():
    what, needs = __doc__.split("\n\n")
    parser = argparse.ArgumentParser(description=what, epilog=needs)
    parser.add_argument("folder", type=Path, help="takes page.html; the compiled models are those of validation/demo/page.html if "
                        "they come from these sources; else they are compiled, what was compiled in FOLDER/../module is used again")
    doing = parser.add_mutually_exclusive_group()
    doing.add_argument("--renew", action="store_true", help="also put the page where the program takes it from, validation/demo/page.html")
    doing.add_argument("--check", action="store_true", help="only say whether that is the page of these sources: status 0 if it is, 77 if not")
    parser.add_argument("--anew", action="store_true", help="compile the models in any case")
    return parser.parse_args()


def main():
    asked = arguments()
    folder = asked.folder.resolve()
    # Node.js reserves more addresses for a module than a campaign of faults leaves to a test.
    most = resource.getrlimit(resource.RLIMIT_AS)[1]
    resource.setrlimit(resource.RLIMIT_AS, (most, most))
    folder.mkdir(parents=True, exist_ok=True)
    compiled = (folder.parent / "module").resolve()
    compiled.mkdir(exist_ok=True)
    generated(compiled)
    models = digest_of_models(compiled)
    if asked.check:
        return check(models)
    page = PAGE.read_text(encoding="utf-8")
    if asked.anew or said_by(page, "clatter-models") != models:
        module = build_module(compiled)
    else:
        module = compiled / "of_the_page.js"
        write(module, unpacked(page))
    bundle(folder, module, models)
    if asked.renew:
        shutil.copyfile(folder / "page.html", PAGE)


if __name__ == "__main__":
    main()
