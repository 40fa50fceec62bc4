"""What `make demo PART=pmc006` plays on the RTL: the pins of a story that a golden model was told."""

from __future__ import annotations

import json
from typing import Any

import cocotb

from cocotb_tests.harness.bench import Bench
from cocotb_tests.harness.tape import record
from cocotb_tests.pmc006.story import Story

from .bench import PMC006


@cocotb.test()
async def demo_program(dut: Any) -> None:
    """Given a part just powered up, when the story's pins change, then all that it does is recorded."""
    bench = await Bench.start(dut, PMC006)
    with (bench.out / "progress").open("a") as progress:
        progress.write("on the golden model, with a motor\n")
        progress.flush()
        story = Story(**{name.lower(): value for name, value in PMC006.params(bench.config).items()})
        story.tell()
        progress.write("the same pins on the RTL\n")
    recording = await record(bench, story.host.tape)
    (bench.out / "story.json").write_text(json.dumps(story.chapters, indent=1))
    (bench.out / "recording.json").write_text(recording.to_json())
