#!/usr/bin/env python3
"""Holds the doc comments of the headers to what CONTRIBUTING.md promises: no public symbol without a comment, no number without its
unit, no error and no shape unsaid. Reads Doxygen's XML, made anew of the headers; prints file:line for each finding.

Usage: doc_check.py [--self-test | --write-debt]     77 where Doxygen is missing.
What is known to lack something stands in tests/doc_debt.txt. That list may only shrink: an entry that is no longer found must go.
--self-test reads tests/doc_check/ instead, where each line says what it lacks, and fails unless exactly that is found.

A symbol counts as documented when it has a comment; no name makes up for one. A number's unit is said by the end of its name or in its
comment, or it has none by its name (DIMENSIONLESS). A function throws when its body, or a private function of its class that it calls,
throws or requires something; what functions of other classes throw is not followed. Frame or shape must be said of vectors of points and of
matrices of dynamic size."""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
DEBT = ROOT / "tests" / "doc_debt.txt"

# A name carries its unit by its end: range_max_m, position_m_per_sqrt_s, half_width_cells.
UNIT_SUFFIX = re.compile(r"(^|_)(m|m2|m3|rad|rad2|s|hz|nats|nats_m2|bits|cells|px|deg|degrees|mrad|percent|per_[a-z0-9_]+)_?$")

# Names of numbers that have no unit: one of these words, whole, between underscores.
DIMENSIONLESS = {
    "probability", "odds", "alpha", "beta", "kappa", "gamma", "fraction", "ratio", "share", "weight", "weights", "count", "factor",
    "nees", "percentile", "chi2", "p", "q", "sine", "cosine", "sin", "cos"}  # fmt: skip

# A comment says the unit in one of these words.
UNIT_WORDS = re.compile(
    r"\b(metres?|m|m\^?[23]|m/s|rad(ians?)?\^?2?|rad/s|seconds?|hertz|nats|bits|degrees|percent|pixels|in cells|cells (wide|long|away)|"
    r"share|fraction|probability|probabilities|log-odds|ratio|factor|weights?|of any unit|([Nn]o|[Ww]ithout a) unit|the units? (of|that)|"
    r"in units of|[Ss]tandard deviations)\b|(?<!')\bs\b")

SHAPE_WORDS = re.compile(
    r"\b(frames?|axes|world|rows?|columns?|entries|one (for|per)|for each|coordinates|[23NnM] ?x ?[23NnM]|[NnM] by [NnM]|"
    r"robot's|sensor's|map's|polyline)\b|T_[a-z]")

THROW_CALL = re.compile(r"\b(require(_[a-z_]+)?|throw_[a-z_]+|validate(_[a-z_]+)?)\s*\(|\bthrow\b")
THROW_WORD = re.compile(r"\b[Tt]hrow(s|n|ing)?\b")
DYNAMIC = re.compile(
    r"Eigen::(Matrix|Vector|RowVector|Array)X|Eigen::Dynamic|Eigen::Ref<|Eigen::(Matrix|Dense|Array)Base|"
    r"(vector|span)< ?(const )?Eigen::|Eigen::Matrix< ?[^,>]*, ?Eigen::Dynamic")
NUMBER = re.compile(r"^(static |constexpr |inline |const |std::optional< ?)*(double|float)( ?>)?( const)?( ?&)?$")


def xml_of_headers(headers, folder):
    """Runs Doxygen on a folder of headers with the site's own settings, for XML alone."""
    settings = (ROOT / "docs" / "Doxyfile").read_text() + f"""
      INPUT = {headers}
      GENERATE_HTML = NO
      GENERATE_XML = YES
      XML_PROGRAMLISTING = NO
      WARNINGS = NO
      WARN_IF_UNDOCUMENTED = NO
      WARN_AS_ERROR = NO
    """
    environment = dict(os.environ, INCOGNITA_DOCS_OUTPUT=str(folder), INCOGNITA_VERSION="")
    subprocess.run(["doxygen", "-"], input=settings, text=True, cwd=ROOT, check=True, env=environment, stdout=subprocess.DEVNULL)
    return folder / "xml"


def text_of(element, *tags):
    return " ".join("".join(found.itertext()) for tag in tags for found in element.findall(tag)).strip()


def comment_of(element):
    return " ".join(text_of(element, "briefdescription", "detaileddescription").split())


class Source:
    """Bodies of functions, without comments and strings."""

    def __init__(self):
        self.files = {}

    def body(self, location):
        if location is None or location.get("bodystart") is None:
            return ""
        first, last = int(location.get("bodystart")), int(location.get("bodyend"))
        name = location.get("bodyfile") or location.get("file")
        if name not in self.files:
            self.files[name] = (ROOT / name).read_text().splitlines()
        lines = self.files[name]
        text = "\n".join(lines[first - 1:max(first, last)])
        text = re.sub(r"//[^\n]*", "", text)
        return re.sub(r'"([^"\\]|\\.)*"', '""', text)


def has_unit(name, *comments):
    bare = name.rstrip("_")
    if UNIT_SUFFIX.search(bare) or DIMENSIONLESS & set(bare.split("_")):
        return True
    return any(UNIT_WORDS.search(comment) for comment in comments)


def throwing_helpers(compound, source):
    """The private functions of a class that throw: who calls them throws as well."""
    return {member.findtext("name") for member in compound.iter("memberdef")
            if member.get("kind") == "function" and member.get("prot") != "public"
            and THROW_CALL.search(source.body(member.find("location")))}


def check_member(member, parent, helpers, source):
    """What the comment of one public member lacks, each a short sentence."""
    name = member.findtext("name")
    comment = comment_of(member)
    parameters = [(re.sub(r"\s+", " ", "".join(p.find("type").itertext())).strip() if p.find("type") is not None else "",
                   p.findtext("declname") or "") for p in member.findall("param")]
    kind = member.get("kind")
    if not comment:
        yield "no comment"
        return
    if kind == "enum":
        for value in member.findall("enumvalue"):
            if not comment_of(value):
                yield f"no comment of the value {value.findtext('name')}"
    type_name = re.sub(r"\s+", " ", text_of(member, "type"))
    if kind == "variable" and NUMBER.match(type_name) and not has_unit(name, comment):
        yield "no unit"
    if kind != "function":
        return
    for parameter_type, parameter in parameters:
        if NUMBER.match(parameter_type) and parameter and not has_unit(parameter, comment):
            yield f"no unit of {parameter}"
    if NUMBER.match(type_name) and not has_unit(name, comment):
        yield "no unit of what it returns"
    is_constructor = parent.get("kind") in ("class", "struct") and parent.findtext("compoundname").split("::")[-1] == name
    said = comment + (" " + comment_of(parent) if is_constructor else "")
    body = source.body(member.find("location"))
    throws = THROW_CALL.search(body) or any(re.search(rf"\b{helper}\(", body) for helper in helpers)
    if throws and not THROW_WORD.search(said):
        yield "throws, but does not say so"
    if any(DYNAMIC.search(parameter_type) for parameter_type, _ in parameters) and not SHAPE_WORDS.search(said):
        yield "no shape or frame of what it takes"


def findings(xml_folder):
    compounds = {}
    for path in sorted(xml_folder.glob("*.xml")):
        for compound in ElementTree.parse(path).getroot().findall("compounddef"):
            compounds[compound.get("id")] = compound
    hidden = {inner.text for compound in compounds.values() for inner in compound.findall("innerclass") if inner.get("prot") != "public"}
    source, seen = Source(), set()
    for compound in compounds.values():
        kind, title = compound.get("kind"), compound.findtext("compoundname")
        if kind not in ("class", "struct", "concept", "namespace", "union") or "detail" in title.split("::"):
            continue
        if any(title == name or title.startswith(name + "::") for name in hidden):
            continue
        place = compound.find("location")
        if kind != "namespace" and not comment_of(compound):
            yield place.get("file"), int(place.get("line")), title, "no comment"
        helpers = throwing_helpers(compound, source)
        for member in compound.iter("memberdef"):
            if member.get("prot") != "public" or member.get("id") in seen:
                continue
            seen.add(member.get("id"))
            where = member.find("location")
            for lack in check_member(member, compound, helpers, source):
                yield where.get("file"), int(where.get("line")), f"{title}::{member.findtext('name')}", lack


def relative(name):
    return str(Path(name).resolve().relative_to(ROOT)) if os.path.isabs(name) else name


def sorted_findings(headers):
    with tempfile.TemporaryDirectory() as folder:
        found = findings(xml_of_headers(headers, Path(folder)))
        return sorted({(relative(file), line, symbol, lack) for file, line, symbol, lack in found})


def self_test():
    expected = {(str(path.relative_to(ROOT)), number, lack) for path in (ROOT / "tests" / "doc_check").rglob("*.hpp")
                for number, line in enumerate(path.read_text().splitlines(), 1)
                for lack in re.findall(r"\[([^\]]+)\]", "".join(line.split("// lacks")[1:]))}
    found = {(file, line, lack) for file, line, _, lack in sorted_findings("tests/doc_check")}
    for file, line, lack in sorted(expected - found):
        print(f"{file}:{line}: not found: {lack}")
    for file, line, lack in sorted(found - expected):
        print(f"{file}:{line}: found, though not there: {lack}")
    return 0 if expected and expected == found else 1


def main():
    if shutil.which("doxygen") is None:
        print("Skipped: doxygen is not installed")
        return 77
    if "--self-test" in sys.argv[1:]:
        return self_test()
    found = sorted_findings("include/incognita")
    keys = {f"{file}: {symbol}: {lack}" for file, _, symbol, lack in found}
    if "--write-debt" in sys.argv[1:]:
        DEBT.write_text("".join(f"{key}\n" for key in sorted(keys)))
        return 0
    debt = set(DEBT.read_text().splitlines()) if DEBT.exists() else set()
    new = [entry for entry in found if f"{entry[0]}: {entry[2]}: {entry[3]}" not in debt]
    for file, line, symbol, lack in new:
        print(f"{file}:{line}: {symbol}: {lack}")
    paid = sorted(debt - keys)
    for key in paid:
        print(f"tests/doc_debt.txt: no longer found, take it out: {key}")
    print(f"{len(new)} new findings, {len(debt & keys)} in the debt")
    return 1 if new or paid else 0


if __name__ == "__main__":
    sys.exit(main())
