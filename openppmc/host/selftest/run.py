"""Play the sections of a self-test, compare them with the golden model, collect results."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ...check.comparison import Comparison
from ...check.pins import pins_of
from ...check.records import Recording
from ...check.replay import compare_recording, new_model
from ...check.report import report, write_report
from ...errors import MissingExtraError
from ..errors import LinkError, PpmcError
from ..link import Link
from ..script import RATES, Build, Result, Script
from .plan import MOVES, SWITCHES, PartAccess, Plan, Section
from .recording import NoReset, Recorded, recording_of, reset_levels

ECHOES, ECHO_BYTES = 8, 48
TRIES = 3
"""Number of attempts per section.

If the PC is slow because it is busy, the edges of a chopper or clock may fill the recorder.
"""
PrintLine = Callable[[str], None]


class NoRecorder(PpmcError):  # noqa: N818 - names the missing object
    """The bitstream of the board has no recorder."""


@dataclass(frozen=True)
class SectionResult:
    """Result of one section.

    Attributes:
        edges: number of edges of outputs that were compared.
        wrong: difference in one line, "" if there is none.
        report: the difference as a text of several lines.
        skipped: reason why the section has no result, "" if it has a result.
        full: True if the recorder was full, so that records are missing.
    """

    section: Section
    records: int
    clk: int
    edges: int
    pulses: int
    difference: str = ""
    report: str = ""
    skipped: str = ""
    full: bool = False


@dataclass
class SelfTestResult:
    """Results of a self-test.

    Attributes:
        rates: number of repeated requests at each line rate; `None` for a rate that the adapter does not
            support.
    """

    build: Build | None
    params: dict[str, Any] = field(default_factory=dict)
    recorder: Recorded | None = None
    rates: dict[int, int | None] = field(default_factory=dict)
    outcomes: list[SectionResult] = field(default_factory=list)

    @property
    def edges(self) -> int:
        """Number of output edges that were compared."""
        return sum(outcome.edges for outcome in self.outcomes)

    @property
    def differences(self) -> int:
        """Number of sections with a difference."""
        return sum(bool(outcome.difference) for outcome in self.outcomes)


class SelfTest:
    """Run of a self-test.

    Args:
        folder: folder to which pictures of differences are written.
        tell: called with one line of text for each step of the self-test.
    """

    def __init__(self, link: Link, plan: Plan, folder: Path, tell: PrintLine = lambda line: None) -> None:
        self.link, self.plan, self.folder, self._print_line = link, plan, folder, tell
        self.results = SelfTestResult(link.build())
        self._params: list[dict[str, Any]] = []

    # ------------------------------------------------------------------ link

    def rates(self) -> None:
        """Test every line rate that bridge and adapter support, with long answers."""
        work = self.link.baud
        for code, baud in enumerate(RATES[: self.link.identity.best_rate + 1]):
            before = self.link.repeats
            if self.link.use_rate(baud):
                for _ in range(ECHOES):
                    self.link.execute(Script().ident().read_many(1, ECHO_BYTES))
                self.results.rates[baud] = self.link.repeats - before
            else:
                self.results.rates[RATES[code]] = None
        self.link.use_rate(work)
        good = [str(baud) for baud, repeats in self.results.rates.items() if repeats is not None]
        self._print_line(f"link: {', '.join(good)} baud")

    # ------------------------------------------------------------------ recorder

    def recorder(self) -> Recorded:
        """Return the properties of the recorder. Raises NoRecorder."""
        answer = self.link.attempt(Script().record(False).recorded())
        if answer.result is Result.ILLEGAL:
            raise NoRecorder(
                f"{self.link.name}: this bitstream has no recorder, so no edge can be compared: load one "
                "that was built with it (make bitstream BOARD=… RECORD=…, docs/boards.md)"
            )
        info = Recorded.parse(self.link.check_answer(answer).values[0])
        self.results.recorder = info
        self._layout = self.plan.layout(info.width)
        if sum(width for _, width in self._layout) != info.width:
            raise NoRecorder(
                f"{self.link.name}: the recorder sees {info.width} levels, which fits no part known here: "
                "renew bitstream or package, whichever is older"
            )
        return info

    def fetch(self) -> tuple[Recorded, list[tuple[int, int]]]:
        """Return all records."""
        info = Recorded.parse(self.link.execute(Script().record(False).rewind().recorded()).values[0])
        most = 255 // info.record_bytes * info.record_bytes
        left, data = info.count * info.record_bytes, b""
        while left:
            portion = min(left, most)
            data += self.link.execute(Script().fetch(portion)).values[0]
            left -= portion
        return info, list(info.samples(data))

    # ------------------------------------------------------------------ sections

    def sections(self, switches: bool) -> list[Section]:
        """Return the sections of the plan.

        Args:
            switches: True to include the sections that need wires for limits and origin.
        """
        info = self.recorder()
        identity, width = self.link.identity, info.width
        found = self.plan.sections(identity, width, info.most)
        return [*found, *(self.plan.switches(identity, width) if switches else ())]

    def play(self, section: Section) -> SectionResult:
        """Record a section and compare it; reset the part afterwards, so that its outputs are off.

        If the recorder was full, the section is played again, because the cause may be a busy PC.
        """
        for left in reversed(range(TRIES)):
            outcome = self._record(section)
            if not (outcome.full and left):
                break
            self._print_line(f"{section.what}: {section.title}: the recorder was full, once more")
        self.results.outcomes.append(outcome)
        what = outcome.difference or outcome.skipped or f"{outcome.edges} edges, no difference"
        self._print_line(f"{section.what}: {section.title}: {what}")
        return outcome

    def _record(self, section: Section) -> SectionResult:
        """Play a section once."""
        link = self.link
        link.forget_events()
        link.execute(Script().straps(section.straps).record(True).reset())
        try:
            section.play(PartAccess(link))
        finally:
            self.safe()
        return self._check_records(section, *self.fetch())

    def safe(self) -> None:
        """End the recording, then reset the part, which ends the pulses and switches the phases off.

        The call never raises an exception.
        """
        try:
            self.link.attempt(Script().record(False).reset().straps(0xFF))
        except LinkError:
            pass  # the board has disappeared; the first exception reports it

    def _check_records(
        self, section: Section, info: Recorded, samples: list[tuple[int, int]]
    ) -> SectionResult:
        """Compare the records of a section with the golden model."""
        records = len(samples)
        try:
            comparison = self._compare(samples)
        except (NoReset, ValueError) as error:
            return SectionResult(section, records, 0, 0, 0, f"cannot be compared ({error})")
        end = comparison.recording.end
        count, pulses = comparison.edges_compared, comparison.pulses
        if comparison.mismatch is not None:
            return SectionResult(section, records, end, count, pulses, *self._difference(section, comparison))
        # First check the wire: without it, a motion does not end, and its records may fill the recorder.
        if section.what == SWITCHES and not self._has_switched(comparison.recording):
            skipped = "no switch has moved: is the wire there?"
            return SectionResult(section, records, end, count, pulses, skipped=skipped)
        if info.full:
            full = f"the recorder was full after {records} records: build the bitstream with a larger RECORD"
            return SectionResult(section, records, end, count, pulses, full, full=True)
        skipped = ""
        if section.what == MOVES and not any(e.signal in MOTOR_PINS for e in comparison.recording.edges):
            skipped = "nothing has moved: is a limit or the alarm active?"
        return SectionResult(section, records, end, count, pulses, skipped=skipped)

    def _compare(self, samples: list[tuple[int, int]]) -> Comparison:
        """Compare the records with a model for each set of parameters. Keep the first set that matches."""
        if not self._params:
            reset = reset_levels(samples, self._layout)
            width = sum(bits for _, bits in self._layout)
            self._params = self.plan.params(self.link.identity, width, reset)
        found = None
        for params in self._params:
            model = new_model(self.plan.part, params)
            pins = pins_of(model)
            recording = recording_of(
                samples,
                self._layout,
                self.plan.part,
                params,
                {**pins.inputs, "rst_n": 1},
                pins.outputs,
            )
            watched = {name for name, _ in self._layout}
            initial = {name: level for name, level in pins.outputs.items() if name in watched}
            comparison = compare_recording(recording, initial, "board", pins=pins)
            found = found or comparison
            if comparison.mismatch is None:
                self._params, found = [params], comparison
                break
        assert found is not None
        self.results.params = dict(found.recording.params)
        return found

    def _difference(self, section: Section, comparison: Comparison) -> tuple[str, str]:
        """Return the difference in one line and as a report.

        A picture and the waveforms are written to the folder.
        """
        assert comparison.mismatch is not None
        folder = self.folder / section.folder
        text = report(comparison)
        shown = "compare.png"
        try:
            write_report(comparison, folder)
        except OSError as error:
            self._print_line(f"{folder}: cannot be written ({error.strerror})")
        except MissingExtraError as missing:
            self._print_line(str(missing))
            shown = "compare.txt"
        return f"{text.splitlines()[0].partition(': ')[2]} ({folder}/{shown})", text

    def _has_switched(self, recording: Recording) -> bool:
        """Return True if a switch has changed its level after the reset."""
        return any(change.pin in SWITCH_PINS and change.t for change in recording.stimulus)


SWITCH_PINS = frozenset("l1_n l2_n l3_n l4_n cnp_n alm_n mon fl_n bl_n fhl_n bhl_n org_n".split())
"""Names of the limit, origin and alarm inputs of all parts."""
MOTOR_PINS = frozenset({"pout_n", "pout", "s", "s1_n", "s2_n"})
