#!/usr/bin/env python3
"""Builds the site by docs/run into a folder and looks at it: that functions, concepts, pages and equations are there, and that no link
within the site is dead.

Usage: doc_site.py FOLDER     77 where Doxygen or MathJax is missing."""
import html
import re
import subprocess
import sys
from pathlib import Path
from urllib.parse import unquote

ROOT = Path(__file__).resolve().parent.parent


def main():
    folder = Path(sys.argv[1])
    run = subprocess.run([ROOT / "docs" / "run", "--no-install", "--output", folder], check=False)
    if run.returncode != 0:
        return run.returncode
    site = folder / "html"
    pages = {path: path.read_text(encoding="utf-8", errors="replace") for path in sorted(site.glob("*.html"))}
    problems = []

    def expect(page, text):
        if text not in pages.get(site / page, ""):
            problems.append(f"{page} does not have {text}")

    expect("index.html", "overview.png")
    expect("namespaceincognita.html", "ray_update")
    expect("classincognita_1_1Map.html", "probability")
    expect("md_docs_equations.html", r"\mathcal{N}")
    for page in (ROOT / "docs").rglob("*.md"):
        name = "md_" + str(page.relative_to(ROOT).with_suffix("")).replace("/", "_")
        if not any(path.name == name + ".html" for path in pages):
            problems.append(f"{page.relative_to(ROOT)} has no page {name}.html")
    for header in (ROOT / "include").rglob("*.hpp"):
        public = re.sub(r"^namespace (incognita::)?detail \{.*?^\}", "", header.read_text(encoding="utf-8"), flags=re.M | re.S)
        for concept in re.findall(r"^concept (\w+)\b", public, re.M):
            expect(f"conceptincognita_1_1{concept}.html", concept)
    for script in ("MathJax.js", "jax/input/TeX/jax.js", "jax/output/SVG/jax.js"):
        if not (site / "mathjax" / script).exists():
            problems.append(f"mathjax/{script} is missing")
    for path, text in pages.items():
        if r"\f$" in text or r"\f[" in text:
            problems.append(f"{path.name} has an equation that was not set")
        for target in set(re.findall(r'(?:href|src)="([^"#?]+)', text)):
            target = unquote(html.unescape(target))
            if not re.match(r"[a-z]+:", target) and not (site / target).exists():
                problems.append(f"{path.name} has a link to {target}, which is not there")
    for problem in sorted(set(problems)):
        print(problem)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
