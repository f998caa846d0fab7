#!/usr/bin/env python3
"""Writes docs/citations.md: which header takes what from which source, as the headers' comments and docs/references.bib say.

Usage: docs/citations.py [--check]     with --check it writes nothing, and fails where the page is not what it would write.
An equation belongs to the paper that is named with it, before it in the same comment, or alone in the whole header."""
import re
import sys
from collections import defaultdict
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
INCLUDE = ROOT / "include" / "incognita"
PAGE = ROOT / "docs" / "citations.md"

# The papers that are cited by equation, by the name that comments use.
PAPERS = {"Seo": "seo_b_activeseal", "Isleyen": "isleyen_action_aware", "Sansoni": "sansoni_siren", "Carley": "carley_hybrid_navigation",
          "Popović": "popovic_informative_planning"}  # fmt: skip
AUTHOR = re.compile(r"\b(" + "|".join(PAPERS) + r")\b")
REFERENCE = re.compile(
    r"(?<![\w)])(\((?:A\.)?\d{1,2}[a-z]?\))(?: to (\((?:A\.)?\d{1,2}[a-z]?\)))?|\b(Lemma \d+\.\d+|Algorithms? \d+(?:(?: and|-) ?\d+)?|"
    r"Tables? [IVX]+(?: and [IVX]+)?|Fig\. \d+[a-z]?|[Ss]ection [IVX\d]+(?:[.-][A-Z\d]+)*|Appendix A\.\d+|[Ff]ootnote \d+|(?<=et al\., )(?:[A\d]\.\d|[IVX]+-[A-Z])(?: and \d\.\d)?)")
LATEX = {r"{\'e}": "é", r"{\'o}": "ó", r"{\'c}": "ć", r'{\"u}': "ü", r'{\"O}': "Ö", r"{\ss}": "ß", r"{\.I}": "İ", r"{\c s}": "ş"}


def bibliography():
    entries = {}
    for kind, key, body in re.findall(r"^@(\w+)\{(\w+),\n(.*?)^\}", (ROOT / "docs" / "references.bib").read_text(), re.M | re.S):
        fields = {name: " ".join(value.split()) for name, value in re.findall(r"^  (\w+) = \{(.*?)\},$", body, re.M | re.S)}
        for mark, letter in LATEX.items():
            fields = {name: value.replace(mark, letter) for name, value in fields.items()}
        entries[key] = {name: value.replace("{", "").replace("}", "").replace("--", "-") for name, value in fields.items()}
    return entries


def described(entry):
    names = [" ".join(reversed(name.split(", "))) for name in entry["author"].split(" and ")]
    people = names[0] if len(names) == 1 else ", ".join(names[:-1]) + " and " + names[-1]
    where = entry.get("journal") or entry.get("booktitle") or entry.get("publisher") or entry.get("institution")
    if "volume" in entry:
        where += f" {entry['volume']}" + (f"({entry['number']})" if "number" in entry else "")
    elif "number" in entry:
        where += f", {entry['number']}"
    if "pages" in entry:
        where += f", {entry['pages']}"
    parts = [f"{people}: \"{entry['title']}\"", where, entry.get("year"), f"doi:{entry['doi']}" if "doi" in entry else None]
    return ", ".join(part for part in parts if part) + "."


def comments_of(path):
    """Each run of comment lines of a header as (line of its beginning, one line of text)."""
    blocks, begin, text = [], 0, []
    for number, line in enumerate(path.read_text().splitlines() + [""], 1):
        found = re.search(r"//[/<]*\s?(.*)$", line)
        whole = line.lstrip().startswith("//")
        if found and whole and text:
            text.append(found.group(1))
            continue
        if text:
            blocks.append((begin, " ".join(text)))
            text = []
        if found and whole:
            begin, text = number, [found.group(1)]
        elif found:
            blocks.append((number, found.group(1)))
    return blocks


def paper_of(match, text, of_file, of_head):
    """Whose equation a reference is: the author named right after it, before it in the comment, alone in its file or at its head, or
    after it."""
    after = re.match(r"(?:(?:,| and| to|) \([A.\d]+[a-z]?\))*,? of (\w+)", text[match.end():])
    if after and after.group(1) in PAPERS:
        return after.group(1)
    before = AUTHOR.findall(text[:match.start()])
    if before:
        return before[-1]
    for alone in (of_file, of_head):
        if len(alone) == 1:
            return next(iter(alone))
    later = AUTHOR.findall(text[match.end():])
    return later[0] if later else None


def citations():
    """{author: {reference: {header}}}, and what cannot be told whose it is as (header, line, reference)."""
    cited, unknown = {author: defaultdict(set) for author in PAPERS}, []
    for path in sorted(INCLUDE.rglob("*.hpp")):
        header = str(path.relative_to(INCLUDE))
        blocks = comments_of(path)
        of_file = set(AUTHOR.findall(" ".join(text for _, text in blocks)))
        if not of_file:
            continue
        of_head = set(AUTHOR.findall(blocks[0][1]))
        for line, text in blocks:
            for match in REFERENCE.finditer(text):
                author = paper_of(match, text, of_file, of_head)
                reference = match.group(3) or match.group(1) + (f" to {match.group(2)}" if match.group(2) else "")
                if author is None:
                    unknown.append((header, line, reference))
                else:
                    cited[author][reference[0].upper() + reference[1:]].add(header)
    return cited, unknown


def natural(reference):
    kind = 0 if reference[0] == "(" and "A." not in reference else 1 if reference[0] == "(" else 2
    return kind, [int(part) if part.isdigit() else part for part in re.split(r"(\d+)", reference)]


def page():
    entries, (cited, unknown) = bibliography(), citations()
    for header, line, reference in unknown:
        print(f"include/incognita/{header}:{line}: it cannot be told whose {reference} is", file=sys.stderr)
    lines = ["# Citations", "", "Made by `docs/citations.py` of the comments in the headers and of [references.bib](references.bib); not to be "
             "edited. Paths are under `include/incognita/`. Where a paper is wrong or silent, the header says what was done.", ""]
    for author, key in PAPERS.items():
        entry = entries[key]
        lines += [f"## {entry['note']}: {author} et al.", "", described(entry), ""]
        if not cited[author]:
            lines += ["Nothing of it is in the library yet.", ""]
            continue
        lines += ["| what | headers |", "|---|---|"]
        for reference in sorted(cited[author], key=natural):
            headers = ", ".join(f"`{header}`" for header in sorted(cited[author][reference]))
            lines.append(f"| {reference} | {headers} |")
        lines.append("")
    lines += ["## Other sources", "", "| source | named in |", "|---|---|"]
    texts = {str(path.relative_to(INCLUDE)): " ".join(text for _, text in comments_of(path)) for path in sorted(INCLUDE.rglob("*.hpp"))}
    texts["README.md"] = (ROOT / "README.md").read_text()
    for key, entry in sorted(entries.items()):
        if key in PAPERS.values():
            continue
        surname = entry["author"].split(",")[0]
        headers = [header for header, text in texts.items() if re.search(rf"\b{surname}\b", text)]
        if not headers:
            print(f"docs/references.bib: {key} is named nowhere", file=sys.stderr)
            unknown.append(key)
        lines.append(f"| {described(entry)} | {', '.join(f'`{header}`' for header in headers)} |")
    surnames = {entry["author"].split(",")[0] for entry in entries.values()}
    for header, text in texts.items():
        for name in re.findall(r"\b([A-Z][a-zA-Zßäöü]+)(?: and [A-Z][a-zß]+| et al\.)?,? \(?(?:19|20)\d\d\b", text):
            if name not in surnames and name not in ("Functions", "Zen"):
                print(f"{header}: {name} is not in docs/references.bib", file=sys.stderr)
                unknown.append(name)
    return "\n".join(lines) + "\n", not unknown


def main():
    text, is_sound = page()
    if "--check" in sys.argv[1:]:
        if not PAGE.exists() or PAGE.read_text() != text:
            print("docs/citations.md is not what docs/citations.py writes: run it", file=sys.stderr)
            is_sound = False
        return 0 if is_sound else 1
    PAGE.write_text(text)
    return 0 if is_sound else 1


if __name__ == "__main__":
    sys.exit(main())
