#!/usr/bin/env python3
"""Makes BUILD/ifov_VERSION_ARCHITECTURE.deb of what is built in BUILD: program, library, headers, manual pages, completion, guide and the
Python package (which `make python` has built): python3 tools/make_deb.py BUILD

  --without-python    leave the Python package out
  --compression xz    what dpkg-deb knows: xz, zstd, gzip, none
"""

import argparse
import gzip
import hashlib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tools" / "deb"))
import manual  # noqa: E402
import policy  # noqa: E402


def done(*command, **more):
    return subprocess.run([str(word) for word in command], capture_output=True, text=True, check=True, **more).stdout


def version():
    return re.search(r"project\(ifov VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")).group(1)


def zipped(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(gzip.compress(text.encode(), 9, mtime=0))


def stage_program(build, usr):
    done("cmake", "--install", build, "--prefix", usr, "--strip")
    program, when = usr / "bin" / "ifov", date()
    zipped(usr / "share/man/man1/ifov.1.gz", manual.page(program, version(), when))
    for command in manual.commands(program):
        zipped(usr / f"share/man/man1/ifov-{command}.1.gz", manual.page(program, version(), when, command))
    completion = usr / "share/bash-completion/completions/ifov"
    completion.parent.mkdir(parents=True)
    completion.write_text(manual.completion(program), encoding="utf-8")
    documents = usr / "share/doc/ifov"
    (documents / "copyright").write_text(policy.copyright_file((documents / "NOTICE").read_text(encoding="utf-8")), encoding="utf-8")
    zipped(documents / "changelog.gz", policy.changelog(version(), seconds()))
    zipped(documents / "CHANGELOG.md.gz", (ROOT / "CHANGELOG.md").read_text(encoding="utf-8"))
    overrides = usr / "share/lintian/overrides/ifov"
    overrides.parent.mkdir(parents=True)
    overrides.write_text(policy.overrides(), encoding="utf-8")
    for book in ("guide", "formats", "images", "notebooks"):
        shutil.copytree(ROOT / "docs" / book, documents / book)
    shutil.copytree(ROOT / "examples", documents / "examples")


def stage_python(build, usr):
    """As it was built for the environment; the library is that of the package."""
    found = sorted((build / "venv").glob("lib/python3.*/site-packages/ifov"))
    if not found:
        sys.exit(f"{build}/venv has no Python package: make python, or --without-python")
    to = usr / "lib/python3/dist-packages"
    shutil.copytree(found[0], to / "ifov", ignore=shutil.ignore_patterns("__pycache__", "libifov.so*"))
    information = next(found[0].parent.glob("ifov-*.dist-info"))
    shutil.copytree(information, to / information.name, ignore=shutil.ignore_patterns("RECORD", "direct_url.json", "REQUESTED"))
    (to / information.name / "INSTALLER").write_text("debian\n", encoding="utf-8")


def seconds():
    """Since 1970, of the last change, so that the same sources make the same package."""
    if given := os.environ.get("SOURCE_DATE_EPOCH"):
        return int(given)
    try:
        return int(done("git", "-C", ROOT, "log", "-1", "--format=%ct"))
    except (OSError, subprocess.CalledProcessError):
        return int(time.time())


def date():
    return time.strftime("%Y-%m-%d", time.gmtime(seconds()))


def needed_libraries(files, build):
    """Names as the loader has them, of programs and libraries, and of those that are loaded late."""
    names = set()
    for file in files:
        names |= set(re.findall(r"\(NEEDED\).*\[(.*)\]", done("readelf", "-dW", file)))
    # Those that are loaded when one of their functions is first called (cmake/LateLibrary.cmake) stand in no header of a program.
    names |= set(re.findall(r'IFOV_LATE_\w+=\\*"([^"\\]+)', (build / "build.ninja").read_text(encoding="utf-8", errors="replace")))
    return {name for name in names if not name.startswith("libifov.so")}


def dependencies(files, build):
    """Debian packages that hold those libraries."""
    listed = {}
    for line in done("/sbin/ldconfig", "-p").splitlines():
        if found := re.match(r"\s+(\S+) \(.*x86-64.*\) => (\S+)", line):
            listed.setdefault(found.group(1), found.group(2))
    packages = set()
    for name in sorted(needed_libraries(files, build)):
        if name.startswith("ld-linux"):
            continue
        path = pathlib.Path(listed[name])
        # /lib is a link to /usr/lib, and packages name either.
        for one in (path, path.resolve(), pathlib.Path(str(path).removeprefix("/usr"))):
            held = subprocess.run(["dpkg", "-S", one], capture_output=True, text=True, check=False).stdout
            if held:
                packages.add(held.split(":")[0])
                break
        else:
            sys.exit(f"{name} ({path}): no Debian package has it")
    with_versions = []
    for package in sorted(packages):
        has = done("dpkg-query", "-W", "-f", "${Version}", package)
        with_versions.append(f"{package} (>= {has})" if package in ("libc6", "libstdc++6") else package)
    return with_versions


def control(build, root, with_python):
    binaries = [root / "usr/bin/ifov", *(root / "usr/lib").rglob("*.so*")]
    binaries = [file for file in binaries if file.is_file() and not file.is_symlink()]
    depends = dependencies(binaries, build)
    if with_python:
        module = next((root / "usr/lib/python3/dist-packages/ifov").glob("_ifov.cpython-*.so"))
        minor = int(re.match(r"_ifov\.cpython-3(\d+)", module.name).group(1))
        depends += [f"python3 (>= 3.{minor})", f"python3 (<< 3.{minor + 1})", "python3-numpy", "python3-xarray"]
    size = sum(file.stat().st_size for file in (root / "usr").rglob("*") if file.is_file() and not file.is_symlink()) // 1024
    fields = {
        "Package": "ifov",
        "Version": version(),
        "Architecture": done("dpkg", "--print-architecture").strip(),
        "Maintainer": policy.maintainer(),
        "Installed-Size": str(size),
        "Depends": ", ".join(depends),
        "Suggests": "python3-matplotlib, python3-netcdf4, python3-rasterio, python3-tqdm, python3-zarr, bash-completion",
        "Section": "science",
        "Priority": "optional",
        "Description": "synthetic remote-sensing images with a tested error bar on every pixel\n"
        " A scene of geometry, materials and temperatures, light and a sensor go in;\n"
        " calibrated radiance with a stated uncertainty comes out. The user states an\n"
        " accuracy, not a number of rays. Program, library with headers"
        + (", Python package." if with_python else "."),
    }
    return "".join(f"{name}: {value}\n" for name, value in fields.items())


def make(build, to, with_python=True, compression="xz"):
    """The path of the package, which is put into the folder `to`."""
    root = to / "deb"
    shutil.rmtree(root, ignore_errors=True)
    (root / "DEBIAN").mkdir(parents=True)
    stage_program(build, root / "usr")
    if with_python:
        stage_python(build, root / "usr")
    (root / "DEBIAN/control").write_text(control(build, root, with_python), encoding="utf-8")
    (root / "DEBIAN/shlibs").write_text(policy.shared_libraries(version()), encoding="utf-8")
    (root / "DEBIAN/triggers").write_text("activate-noawait ldconfig\n", encoding="utf-8")
    if with_python:
        for name, text in policy.python_scripts().items():
            (root / "DEBIAN" / name).write_text(text, encoding="utf-8")
    files = sorted(file for file in (root / "usr").rglob("*") if file.is_file() and not file.is_symlink())
    sums = "".join(f"{hashlib.md5(file.read_bytes()).hexdigest()}  {file.relative_to(root)}\n" for file in files)
    (root / "DEBIAN/md5sums").write_text(sums, encoding="utf-8")
    for path in [root, *root.rglob("*")]:
        if not path.is_symlink():
            runs = path.is_dir() or path.parent.name == "bin" or path.name in policy.python_scripts()
            path.chmod(0o755 if runs else 0o644)
    architecture = done("dpkg", "--print-architecture").strip()
    package = to / f"ifov_{version()}_{architecture}.deb"
    done("dpkg-deb", "--root-owner-group", f"-Z{compression}", "--build", root, package)
    return package


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--without-python", action="store_true")
    parser.add_argument("--compression", default="xz")
    options = parser.parse_args()
    os.umask(0o022)
    package = make(options.build.resolve(), options.build.resolve(), not options.without_python, options.compression)
    print(f"Package: {package} (apt-get install {package})")


if __name__ == "__main__":
    main()
