"""The examples of docs/host.md produce the output that the page shows."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from openppmc.cli import main
from openppmc.host import errors

PAGE = Path(__file__).parents[3] / "docs" / "host.md"
TEXT = PAGE.read_text(encoding="utf-8")
PORT = "model:speed=max"
LINE_PORTS = {"ppmc312-serial": "model:speed=max,stations=3", "pmc006": "model:speed=max,address=1..2"}
"""Device on a serial line -> port of its sessions."""


def blocks(kind: str) -> list[str]:
    """Return the fenced blocks of a kind."""
    return re.findall(rf"^```{kind}\n(.*?)^```$", TEXT, re.MULTILINE | re.DOTALL)


def dialogues() -> list[tuple[str, str]]:
    """Return the command and the expected output of every console block."""
    pairs = []
    for block in blocks("console"):
        for part in re.split(r"^\$ ", block, flags=re.MULTILINE)[1:]:
            command, _, output = part.partition("\n")
            if command.startswith("openppmc "):
                pairs.append((command.removeprefix("openppmc "), output))
    return pairs


@pytest.mark.parametrize(("command", "expected"), dialogues(), ids=[command for command, _ in dialogues()])
def test_transcripts(
    command: str,
    expected: str,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
) -> None:
    part = command.removeprefix("--part ").partition(" ")[0]
    monkeypatch.setenv("OPENPPMC_PORT", LINE_PORTS.get(part, PORT))
    monkeypatch.setenv("OPENPPMC_STATE", str(tmp_path))
    monkeypatch.setenv("COLUMNS", "120")
    monkeypatch.chdir(tmp_path)
    for name, text in re.findall(r"^```text (\S+)\n(.*?)^```$", TEXT, re.MULTILINE | re.DOTALL):
        Path(name).write_text(text)
    main(command.split())
    captured = capsys.readouterr()
    printed = "".join(line.rstrip() + "\n" for line in (captured.out + captured.err).splitlines())
    assert printed == expected


def test_library_example(capsys: pytest.CaptureFixture[str]) -> None:
    (example,) = blocks("python")
    exec(compile(example.replace("/dev/ttyUSB0", PORT), "example", "exec"), {})
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].startswith("high speed 7812.5 pps")
    assert "stop command" in lines[2]
    assert lines[3].startswith("slow-down limit ended the motion at position 38401 ")


def test_every_error_is_in_the_table() -> None:
    public = {
        name
        for name, kind in vars(errors).items()
        if isinstance(kind, type) and issubclass(kind, errors.PpmcError)
    }
    abstract = {"PpmcError", "LinkError", "CommandRefused", "MotionError", "ProtocolError"}
    assert {name for name in public - abstract if f"`{name}`" not in TEXT} == set()
