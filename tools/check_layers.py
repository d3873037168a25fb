#!/usr/bin/env python3
"""Checks the structure of the source: layers, fences, public headers, silence of the engine, sizes.

The layers are in src/layers.txt.  Every fault is printed as "file:line: problem", and
the exit status is 1 if there was one.  File sizes are hints and never fail.
"""

import argparse
import re
import sys
from pathlib import Path

# The start of an include -> the only files and folders ("/" at the end) that may have it.
FENCES = {
    "toml++/": ["src/text/", "tests/"],
    "nlohmann/": ["src/text/", "src/meshio/", "src/resultio/", "src/parallel/", "src/window/", "tests/"],
    "pugixml.hpp": ["src/meshio/xml_file.h", "src/resultio/write_opf.cpp"],
    "CLI/": ["apps/quasimc/cli.cpp", "bench/"],
    "pybind11/": ["python/"],
    "embree3/": ["src/geometry/cast/embree.cpp", "bench/"],
    "embree4/": ["src/geometry/cast/embree.cpp", "bench/"],
    "boost/": [
        "src/geometry/mesh/crossings.cpp",
        "src/scene/overlap/overlap_grid.cpp",
        "src/sums/statistics.cpp",
        "tests/",
    ],
    "hwy/": [
        "src/raster/draw_span.cpp",
        "src/raster/triangle_block.cpp",
        "src/series/basis/add_responses.cpp",
        "src/samplers/vector_loops.cpp",
        "tests/",
    ],
    "tbb/": ["src/geometry/cast/embree.cpp"],
}

# The public headers, include/quasimc/, and the lowest module that includes each: its layer is that of
# the header.  The one that includes all of them is for users alone.
PUBLIC_HEADERS = {
    "error.h": "base",
    "share.h": "base",
    "version.h": "base",
    "mesh.h": "base",
    "material.h": "optics",
    "sums.h": "sums",
    "source.h": "light",
    "scene.h": "detectors",
    "run_spec.h": "solvers",
    "sun_shade.h": "results",
    "result.h": "results",
    "run.h": "run",
    "gap_fraction.h": "survey",
    "lamp_control.h": "series",
    "series.h": "series",
    "run_file.h": "runfile",
    "result_file.h": "resultio",
    "capi.h": "capi",
}
ALL_PUBLIC_HEADERS = "quasimc.h"
# Extensions of compilers, which public headers must not use.
NOT_STANDARD = re.compile(r"__int128|__extension__|__builtin_\w+|__attribute__|__declspec")

# Headers of libraries that are too slow to compile for our headers.
SOURCES_ONLY = ("toml++/", "nlohmann/", "CLI/", "embree3/", "embree4/", "hwy/", "boost/")
# Our headers that include them: only sources may include these.
SLOW_HEADERS = {"src/text/json_builder.h"}

# The engine uses no files, terminals and pipes, and never exits: all layers up to series, except text,
# files and growth.
ENGINE_TOP = "series"
NOT_ENGINE = {"text", "files", "growth"}
ENGINE_HEADERS = {"iostream", "fstream", "filesystem", "cstdio", "stdio.h", "unistd.h"}
ENGINE_CALLS = re.compile(r"\b(std::(cout|cerr|clog|exit|quick_exit|abort)\b|printf\s*\(|fopen\s*\()")
ENGINE_EXCEPTIONS = {"src/base/checks.h"}  # EXPECT and ENSURE end the program

FILE_LINES_HINT = 300

# Largest number of sources that include each other's headers, directly or indirectly; more are a
# fault.
LARGEST_KNOT = 3

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def read_layers(root):
    """The layer of each module, and the set of modules in no order."""
    layers = {}
    for line in (root / "src/layers.txt").read_text().splitlines():
        words = line.split()
        if words and not line.startswith("#"):
            layers.update({name: int(words[0]) for name in words[1:]})
    return layers


def read_links(root, layers):
    """For each module: the modules it links, and those of them that its users see (PUBLIC)."""
    every, public = {}, {}
    for module in layers:
        path = root / "src" / module / "CMakeLists.txt"
        if not path.exists():
            continue
        every[module], public[module] = set(), set()
        scope = None
        for word in re.findall(r"[\w+.]+", re.sub(r"#.*", "", path.read_text())):
            if word in ("NAME", "SOURCES", "PUBLIC", "PRIVATE", "DEFINITIONS"):
                scope = word
            elif word in layers and scope in ("PUBLIC", "PRIVATE"):
                every[module].add(word)
                if scope == "PUBLIC":
                    public[module].add(word)
    return every, public


def reachable(module, every, public):
    """The modules whose headers a module's sources may include: links, and what those publish."""
    seen, todo = set(), list(every.get(module, ()))
    while todo:
        name = todo.pop()
        if name not in seen:
            seen.add(name)
            todo.extend(public.get(name, ()))
    return seen


def module_of(path, layers):
    """The module a file belongs to; None for tests, benchmarks and the header of all."""
    parts = path.parts
    if parts[0] in ("apps", "python"):
        return parts[0]
    if parts[0] == "src" and len(parts) > 2 and parts[1] in layers:
        return parts[1]
    if parts[0] == "include":
        return PUBLIC_HEADERS.get(path.name)
    return None


def knots(includes):
    """The sets of units that reach each other by their includes, by Tarjan's algorithm.

    A unit is a header with its source; `includes` has for each those it includes.
    """
    order, low, stack, found = {}, {}, [], []

    def visit(unit):
        order[unit] = low[unit] = len(order)
        stack.append(unit)
        for other in sorted(includes.get(unit, ())):
            if other not in order:
                visit(other)
            if other in stack:
                low[unit] = min(low[unit], low[other])
        if low[unit] == order[unit]:
            start = stack.index(unit)
            found.append(sorted(stack[start:]))
            del stack[start:]

    for unit in sorted(includes):
        if unit not in order:
            visit(unit)
    return found


class Checker:
    def __init__(self, root):
        self.root = root
        self.layers = read_layers(root)
        self.every, self.public = read_links(root, self.layers)
        self.faults = []
        self.hints = []
        self.includes = {}  # by unit of src/, its path without suffix

    def fault(self, path, line, problem):
        self.faults.append(f"{path}:{line}: {problem}")

    def check_own_include(self, path, line, module, target):
        parts = target.split("/")
        if path.parts[0] in ("tests", "bench") and (self.root / path.parts[0] / target).exists():
            return
        if parts[0] == "quasimc":
            self.check_public_include(path, line, module, parts[-1])
            return
        if path.parts[0] == "include":
            self.fault(path, line, f'"{target}" is private: users do not have it')
            return
        if len(parts) < 2:
            if path.parts[0] == "src":
                self.fault(path, line, f'include "{target}" from src/, as "<module>/..."')
            return
        if module is not None:
            self.check_module_include(path, line, module, target, parts[0])

    def check_public_include(self, path, line, module, name):
        if name == ALL_PUBLIC_HEADERS:
            if path.parts[0] == "src":
                self.fault(path, line, f'"quasimc/{name}" is for users; include what is needed of it')
        elif name not in PUBLIC_HEADERS:
            self.fault(path, line, f'"quasimc/{name}": no such header in PUBLIC_HEADERS')
        elif module is not None:
            self.check_module_include(
                path, line, module, f"quasimc/{name}", PUBLIC_HEADERS[name]
            )

    def check_module_include(self, path, line, module, target, other):
        if other == module:
            return
        if other not in self.layers:
            self.fault(path, line, f'"{target}": no module {other} in src/layers.txt')
        elif self.layers[other] >= self.layers[module]:
            self.fault(
                path,
                line,
                f"{module} (layer {self.layers[module]}) includes {other} "
                f"(layer {self.layers[other]}); only lower layers may be included",
            )
        elif self.is_engine(module) and other in NOT_ENGINE:
            self.fault(path, line, f"{module} belongs to the engine, which does not use {other}")
        elif module in self.every and other not in reachable(module, self.every, self.public):
            self.fault(path, line, f"{module} includes {other} but its CMakeLists.txt does not link it")

    def is_engine(self, module):
        return (
            module is not None
            and module not in NOT_ENGINE
            and self.layers[module] <= self.layers[ENGINE_TOP]
        )

    def check_fences(self, path, line, target):
        name = str(path)
        for start, includers in FENCES.items():
            if not target.startswith(start):
                continue
            allowed = any(name.startswith(p) if p.endswith("/") else name == p for p in includers)
            if not allowed:
                self.fault(path, line, f"<{target}> may be included only by {' or '.join(includers)}")
            is_slow = start in SOURCES_ONLY and target != "nlohmann/json_fwd.hpp"
            is_slow = is_slow and name not in SLOW_HEADERS
            if path.suffix == ".h" and is_slow and path.parts[0] != "bench":
                self.fault(path, line, f"<{target}> is slow to compile; include it in a .cpp")

    def check_file(self, path):
        text = (self.root / path).read_text(encoding="utf-8")
        lines = text.splitlines()
        module = module_of(path, self.layers)
        if path.parts[0] == "include" and module is None and path.name != ALL_PUBLIC_HEADERS:
            self.fault(path, 1, "not in PUBLIC_HEADERS")
        engine = self.is_engine(module) and str(path) not in ENGINE_EXCEPTIONS
        for number, content in enumerate(lines, 1):
            match = INCLUDE.match(content)
            if match and match.group(1) == '"':
                if path.parts[0] == "src":
                    unit = str(path.relative_to("src").with_suffix(""))
                    other = str(Path(match.group(2)).with_suffix(""))
                    self.includes.setdefault(unit, set()).update({other} - {unit})
                self.check_own_include(path, number, module, match.group(2))
            if match:
                self.check_fences(path, number, match.group(2))
                if engine and match.group(2) in ENGINE_HEADERS:
                    self.fault(path, number, f"the engine does not use <{match.group(2)}>")
            code = re.sub(r'//.*|"(\\.|[^"\\])*"', "", content)
            call = ENGINE_CALLS.search(code) if engine else None
            if call:
                self.fault(path, number, f"the engine neither prints nor exits: {call.group(0)}")
            word = NOT_STANDARD.search(code) if path.parts[0] == "include" else None
            if word:
                self.fault(path, number, f"{word.group(0)} is not standard C++, as public headers are")
        if len(lines) > FILE_LINES_HINT:
            self.hints.append(f"{path}: {len(lines)} lines; usually at most {FILE_LINES_HINT}")
        if path.suffix == ".cpp" and not self.is_listed(path):
            self.fault(path, 1, "not listed in the CMakeLists.txt of its folder")
        if path.suffix == ".h" and "#pragma once" not in text:
            self.fault(path, 1, "no #pragma once")

    def is_listed(self, path):
        """Whether the nearest CMakeLists.txt above a source lists it, by its path from there."""
        for folder in path.parents:
            cmake = self.root / folder / "CMakeLists.txt"
            if cmake.exists():
                name = re.escape(str(path.relative_to(folder)))
                pattern = rf"(?<![\w/]){name}(?!\w)"
                return re.search(pattern, cmake.read_text(encoding="utf-8"))
        return True

    def run(self):
        for folder in ("src", "include", "apps", "python", "tests", "bench"):
            for path in sorted((self.root / folder).rglob("*")):
                if path.suffix in (".h", ".cpp"):
                    self.check_file(path.relative_to(self.root))
        for knot in knots(self.includes):
            if len(knot) > LARGEST_KNOT:
                self.fault(f"src/{knot[0]}", 1, f"{len(knot)} units include each other: {', '.join(knot)}")
        return self.faults


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--root", type=Path, default=Path(__file__).resolve().parent.parent)
    checker = Checker(parser.parse_args().root)
    checker.run()
    for hint in checker.hints:
        print(f"hint: {hint}")
    for fault in checker.faults:
        print(fault, file=sys.stderr)
    print(f"layers: {len(checker.faults)} faults, {len(checker.hints)} hints")
    return 1 if checker.faults else 0


if __name__ == "__main__":
    sys.exit(main())
