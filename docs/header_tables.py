"""Tables of the public headers' declarations for the site, made from their comments."""

import re
from pathlib import Path

HEADERS = Path(__file__).resolve().parent.parent / "include/quasimc"
MARK = re.compile(r"^<!-- declarations of (\w+\.h) -->$", re.M)
COMMENT = re.compile(r"^(?:(?:///[^\n]*\n)+|/\*\*.*?\*/\n)", re.M | re.S)
NAME = re.compile(
    r"(?:template <.*>\s*)?(?:typedef )?(?:(?:class|struct|enum class|enum|using) )?"
    r"(?:\[\[nodiscard\]\] )?(.*)"
)


def name_of(declaration):
    """The name that a declaration declares, with () for functions; None for operators."""
    line = NAME.match(" ".join(declaration.split()))[1]
    kind = re.match(r"(?:typedef )?(?:class|struct|enum class|enum|using) ", declaration)
    if "operator" in line:
        return None
    pointer = re.match(r"\w+ \(\*(\w+)\)", line)
    if pointer:
        return pointer[1]
    if declaration.startswith("typedef"):
        return re.search(r"(\w+);", line)[1]
    if declaration.startswith("#define"):
        return line.split()[1]
    if kind:
        return re.match(r"\w+", line)[0]
    function = re.match(r"[^(={]*?(\w+)\(", line)
    if function:
        return function[1] + "()"
    constant = re.match(r".*?(\w+)\s*[={]", line)
    return constant[1] if constant else None


def purpose_of(comment):
    """The first paragraph of a comment, before its @param and the like, as a table's cell."""
    text = re.sub(r"^(?:///|/\*\*| \*/?)|\*/$", "", comment, flags=re.M)
    text = re.split(r"\n\s*\n|@\w+", text)[0].strip() or re.sub(r"@\w+", "", text)
    return " ".join(text.split()).replace("|", "\\|").replace("<", "&lt;").replace("*", "\\*")


def declarations(header):
    """Documented declarations at the top level of a header: (name, purpose)."""
    text = (HEADERS / header).read_text(encoding="utf-8")
    for comment in COMMENT.finditer(text):
        declaration = text[comment.end() : comment.end() + 400]
        if declaration and not declaration[0].isspace():
            name = name_of(re.split(r";\n|\{\n", declaration)[0] + ";")
            if name:
                yield name, purpose_of(comment[0])


def table(header):
    """A Markdown table of the declarations of a header; overloads share a row."""
    rows = {}
    for name, purpose in declarations(header):
        rows.setdefault(name, purpose)
    lines = [f"| `{name}` | {purpose} |" for name, purpose in rows.items()]
    return "\n".join(["| Declaration | Purpose |", "|---|---|", *lines])


def with_tables(page):
    """A page with the tables where it has `<!-- declarations of NAME.h -->`."""
    return MARK.sub(lambda mark: table(mark[1]), page)
