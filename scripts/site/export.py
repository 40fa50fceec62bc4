"""Write the data of each part as scripts that a page can load from a file: pins, texts, sessions, module."""

from __future__ import annotations

import base64
import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from cocotb_tests.harness.part import BusStyle
from cocotb_tests.harness.project import ProjectError
from openppmc.capture.common.mnemonics import CommandDecoder
from openppmc.parts import PARTS
from openppmc.sim.common.build import SimError
from scripts.fpga.flow.board_table import BY_PART
from scripts.site import wasm
from scripts.site.progress import say
from scripts.site.sessions import sessions
from scripts.site.texts import tables
from scripts.site.webparts import BOARD_BUILDS, BUILDS, WEB_PARTS, WebPart

LENGTHS = {
    "byte": {"lead": 0, "strobe": 2, "readStrobe": 4, "gap": 2},
    "window": {"lead": 1, "strobe": 2, "readStrobe": 6, "gap": 3},
    "block": {"lead": 0, "strobe": 3, "readStrobe": 5, "gap": 3},
}
"""Numbers of cycles of the phases of an access. The players in tests/common/web use the same numbers."""
PLAYGROUND = wasm.OUT / "playground"


def ports(part: WebPart, names: Sequence[str], levels: dict[str, int]) -> list[dict[str, object]]:
    """Return the ports in the order in which the WebAssembly module numbers their words."""
    found, word = [], 0
    for name in names:
        width = part.part.width(name)
        count = (width + 31) // 32
        found.append({
            "name": name,
            "width": width,
            "idle": [levels[name] >> 32 * n & 0xFFFFFFFF for n in range(count)],
            "lowest": part.part.lowest.get(name, 0),
            "word": word,
        })  # fmt: skip
        word += count
    return found


def style(part: WebPart) -> dict[str, Any]:
    """Return the bus style of the host, and the display settings of the page."""
    found: dict[str, Any] = {"hint": part.hint, "bits": list(part.bits), "phaseOn": part.phase_on}
    found |= {"settle": part.settle, "first": part.first}
    if part.part.styles:
        bus: BusStyle = part.part.style({**part.part.inputs, **part.idle})
        found |= {
            "address": bus.address,
            "writeOn": dict(bus.write_on),
            "writeOff": dict(bus.write_off),
            "readOn": dict(bus.read_on),
            "readOff": dict(bus.read_off),
            "busy": part.busy,
            **LENGTHS[part.bus],
        }
    else:
        found["bit"] = part.bit or part.config.clk_hz / int(str(part.params["BAUD"]))
    return found


def build(name: str) -> dict[str, Any]:
    """Return the data of a build, which differ between the builds of a part (Build in site/src/types.ts)."""
    part = BUILDS[name]
    pins, row = part.part, PARTS[part.name]
    width = sum(map(pins.width, ("rst_n", *pins.inputs, *pins.watched)))
    return {
        "clkHz": part.config.clk_hz,
        "params": part.params,
        "recorder": list(row.load("selftest").layout(width)) if row.number else [],
        "inputs": ports(part, list(pins.inputs), {**pins.inputs, **part.idle}),
        "outputs": ports(part, list(pins.watched), pins.reset_levels(part.params)),
        "wasm": f"wasm/{name}.wasm",
    }


def board(part: WebPart) -> dict[str, Any]:
    """Return the data for real boards with this part (BoardData in site/src/types.ts)."""
    row, own = PARTS[part.name], build(part.name)
    builds = [build(name) for name in BOARD_BUILDS[part.name]]
    return {
        "number": row.number,
        "builds": [{key: value for key, value in one.items() if value != own[key]} for one in builds],
        "boards": [
            {
                "title": f"{on.title}, {on.revisions}",
                "build": f"make bitstream BOARD={on.name}{_named(part.name)}",
                "load": f"make flash BOARD={on.name}{_named(part.name)}",
                "loader": f"openFPGALoader --board {on.loader}{_place(on.family)} {on.file('uart').name}",
            }
            for on in (BY_PART[part.name].values() if row.number else ())
        ],
    }


def _named(part: str) -> str:
    return "" if part == "ppmc104" else f" PART={part}"


def _place(family: str) -> str:
    return "" if family == "ice40" else " --write-flash"


def data(part: WebPart) -> dict[str, Any]:
    """Return the tables of a part (PartData in site/src/types.ts)."""
    row = PARTS[part.name]
    words = getattr(row.load("demo"), "words", CommandDecoder())
    switches = {pin for motor in part.motors for pin in motor.switches}
    return {
        "name": part.name,
        "title": part.title,
        "bus": part.bus,
        **build(part.name),
        "textHz": part.config.clk_hz,
        "motors": [
            {
                "switches": list(motor.switches),
                "step": motor.step.partition("[")[0] if motor.phases else motor.step,
                "edge": motor.edge,
                "dir": motor.dir,
                "phases": list(motor.windings),
            }
            for motor in part.motors
        ],
        "straps": [pin for pin in part.straps if pin not in switches],
        "words": tables(part.name, words),
        "sessions": [vars(one) for one in sessions(part.name)],
        "style": style(part),
        "board": board(part),
    }


def put(path: Path, content: bytes) -> None:
    """Write a file unless it has this content already: another process may be reading it."""
    path.parent.mkdir(parents=True, exist_ok=True)
    if not path.is_file() or path.read_bytes() != content:
        path.write_bytes(content)


def _script(path: Path, room: str, key: str, value: object) -> None:
    text = json.dumps(value, ensure_ascii=False, separators=(",", ":"))
    put(path, f"((globalThis.openppmc??={{}}).{room}??={{}})[{json.dumps(key)}]={text};\n".encode())


def export(name: str, out: Path = PLAYGROUND) -> None:
    """Write a module to the playground's folder; for a module of the page, also the tables of its part."""
    built = wasm.build(name).read_bytes()
    module = f"wasm/{name}.wasm"
    put(out / module, built)
    _script(out / f"{module}.js", "wasm", module, base64.b64encode(built).decode())
    if name in WEB_PARTS:
        _script(out / f"parts/{name}.js", "data", name, data(WEB_PARTS[name]))


def all_parts() -> None:
    """Write all parts and their list; raise ProjectError if a module cannot be built."""
    try:
        names = list(BUILDS)
        wasm.build_all(
            names, lambda name: say(f"WebAssembly of {name}, {names.index(name) + 1} of {len(names)}")
        )
        for name in names:
            export(name)
    except SimError as error:
        raise ProjectError(str(error)) from None
    known = [
        {"name": name, "title": part.title, "number": PARTS[name].number} for name, part in WEB_PARTS.items()
    ]
    text = json.dumps(known, ensure_ascii=False)
    put(PLAYGROUND / "parts.js", f"(globalThis.openppmc??={{}}).parts={text};\n".encode())
