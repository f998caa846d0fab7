#!/usr/bin/env python3
"""Holds the pages of docs/ to the code. Fails, naming file and line, for

- a concept of the headers without a section of its name under docs/concepts/, and a section that lacks its laws, complexity, thread
  safety, models or check;
- a name in code font on those pages and on docs/equations.md that the headers do not have, and a path that does not exist;
- a C++ block on the concepts' pages that does not compile (--compiler CXX);
- a picture under docs/ without its line in docs/pictures.md (a line may name many, by `*`), a line without its picture, a command that runs
  no example;
- a link of README.md, CONTRIBUTING.md and docs/ to a file that is not there.

docs/citations.md is checked by docs/citations.py --check."""
import argparse
import re
import subprocess
import sys
import tempfile
from fnmatch import fnmatchcase
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
DOCS = ROOT / "docs"
INCLUDE = ROOT / "include"
FENCE = re.compile(r"^```(\w*)\n(.*?)^```$", re.M | re.S)
SAID = {"laws": r"\b[Ll]aws?\b", "complexity": r"\bComplexity\b", "thread safety": r"\bThread safety\b", "models": r"\bModels?:",
        "valid expressions": r"\bexpressions?\b|whose `P::", "a check": r"`check_\w+_laws`|\b(no laws|[Nn]othing checks|are checked)\b"}
problems = []


def report(path, line, problem):
    problems.append(f"{path.relative_to(ROOT)}:{line}: {problem}")


def line_of(text, offset):
    return text.count("\n", 0, offset) + 1


def without_fences(text):
    return FENCE.sub(lambda block: "\n" * block.group(0).count("\n"), text)


def code_of(path):
    """A header without its comments and without what is in detail."""
    text = re.sub(r"//[^\n]*", "", path.read_text())
    return re.sub(r"^namespace (incognita::)?detail \{.*?^\}", "", text, flags=re.M | re.S)


def check_concepts(headers):
    pages = {path: path.read_text() for path in sorted((DOCS / "concepts").glob("*.md"))}
    for header, code in headers.items():
        for match in re.finditer(r"^concept (\w+)\b", code, re.M):
            name = match.group(1)
            sections = [(path, found) for path, text in pages.items()
                        for found in re.finditer(rf"^## {name}\n(.*?)(?=^## |\Z)", text, re.M | re.S)]
            if len(sections) != 1:
                report(header, line_of(code, match.start()), f"the concept {name} has {len(sections)} sections under docs/concepts/, not one")
                continue
            path, found = sections[0]
            for what, pattern in SAID.items():
                if not re.search(pattern, found.group(1)):
                    report(path, line_of(pages[path], found.start()), f"the section {name} does not say: {what}")
    names = {match.group(1) for code in headers.values() for match in re.finditer(r"^concept (\w+)\b", code, re.M)}
    if not names:
        report(INCLUDE, 1, "no concept was found")
    for path, text in pages.items():
        for match in re.finditer(r"^## (\w+)$", text, re.M):
            if match.group(1) not in names:
                report(path, line_of(text, match.start()), f"there is no concept {match.group(1)}")


def check_names(headers):
    words = set(re.findall(r"\w+", "\n".join(headers.values())))
    for path in [*sorted((DOCS / "concepts").glob("*.md")), DOCS / "equations.md"]:
        text = without_fences(path.read_text())
        for match in re.finditer(r"`([^`\n]+)`", text):
            code, line = match.group(1), line_of(text, match.start())
            if re.fullmatch(r"[\w/.]+\.(hpp|cpp|py|md)", code):
                if not (INCLUDE / "incognita" / code).exists() and not (ROOT / code).exists():
                    report(path, line, f"there is no {code}")
                continue
            for name in re.findall(r"\b[A-Za-z_]\w*", code):
                if name not in words:
                    report(path, line, f"the headers have no {name}")


def check_snippets(compiler):
    eigen = subprocess.run(["pkg-config", "--cflags", "eigen3"], capture_output=True, text=True, check=True).stdout.split()
    for path in sorted((DOCS / "concepts").glob("*.md")):
        blocks = [(block, path.read_text()) for block in FENCE.finditer(path.read_text()) if block.group(1) == "cpp"]
        if not blocks:
            report(path, 1, "no C++ block shows a type of one's own")
        for block, text in blocks:
            with tempfile.TemporaryDirectory() as folder:
                source = Path(folder) / "block.cpp"
                source.write_text(f'#line {line_of(text, block.start()) + 1} "{path}"\n{block.group(2)}')
                run = subprocess.run([compiler, "-std=c++20", "-fsyntax-only", "-Wall", "-Wextra", "-Werror", "-I", str(INCLUDE), *eigen,
                                      str(source)], capture_output=True, text=True, check=False)
            if run.returncode != 0:
                report(path, line_of(text, block.start()), "does not compile:\n" + run.stderr)


def check_pictures():
    page = DOCS / "pictures.md"
    text = page.read_text()
    listed = {}
    for match in re.finditer(r"^\| `([^`]+\.png)` \| `([^`]+)`", text, re.M):
        listed[match.group(1)] = (line_of(text, match.start()), match.group(2))
    pictures = {str(path.relative_to(DOCS)) for path in DOCS.rglob("*.png")}
    if not pictures:
        report(page, 1, "no picture was found")
    for picture in sorted(pictures):
        if not any(fnmatchcase(picture, pattern) for pattern in listed):
            report(page, 1, f"{picture} has no line")
    for pattern, (line, command) in listed.items():
        if not any(fnmatchcase(picture, pattern) for picture in pictures):
            report(page, line, f"there is no docs/{pattern}")
        run = re.fullmatch(r"examples/run((?: [^ ]+)*)", command)
        words = run.group(1).split() if run else []
        example = words[0] if words and not words[0].startswith("-") else "kth_explorer"
        folder = ROOT / "examples" / example
        if run is None or not (folder / "main.cpp").exists():
            report(page, line, f"{command} runs no example")
            continue
        sources = "".join(path.read_text() for path in [*folder.glob("*.hpp"), *folder.glob("*.cpp")])
        for option in re.findall(r"--[\w-]+", command):
            if f'"{option}"' not in sources:
                report(page, line, f"{example} has no option {option}")


def check_links():
    for path in [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted(DOCS.rglob("*.md"))]:
        text = without_fences(path.read_text())
        for match in re.finditer(r"\]\(([^)#\s]+)(#[^)]*)?\)", text):
            target = match.group(1)
            if "://" not in target and not (path.parent / target).exists():
                report(path, line_of(text, match.start()), f"there is no {target}")


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--compiler", help="compiles the C++ blocks as well")
    compiler = arguments.parse_args().compiler
    headers = {path: code_of(path) for path in sorted(INCLUDE.rglob("*.hpp"))}
    check_concepts(headers)
    check_names(headers)
    check_pictures()
    check_links()
    if compiler:
        check_snippets(compiler)
    for problem in problems:
        print(problem)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
