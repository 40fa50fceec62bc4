"""Rules of the manuals for the log of the playground: the rule of each command, its text and its address."""

from __future__ import annotations

import re
from functools import cache
from html import unescape

from cocotb_tests.harness.paths import ROOT
from openppmc.model.motion.codes import Command, Kind

ROW = re.compile(r"^\| ([A-Z0-9]+(?:-[A-Z0-9]+)+) \| (.+) \|$", re.M)
FOLDERS = {"P104": "ppmc104", "P2104": "ppmc2104", "STMC": "stmc", "P312": "ppmc312", "P006": "pmc006"}
FOLDERS["BANK"] = "bank"
SINGLE = {
    Kind.INITIALISE: "INI-02", Kind.STOP: "STP-01", Kind.SLOW_STOP: "STP-03", Kind.SWITCHING: "AUX-03",
    Kind.AUX_OUTPUT: "AUX-02", Kind.AUX_INPUT: "RD-08", Kind.AUX_ON: "AUX-01", Kind.AUX_OFF: "AUX-01",
    Kind.EXCITATION_OFF: "AUX-04", Kind.UNDEFINED: "CMD-01",
    0x80: "RD-03", 0x81: "RD-05", 0x82: "RD-06", 0x83: "RD-07", 0x85: "RD-08",
    2: "OPR-06", 3: "OPR-07", 4: "OPR-08", 5: "OPR-09", 6: "OPR-10", 7: "OPR-11",
}  # fmt: skip
DOUBLE = {
    Kind.INITIALISE: "INI-03", Kind.STOP: "STP-01", Kind.SLOW_STOP: "STP-02", Kind.SWITCHING: "AUX-04",
    Kind.HOLD_DELAY: "AUX-05", Kind.AUX_OUTPUT: "AUX-02", Kind.AUX_INPUT: "AUX-03",
    Kind.EXCITATION_OFF: "AUX-01", Kind.UNDEFINED: "CMD-01",
    0x80: "RD-01", 0x81: "RD-04", 0x82: "RD-05", 0x83: "RD-06", 0x86: "RD-07",
    2: "OPR-04", 3: "OPR-05", 4: "OPR-06", 5: "OPR-06", 6: "OPR-05", 7: "LIM-07",
}  # fmt: skip
STMC = {
    Kind.INITIALISE: "INI-04", Kind.STOP: "STP-01", Kind.SLOW_STOP: "STP-03", Kind.UNDEFINED: "INI-05",
    0x80: "FIN-01", 0x81: "INP-01", 0x82: "OUT-01", 0x83: "REM-01",
    2: "SGL-01", 3: "MOV-02", 4: "MOV-01", 5: "MOV-01", 6: "MOV-02", 7: "RUN-03",
}  # fmt: skip
"""IDs of rules without a prefix, by kind of command, PPMC-104 code of a read, or operation."""
TABLES = {"ppmc104": ("P104", SINGLE), "ppmc2104": ("P2104", DOUBLE), "stmc": ("STMC", STMC)}
TABLES["bank"] = TABLES["ppmc104"]
STATUS = {"ppmc104": "P104-STA-01", "ppmc2104": "P2104-STA-01", "stmc": "STMC-ST-02"}
STATUS |= {"ppmc312": "P312-PAR-01", "pmc006": "P006-CMD-31", "bank": "P104-STA-01"}
STATUS["ppmc312-serial"] = "P312-SER-30"


def plain(text: str) -> str:
    """Return the text of a rule without the marks of Markdown."""
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", text)
    return unescape(re.sub(r"[`*]|<[^>]+>", "", text)).replace("\\", "")


@cache
def texts(part: str) -> dict[str, str]:
    """Return the rules in the manual of a part: text by ID."""
    return dict(ROW.findall((ROOT / "docs" / part / "README.md").read_text(encoding="utf-8")))


def rule_of(part: str, command: Command, meaning: int) -> str:
    """Return the ID of a command's rule; for a read, `meaning` is its code on the PPMC-104."""
    prefix, table = TABLES[part]
    kind = {Kind.OPERATION: command.operation, Kind.READ: meaning}.get(command.kind, command.kind)
    return f"{prefix}-{table[kind]}"


def letters() -> dict[str, str]:
    """Return the rule of each instruction of the PMC006B4."""
    found: dict[str, str] = {}
    for name, text in texts("pmc006").items():
        if name.startswith("P006-CMD") and text[1] == " ":  # as in "A sets the program pointer"
            found.setdefault(text[0], name)
    return found


def address(name: str) -> str:
    """Return the address of a rule's row, relative to the site's root; the hooks of MkDocs set the anchor."""
    return f"docs/{FOLDERS[name.split('-')[0]]}/index.html#{name.lower()}"


def used(names: set[str]) -> dict[str, dict[str, str]]:
    """Return the text and the address of each rule by its ID; KeyError if a manual does not have a rule."""
    return {
        name: {"text": plain(texts(FOLDERS[name.split("-")[0]])[name]), "page": address(name)}
        for name in sorted(names)
    }
