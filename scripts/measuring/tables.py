"""Tables and sections of pages, docs/lab/accuracy.md unless another is named."""
import re

from measuring.lab import ROOT

PAGE = ROOT / "docs" / "lab" / "accuracy.md"


def table(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    return lines + ["| " + " | ".join(map(str, row)) + " |" for row in rows]


def mean(values):
    values = [v for v in values if v is not None and v == v]
    return sum(values) / len(values) if values else float("nan")


def number(value, digits=1):
    return "" if value is None or value != value else f"{value:.{digits}f}"


def write_section(name, lines, path=PAGE):
    """Puts a section between its two marks of the page; what is written by hand around them stays."""
    begin, end = f"<!-- {name} -->\n", f"<!-- end of {name} -->"
    page = path.read_text()
    if begin not in page or end not in page:
        raise RuntimeError(f"{path}: no place for the section {name}; it is between '{begin.strip()}' and '{end}'")
    text = begin + "\n".join(lines) + "\n" + end
    page = re.sub(re.escape(begin) + ".*?" + re.escape(end), lambda _: text, page, flags=re.DOTALL)
    path.write_text(page)
