"""Puts tables between the markers of a page."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]


def put(page, name, text):
    """Between `<!-- name: begin -->` and `<!-- name: end -->`."""
    marker = f"(<!-- {name}: begin -->\n).*?(<!-- {name}: end -->)"
    old = page.read_text(encoding="utf-8")
    new, count = re.subn(marker, lambda found: found[1] + text + found[2], old, flags=re.DOTALL)
    if count != 1:
        sys.exit(f"{page} has no markers for '{name}'")
    page.write_text(new, encoding="utf-8")


def put_table(page, name, heads, rows):
    lines = ["| " + " | ".join(heads) + " |", "|" + "---|" * len(heads)]
    put(page, name, "\n".join(lines + ["| " + " | ".join(map(str, row)) + " |" for row in rows]) + "\n")
