#!/usr/bin/env python3
"""Starts a new member of a family: tools/new.py bsdf oren_nayar

Makes its file, its test and its page from tools/templates/FAMILY, enters it in the catalogue of the
family and in the lists of CMake.  The new member compiles and its tests pass.  tools/new_test.py
checks the changed files, tools/new_build.py the build.
"""

import argparse
import re
import sys
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
TEMPLATES = "tools/templates"


@dataclass(frozen=True)
class Family:
    """Folders of the members of a family, and the entries in its catalogue.

    The texts are inserted above the lines "(tools/new.py WHAT above this line)" of the catalogue.
    In them and in the templates, @name@ is the name in snake_case, @Name@ in CapWords, @words@ with
    blanks, @Title@ the same with a capital, @page@ with hyphens; @member@ and @test@ are the files.
    """

    folder: str  # of the members
    tests: str  # the folder of their tests
    pages: str  # the folder of their pages
    catalogue: str
    entries: tuple  # of (WHAT, text)
    prefix: str = ""  # of the files of members and tests
    page: str = "@page@.md"
    others: tuple = ()  # of (file, pattern, replacement): lists that people read


# All paths of this tool.  A family is offered if its catalogue and its templates exist: for a new one,
# write the catalogue with the lines that mark insertions, and the three templates.
FAMILIES = {
    "sampler": Family(
        folder="src/samplers",
        tests="tests/unit/samplers",
        pages="docs/theory",
        catalogue="src/samplers/catalogue.cpp",
        entries=(
            ("declares a sampler", "std::unique_ptr<Sampler> make_@name@();"),
            ("enters a sampler", '    SamplerEntry{"@name@", "@words@", make_@name@, true},'),
        ),
        others=(("docs/reference/options.md", r"(\| `sampler` .*? one of [^|]*?) \|", r"\1, @name@ |"),),
    ),
    "bsdf": Family(
        folder="src/optics",
        tests="tests/unit/optics",
        pages="docs/theory",
        catalogue="src/optics/catalogue.cpp",
        entries=(
            (
                "declares a model",
                "std::unique_ptr<Bsdf> make_@name@(Hemisphere hemisphere, "
                "std::span<const double> values);",
            ),
            (
                "enters the parameters of a model",
                """constexpr std::array k@Name@{BsdfParameter{
    .name = "exponent",
    .low = 0,
    .high = kMaxExponent,
    .usual = 10,
    .summary = "the larger, the narrower the lobe",
    .suggestion = "for one direction use model 'mirror'"}};
""",
            ),
            ("enters a model", '    BsdfEntry{"@name@", "@words@", k@Name@, make_@name@},'),
        ),
    ),
    "format": Family(
        folder="src/meshio",
        tests="tests/unit/meshio",
        pages="docs/reference",
        catalogue="src/meshio/formats.cpp",
        prefix="read_",
        page="@name@.md",
        entries=(
            (
                "declares a format",
                "MeshFile read_@name@(std::string_view bytes, FormatContext& context);",
            ),
            (
                "enters a format",
                """        FormatEntry{
            .name = "@name@",
            .extensions = ".@name@",
            .summary = "@words@",
            .organs = "each",
            .read = read_@name@},""",
            ),
        ),
    ),
    "output": Family(
        folder="src/resultio",
        tests="tests/unit/resultio",
        pages="docs/reference",
        catalogue="src/runfile/output_catalogue.h",
        prefix="write_",
        entries=(
            ("declares an output", "MakeOutput make_@name@;"),
            (
                "enters an output",
                """    take(
        OutputKey{"@name@", "write @words@ here; - is standard output"},
        [](const auto& input) { return make_@name@(input); });""",
            ),
        ),
    ),
    "solver": Family(
        folder="src/solvers",
        tests="tests/unit/solvers",
        pages="docs/theory",
        catalogue="src/solvers/catalogue.cpp",
        entries=(
            (
                "declares a solver",
                "std::unique_ptr<Solver> make_@name@(const SolverInput& input);",
            ),
            (
                "enters a solver",
                """        SolverEntry{
            Method::@name@, "@name@", "@words@", make_@name@, light_tracing_meaning},""",
            ),
        ),
        others=(
            (
                "include/quasimc/run_spec.h",
                r"( *// \(tools/new\.py enters a method above this line\))",
                r"    @name@,  ///< @words@\n\1",
            ),
            ("docs/reference/options.md", r"(\| `method` .*? one of [^|]*?), auto \|", r"\1, @name@, auto |"),
        ),
    ),
    "detector": Family(
        folder="src/detectors",
        tests="tests/unit/detectors",
        pages="docs/theory",
        catalogue="src/detectors/catalogue.cpp",
        entries=(
            (
                "declares a detector",
                "std::unique_ptr<Detector> make_@name@(std::span<const double> values);",
            ),
            (
                "enters the parameters of a detector",
                """constexpr std::array k@Name@{DetectorParameter{
    .name = "sectors",
    .summary = "of the azimuth",
    .kind = NumberKind::whole,
    .low = 1,
    .high = 360,
    .usual = 8}};
""",
            ),
            (
                "enters a detector",
                """    DetectorEntry{
        .name = "@name@",
        .summary = "@words@",
        .light = DetectedLight::escaped,
        .parameters = k@Name@,
        .make = make_@name@},""",
            ),
        ),
    ),
}


def available(root):
    """The families that can be added to, by name."""
    return {
        name: family
        for name, family in FAMILIES.items()
        if (root / family.catalogue).exists() and (root / TEMPLATES / name).is_dir()
    }


def filled(text, family, name):
    """The text with the placeholders replaced by the spellings of the name."""
    words = name.replace("_", " ")
    spellings = {
        "member": f"{family.folder}/{family.prefix}{name}.cpp",
        "test": f"{family.tests}/{family.prefix}{name}_test.cpp",
        "name": name,
        "Name": "".join(word.capitalize() for word in name.split("_")),
        "words": words,
        "Title": words.capitalize(),
        "page": name.replace("_", "-"),
    }
    return re.sub(r"@(\w+)@", lambda match: spellings[match[1]], text)


def with_entry(text, what, entry):
    """A catalogue with an entry above the line that marks the insertion."""
    mark = f"(tools/new.py {what} above this line)"
    lines = text.split("\n")
    marked = [i for i, line in enumerate(lines) if mark in line]
    if len(marked) != 1:
        raise ValueError(f"{len(marked)} lines say {mark}")
    return "\n".join(lines[: marked[0]] + entry.split("\n") + lines[marked[0] :])


def with_source(text, file):
    """A CMakeLists.txt with a file among the first SOURCES, in the order of the alphabet."""
    match = re.search(r"\bSOURCES\s+((?:[\w./]+\.cpp\s+)+)", text)
    if not match:
        raise ValueError("no list of SOURCES")
    files = list(re.finditer(r"[\w./]+\.cpp", match[1]))
    start = match.start(1)
    for other in files:
        if other[0] > file:
            column = start + other.start() - text.rfind("\n", 0, start + other.start()) - 1
            begin = start + other.start()
            return f"{text[:begin]}{file}\n{' ' * column}{text[begin:]}"
    last = start + files[-1].start()
    column = last - text.rfind("\n", 0, last) - 1
    end = start + files[-1].end()
    return f"{text[:end]}\n{' ' * column}{file}{text[end:]}"


def list_of(root, file):
    """The nearest CMakeLists.txt above a file, and the file's path from there."""
    for folder in Path(file).parents:
        if (root / folder / "CMakeLists.txt").exists():
            return f"{folder}/CMakeLists.txt", str(Path(file).relative_to(folder))
    raise ValueError(f"no CMakeLists.txt above {file}")


def planned(root, kind, name):
    """The text of every file that a new member makes or changes, by path; nothing is written."""
    family = FAMILIES[kind]
    templates = root / TEMPLATES / kind
    stem = f"{family.prefix}{name}"
    made = {
        f"{family.folder}/{stem}.cpp": "member.cpp.in",
        f"{family.tests}/{stem}_test.cpp": "test.cpp.in",
        f"{family.pages}/{filled(family.page, family, name)}": "page.md",
    }
    texts = {}
    for path, template in made.items():
        if (root / path).exists():
            raise ValueError(f"{path} exists already")
        text = (templates / template).read_text(encoding="utf-8")
        texts[path] = filled(text, family, name)

    catalogue = (root / family.catalogue).read_text(encoding="utf-8")
    for what, entry in family.entries:
        catalogue = with_entry(catalogue, what, filled(entry, family, name))
    texts[family.catalogue] = catalogue
    for folder, file in ((family.folder, f"{stem}.cpp"), (family.tests, f"{stem}_test.cpp")):
        lists, listed = list_of(root, f"{folder}/{file}")
        texts[lists] = with_source((root / lists).read_text(encoding="utf-8"), listed)
    for path, pattern, replacement in family.others:
        text = (root / path).read_text(encoding="utf-8")
        texts[path], count = re.subn(pattern, filled(replacement, family, name), text, count=1)
        if count != 1:
            raise ValueError(f"{path} has no line like {pattern}")
    return texts


def create(root, kind, name):
    """Writes a new member; returns the paths made and the paths changed."""
    texts = planned(root, kind, name)
    made = [path for path in texts if not (root / path).exists()]
    for path, text in texts.items():
        (root / path).write_text(text, encoding="utf-8")
    return made, [path for path in texts if path not in made]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("kind", choices=available(ROOT))
    parser.add_argument("name", help="snake_case")
    parser.add_argument("--root", type=Path, default=ROOT)
    args = parser.parse_args()
    if not re.fullmatch(r"[a-z][a-z0-9]*(_[a-z0-9]+)*", args.name):
        parser.error(f"{args.name}: write the name in snake_case")
    try:
        made, changed = create(args.root, args.kind, args.name)
    except ValueError as error:
        sys.exit(f"new.py: {error}")
    for path in made:
        print(f"wrote {path}")
    for path in changed:
        print(f"entered it in {path}")
    print("It builds and its test passes. Now write the model itself, its test and its page.")


if __name__ == "__main__":
    main()
