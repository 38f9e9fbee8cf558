"""What every page must keep: balanced tags, ids that lead somewhere, nothing from outside."""

from __future__ import annotations

import re
from html.parser import HTMLParser

VOID = {"meta", "link", "img", "br", "hr", "input", "col"}
#: Elements of SVG that are written with a slash.
CLOSED = {"path", "use", "circle"}


class Reader(HTMLParser):
    """Collects faults, ids, links and counts while it reads."""

    def __init__(self) -> None:
        super().__init__(convert_charrefs=True)
        self.open: list[str] = []
        self.faults: list[str] = []
        self.ids: list[str] = []
        self.links: list[str] = []
        self.sources: list[str] = []
        self.counts: dict[str, int] = {}

    def handle_starttag(self, tag, attrs):
        given = dict(attrs)
        self.counts[tag] = self.counts.get(tag, 0) + 1
        if len(given) != len(attrs):
            self.faults.append(f"attribute twice in {tag} at {self.getpos()}")
        if "id" in given:
            self.ids.append(given["id"])
        if "href" in given:
            self.links.append(given["href"])
        self.sources += [given[name] for name in ("src", "srcset", "data", "action", "poster") if given.get(name)]
        if tag == "img" and not given.get("alt"):
            self.faults.append("img without alt")
        if tag not in VOID | CLOSED:
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs):
        if tag not in CLOSED:
            self.faults.append(f"{tag} closes itself at {self.getpos()}")

    def handle_endtag(self, tag):
        if not self.open or self.open[-1] != tag:
            self.faults.append(f"</{tag}> at {self.getpos()} closes {self.open[-1:]}")
        else:
            self.open.pop()


def faults_of(text: str) -> list[str]:
    """Every fault of a page, in words."""
    reader = Reader()
    reader.feed(text)
    reader.close()
    faults = reader.faults + [f"<{tag}> is never closed" for tag in reader.open]
    faults += [f"id {i} twice" for i in {i for i in reader.ids if reader.ids.count(i) > 1}]
    for link in reader.links:
        if link.startswith("#") and link[1:] not in reader.ids:
            faults.append(f"{link} leads nowhere")
        elif not link.startswith(("#", "data:")):
            faults.append(f"link to {link}")
    faults += [f"source {s[:60]}" for s in reader.sources if not s.startswith("data:")]
    for figure in re.findall(r"<figure.*?</figure>", text, re.S):
        if not re.search(r"<figcaption>\s*[^\s<]", figure):
            faults.append(f"figure without a sentence: {figure[:80]}")
    for table in re.findall(r"<table.*?</table>", text, re.S):
        if not re.search(r"<caption>\s*[^\s<]", table):
            faults.append(f"table without a caption: {table[:80]}")
    # Addresses may stand in the comments of a licence; nothing may ask for one.
    code = re.sub(r"/\*.*?\*/", "", text, flags=re.S)
    faults += [f"address {a}" for a in re.findall(r"(?:https?:)?//[a-z0-9-]+\.[a-z][^\s\"'<>)]*", code)]
    faults += [f"style asks for {a}" for a in re.findall(r"@import|url\((?!['\"]?data:)", code)]
    return faults
