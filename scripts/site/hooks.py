"""Hooks of MkDocs, which add a link to the playground to each session that can be run."""

from __future__ import annotations

import os
import re
from typing import Any

RUN = re.compile(r"^<!-- run: .*? -->$", re.M | re.S)
CHAPTER = re.compile(r"^## (\d+) ", re.M)
SHIM = "https://unpkg.com/iframe-worker/shim"
BASE = (
    '<script>document.write(\'<base href="\'+(location.protocol==="file:"?".":"/")+\'">\')</script>'
    '<noscript><base href="/"></noscript>'
)
CONFIG = (
    '<script>if(location.protocol==="file:"){const c=document.getElementById("__config");'
    'c.textContent=c.textContent.replace(\'"base": "/"\',\'"base": "."\')'
    ".replaceAll('\": \"/','\": \"')}</script>"
)
RULE = re.compile(r"<td>([A-Z0-9]+(?:-[A-Z0-9]+){2,})</td>")
SEARCH = (
    'data-md-component="search" role="dialog"',
    'data-md-component="search" role="dialog" aria-label="Search"',
)
"""Start tag of the search, and the same tag with the accessible name that a dialog needs."""
PAGE = re.compile(r"docs/(\w+)/(examples|README)\.md")
START = "README.md"
ADDRESSES = {"landing.md": "index.html", START: "overview.html"}
"""File of a page -> its address, if the address does not follow from the name of the file.

Without this table, MkDocs would make README.md the first page of the site (index.html).
"""
LINE, LINE_PART = "docs/ppmc312/serial.md", "ppmc312-serial"
"""Page of a part of the playground that has no manual of its own, and the name of this part."""
PARTS = ("ppmc104", "ppmc2104", "stmc", "ppmc312", "pmc006", "bank")


def data_sheet(part: str) -> str:
    """Return the path of the PDF of a part's manual, relative to the site's root."""
    return f"pdf/{part}.pdf"


def button(source: str, part: str, run: str, words: str) -> str:
    """Return a link from a page to a session of a part; the session starts immediately."""
    up = os.path.relpath("playground.html", os.path.dirname(source))
    go = f"&run={run}&go=1" if run else ""
    return f'<a class="md-button run-this" href="{up}#v=1&part={part}{go}">{words}</a>'


def run_links(source: str, markdown: str) -> str:
    """Return a page with links in place of session comments, and after the titles of manuals and overview."""
    if source == START:
        title, _, rest = markdown.partition("\n")
        return f"{title}\n\n{button(source, PARTS[0], '2', 'Try it in the browser')}\n{rest}"
    if source == LINE:
        title, _, rest = markdown.partition("\n")
        return f"{title}\n\n{button(source, LINE_PART, '2', 'Run it in the playground')}\n{rest}"
    found = PAGE.fullmatch(source)
    if not found or found[1] not in PARTS:
        return markdown
    part = found[1]
    if found[2] == "README":
        title, _, rest = markdown.partition("\n")
        links = button(source, part, "", "Run it in the playground")
        links += f'\n<a class="md-button run-this" href="../../{data_sheet(part)}">PDF</a>'
        return f"{title}\n\n{links}\n{rest}"

    def linked(match: re.Match[str]) -> str:
        chapter = CHAPTER.findall(markdown[: match.start()])[-1]
        return button(source, part, chapter, "▶ Run this")

    return RUN.sub(linked, markdown)


def on_post_page(output: str, page: Any, **_: Any) -> str:
    """Load the shim of the search from this site instead of another host. MkDocs calls this for each page.

    The row of each rule gets an anchor for links from the log of the playground. The body of the playground
    has a class from the first paint on, so that nothing moves while the page loads.
    """
    if page.file.src_uri == "playground.md":
        output = output.replace("<body ", '<body class="playground-page" ', 1)
    output = RULE.sub(lambda cell: f'<td id="{cell[1].lower()}">{cell[1]}</td>', output).replace(*SEARCH)
    return output.replace(SHIM, os.path.relpath("iframe-worker.js", os.path.dirname(page.file.src_uri)))


def on_post_template(output_content: str, template_name: str, **_: Any) -> str:
    """Make 404.html work for an address at any depth and from a file; called by MkDocs for each template.

    The links in 404.html are relative to a base, which is the root of the host or the folder of the file.
    """
    if template_name != "404.html":
        return output_content
    local = output_content.replace(SHIM, "iframe-worker.js").replace(*SEARCH)
    local = re.sub(r'\b(href|src)="/(?!/)', r'\1="', local).replace('href=""', 'href="index.html"')
    local = local.replace("<title>", "<title>Not found - ", 1)
    local = local.replace(
        '<script src="assets/javascripts/bundle', CONFIG + '<script src="assets/javascripts/bundle', 1
    )
    return local.replace("<head>", f"<head>{BASE}", 1)


def on_files(files: Any, **_: Any) -> Any:
    """Move the landing page to the root of the site; called by MkDocs. Links to README.md do not change."""
    for source, to in ADDRESSES.items():
        file = files.get_file_from_path(source)
        file.name, file.dest_uri, file.url = to.removesuffix(".html"), to, to
    return files


def on_page_context(context: Any, page: Any, nav: Any, **_: Any) -> Any:
    """Put the name of the device into the title if several pages have the same title; called by MkDocs."""
    names: dict[str, int] = {}
    for other in nav.pages:
        names[str(other.title)] = names.get(str(other.title), 0) + 1
    if names.get(str(page.title), 0) > 1:
        above = [str(section.title) for section in page.ancestors[:1]]
        page.meta.setdefault("title", " - ".join([*above, str(page.title)]))
    return context


def on_page_markdown(markdown: str, page: Any, **_: Any) -> str:
    """Add links and settings to a page; called by MkDocs for each page."""
    if page.file.src_uri == START:
        page.meta["hide"] = ["navigation"]  # it would contain only this page
    return run_links(page.file.src_uri, markdown)
