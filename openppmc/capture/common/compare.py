"""Comparison of a capture with the golden model.

The inputs of the capture drive the model, and each output edge is compared.

Three effects shift the edges slightly: the sampling, the phase of the base clock of the original chip, and
its processing times. Two edges are treated as the same edge if their distance is at most `tolerance`. The
crystals of chip and analyser differ by some ppm. This difference is measured in the moves and compensated.
"""

from __future__ import annotations

from array import array
from bisect import bisect_left
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from heapq import merge
from itertools import accumulate, dropwhile, groupby
from operator import itemgetter
from typing import TYPE_CHECKING, Any, overload

from ...check.replay import new_model
from .decoding import Decoded
from .errors import CaptureError
from .part_decoder import PartDecoder, PulseTrain
from .pulses import moves, unchopped
from .signals import BLOCK, SECOND, US, Bits, Channel, joined, level_at, level_code, level_type, merged, numpy

if TYPE_CHECKING:
    from .signals import Column

SETTLED = 100 * US
"""Longest time from the end of an initialisation to the first phase pattern, in ps."""
LEAD_S = 0.2
"""Time in s for which the model runs before the capture begins."""
MOST_PPM = 1000
MOST_EDGES = 10_000
"""Largest number of edges that the model stores as objects."""
STEP = 1_000_000
"""Largest number of cycles for which one call runs the model."""
CLK_HZ = 16_000_000
WINDOW = 256
"""Largest number of edges of the chip, and of the model, that are matched one by one after a difference."""


@dataclass(frozen=True)
class Difference:
    """Edge of one side (chip or model) that has no edge of the other side within the tolerance.

    Attributes:
        t: time in ps from the beginning of the capture.
        steady: False if the difference is an edge; True if it is a stable level that differs from the level
            of the model.
    """

    pin: str
    t: int
    level: int
    chip: bool
    steady: bool = False

    def text(self) -> str:
        """Return the difference in one line."""
        if self.steady:
            return f"{self.t / SECOND:.6f} s: {self.pin} is {self.level}: the model has {1 - self.level}"
        who = (
            "the chip has this edge, the model has not"
            if self.chip
            else "the model has this edge, the chip has not"
        )
        return f"{self.t / SECOND:.6f} s: {self.pin} → {self.level}: {who}"


class Differences(Sequence[Difference]):
    """Differences, stored in columns. They are in order of time after `sort`."""

    def __init__(self) -> None:
        self._times, self._forms = array("q"), array("q")
        self._pins: list[str] = []

    def add(self, one: Difference) -> None:
        """Append a difference; it may be earlier than those already stored."""
        if self._pins[-1:] != [one.pin]:
            self._pins.append(one.pin)
        self._times.append(one.t)
        self._forms.append(len(self._pins) - 1 << 3 | one.level << 2 | one.chip << 1 | one.steady)

    def sort(self) -> None:
        """Sort by time."""
        np = numpy()
        times, forms = np.frombuffer(self._times, np.int64), np.frombuffer(self._forms, np.int64)
        order = np.argsort(times, kind="stable")
        times[:], forms[:] = times[order], forms[order]

    def __len__(self) -> int:
        return len(self._times)

    @overload
    def __getitem__(self, place: int) -> Difference: ...

    @overload
    def __getitem__(self, place: slice) -> Sequence[Difference]: ...

    def __getitem__(self, place: int | slice) -> Difference | Sequence[Difference]:
        if isinstance(place, slice):
            return [self[n] for n in range(*place.indices(len(self)))]
        t, form = self._times[place], self._forms[place]
        return Difference(self._pins[form >> 3], t, form >> 2 & 1, bool(form & 2), bool(form & 1))


@dataclass
class Result:
    """Result of a comparison.

    Attributes:
        compared: number of matched pairs of edges.
        worst: largest distance between the two edges of a pair in ps; it occurred on the pin `worst_pin`.
        begin: time in ps from which edges are compared.
        ppm: difference of the chip's crystal from its nominal frequency, measured with the analyser's clock;
            positive if the crystal is faster.
        skipped: outputs that could not be compared, with the reason.
        pins: outputs that were compared.
        total: sum of the distances between the edges of all pairs in ps.
    """

    compared: int = 0
    differences: Differences = field(default_factory=Differences)
    worst: int = 0
    worst_pin: str = ""
    begin: int = 0
    ppm: float = 0.0
    skipped: dict[str, str] = field(default_factory=dict)
    pins: list[str] = field(default_factory=list)
    total: int = 0

    @property
    def mean(self) -> float:
        """Mean distance between the two edges of a pair in ps."""
        return self.total / max(1, self.compared)

    def add_pairs(self, pin: str, apart: Column) -> None:
        """Add matched pairs of edges to the sums.

        Args:
            apart: distance between the two edges of each pair in ps.
        """
        self.compared += len(apart)
        self.total += int(apart.sum())
        if (worst := int(apart.max(initial=0))) > self.worst:
            self.worst, self.worst_pin = worst, pin


def compare(decoded: Decoded, tolerance: int) -> Result:
    """Compare a capture with the golden model.

    Args:
        tolerance: largest distance in ps of two edges that are treated as a pair.

    Raises:
        CaptureError: the capture contains neither a reset nor an initialisation.
    """
    begin, starts, reset = _begin(decoded)
    first = _run(decoded, begin, 1.0)
    ratio = _ratio(decoded, first, begin)
    result = _check(decoded, first, begin, starts, reset, tolerance)
    if ratio != 1.0:
        corrected = _check(decoded, _run(decoded, begin, ratio), begin, starts, reset, tolerance)
        if len(corrected.differences) <= len(result.differences):
            result = corrected
            result.ppm = (ratio - 1) * 1e6
    return result


def other_timing(decoded: Decoded, result: Result, tolerance: int) -> str:
    """Return a line that proposes the other value of the parameter TIMING, or an empty text.

    The other value is proposed if most edges differ, and if it results in at most a tenth of these
    differences.
    """
    if len(result.differences) <= result.compared:
        return ""
    other = "DATASHEET" if decoded.timing == "FAST" else "FAST"
    found = compare(replace(decoded, timing=other), tolerance)
    if len(found.differences) * 10 > len(result.differences):
        return ""
    return f"with --timing {other}: {len(found.differences)} differences"


def _begin(decoded: Decoded) -> tuple[int, dict[int, int], bool]:
    """Return when the model starts, when the comparison of each axis starts, and whether there is a reset.

    The second item contains a time for each axis; key 0 is the default. The third item is True if the capture
    contains a reset.
    """
    reset = decoded.wires.ports.get("rst_n")
    if reset is not None and len(reset):
        falls, rises = reset.times[reset.levels == 0], reset.times[reset.levels == 1]
        fall = int(falls[0]) if reset.initial and len(falls) else 0
        rise = rises[rises > fall]
        if len(rise):
            return max(0, fall), {0: int(rise[0])}, True
    first: dict[int, int] = {}
    for line in decoded.lines:
        if line.initialises:
            first.setdefault(line.axis, line.end)
    if not decoded.decoder.initialised:
        return 0, {0: 0}, False
    if not first:
        raise CaptureError(
            f"{decoded.capture}: neither a reset nor an initialisation is in it, so nothing can be compared: "
            "begin the capture before the host program starts"
        )
    axes = {axis + 1: t for axis, t in first.items()}
    return 0, {0: min(first.values()), **axes}, False


@dataclass
class _ModelEdges:
    """Outputs of the model; times in ps on the time base of the capture."""

    outputs: dict[str, Channel]


def _run(decoded: Decoded, begin: int, ratio: float) -> _ModelEdges:
    """Drive a new model with the captured inputs, and return its outputs.

    Args:
        ratio: ratio of the model's time to the capture's time.
    """
    decoder, wires = decoded.decoder, decoded.wires
    straps = decoder.straps(wires)
    clk_hz = _clk_hz(decoded)
    params = {**decoder.parameters(wires), **wires.params}
    params.pop("ADR", None)
    params |= {"CLK_HZ": clk_hz, "TIMING": decoded.timing}
    try:
        model = new_model(decoded.part, params | ({"STRAPS": straps} if straps else {}))
    except (TypeError, ValueError) as error:
        raise CaptureError(f"{decoded.capture}: the model rejects these parameters: {error}") from None
    lead = round(LEAD_S * clk_hz)
    scale = clk_hz * ratio / SECOND

    def edge(t: int) -> int:
        return lead + round((t - begin) * scale)

    inputs = _inputs(decoded)
    first = {port: 1 if port == "rst_n" else level_at(one, begin) for port, one in inputs.items()}
    model.pins(1, **first)
    decoder.prelude(model, wires)
    if "rst_n" in inputs and not level_at(inputs["rst_n"], begin):
        model.pins(lead, rst_n=0)
    seen = _Outputs(model, decoder, lead, lambda t: begin + round((t - lead) / scale))
    events = merge(_events(inputs), decoder.stimulus(wires), key=itemgetter(0))
    after = dropwhile(lambda event: event[0] <= begin, events)
    for t, group in groupby(after, key=lambda event: edge(event[0])):
        seen.run(t - 1)
        model.pins(t, **{pin: level for _, levels in group for pin, level in levels.items()})
    seen.run(edge(wires.end))
    return _ModelEdges(seen.channels())


def _events(inputs: Mapping[str, Channel]) -> Iterator[tuple[int, dict[str, int]]]:
    """Yield changes of all inputs in order."""
    times, owners, names = merged(inputs.items())
    levels = [iter(one) for one in inputs.values()]
    for at in range(0, len(times), BLOCK):
        for owner in owners[at : at + BLOCK].tolist():
            t, level = next(levels[owner])
            yield t, {names[owner]: level}


class _Outputs:
    """Outputs of a model in columns. `take` moves edges from the list of the model to these columns."""

    def __init__(self, model: Any, decoder: PartDecoder, lead: int, stamp: Callable[[int], int]) -> None:
        self.model, self.decoder, self.lead, self.stamp = model, decoder, lead, stamp
        self.initial = dict(model.log.initial)
        self.times = {name: array("q") for name in decoder.outputs}
        self.levels = {name: array(level_code(decoder.pins.widths[name])) for name in decoder.outputs}

    def run(self, until: int) -> None:
        """Run the model, and fetch its edges before there are too many."""
        while self.model.now < until:
            self.model.run_until(min(until, self.model.now + STEP))
            if len(self.model.log.edges) > MOST_EDGES:
                self.take()

    def take(self, rest: int = 1000) -> None:
        """Fetch the edges of the model.

        The newest edges are not fetched, because the model may still change them.
        """
        log = self.model.log
        ready = log.edges[: max(0, len(log.edges) - rest)]
        for one in ready:
            log.initial[one.signal] = one.value
            if one.signal not in self.times:
                continue
            if one.t < self.lead:
                self.initial[one.signal] = one.value
            else:
                self.times[one.signal].append(self.stamp(one.t))
                self.levels[one.signal].append(one.value)
        del log.edges[: len(ready)]

    def channels(self) -> dict[str, Channel]:
        """Return the columns of all outputs."""
        np = numpy()
        self.take(0)
        return {
            name: Channel.of(
                self.initial[name],
                np.frombuffer(self.times[name], np.int64),
                np.frombuffer(self.levels[name], level_type(self.decoder.pins.widths[name])),
                self.decoder.pins.widths[name],
            )
            for name in self.decoder.outputs
        }


def _clk_hz(decoded: Decoded) -> int:
    """Return the clock frequency of the model.

    It is the frequency in the map; without it, the frequency of the captured `clk`; without that pin, a high
    default. With a captured `clk`, captures of this project's cores match exactly.
    """
    if "CLK_HZ" in decoded.wires.params:
        return int(str(decoded.wires.params["CLK_HZ"]))
    clk = decoded.wires.bits.get("clk", {}).get(0)
    if clk is not None:
        rises = clk.times[clk.levels == 1]
        if len(rises) > 100:
            hz = round((len(rises) - 1) * SECOND / int(rises[-1] - rises[0]))
            near = round(hz, -4)
            return near if abs(near - hz) <= hz // 50_000 else hz
    return CLK_HZ


def _inputs(decoded: Decoded) -> dict[str, Channel]:
    """Return the captured inputs except those that the host drives.

    Bits that were not captured are inactive.
    """
    found: dict[str, Channel] = {}
    decoder = decoded.decoder
    for port, places in decoded.wires.bits.items():
        if port not in decoder.inputs or port in decoder.host_pins:
            continue
        whole = decoded.wires.ports.get(port)
        if whole is None:
            idle, width = decoder.inputs[port], decoder.pins.widths[port]
            whole = joined([places.get(bit, Channel(idle >> bit & 1)) for bit in range(width)])
        found[port] = whole
    return found


def _ratio(decoded: Decoded, played: _ModelEdges, begin: int) -> float:
    """Return the ratio of the time of the model to the time of the capture.

    The ratio is measured with long moves that the capture and the model both contain. Without such moves, the
    ratio is 1.
    """
    wires = decoded.wires
    both = {**wires.bits, **{port: _bits(channel) for port, channel in played.outputs.items()}}
    theirs = decoded.decoder.trains(type(wires)(played.outputs, both, wires.end, wires.sample, wires.params))
    # The captured time of each end of a move may be wrong by one sample, so smaller differences are ignored.
    slack = 4 * max(wires.sample, SECOND // _clk_hz(decoded))
    alike = []
    for a, b in zip(_since(decoded.trains, begin), _since(theirs, begin), strict=False):
        for mine, other in zip(moves([a], decoded.pause), moves([b], decoded.pause), strict=False):
            if mine.pulses == other.pulses and mine.pulses > 20:
                alike.append((mine.end - mine.begin, other.end - other.begin))
    return clock_ratio(alike, slack)


def clock_ratio(alike: list[tuple[int, int]], slack: int) -> float:
    """Return the ratio of the time of the model to the time of the capture.

    The ratio is computed from the moves that the capture and the model both contain. If that is impossible,
    the ratio is 1.

    Args:
        alike: for each common move, its length in the capture and its length in the model, both in ps.
        slack: possible error of a length in ps.
    """
    if not alike:
        return 1.0
    # Omit moves that a switch or a stop ended early: their ratio differs from that of the other moves.
    middle = _middle([(other / mine, mine) for mine, other in alike])
    alike = [(mine, other) for mine, other in alike if abs(other - middle * mine) <= 2 * slack]
    chip, model = (sum(times) for times in zip(*alike, strict=True)) if alike else (0, 0)
    if not chip or abs(model / chip - 1) * 1e6 > MOST_PPM or abs(model - chip) <= slack:
        return 1.0
    return model / chip


def _middle(rows: list[tuple[float, int]]) -> float:
    """Return the median of weighted values; a row is (value, weight)."""
    ordered = sorted(rows)
    sums = list(accumulate(weight for _, weight in ordered))
    return ordered[bisect_left(sums, sums[-1] / 2)][0]


def _bits(channel: Channel) -> Mapping[int, Channel]:
    return Bits(channel)


def _since(trains: Iterable[PulseTrain], begin: int) -> list[PulseTrain]:
    found = []
    for one in trains:
        at = int(one.times.searchsorted(begin))
        found.append(
            PulseTrain(one.axis, one.times[at:], None if one.directions is None else one.directions[at:])
        )
    return found


def _check(
    decoded: Decoded, played: _ModelEdges, begin: int, starts: dict[int, int], reset: bool, tolerance: int
) -> Result:
    decoder, wires = decoded.decoder, decoded.wires
    result = Result(begin=starts[0])
    for port in decoder.outputs:
        places = wires.bits.get(port)
        if places is None:
            continue
        if port in decoder.phases and not reset and not _same_place(port, places, played, starts, decoder):
            result.skipped[port] = (
                "the capture begins in the middle, with the phases in another place than the model"
            )
            continue
        theirs = _bits(played.outputs[port])
        if port in decoder.phases:
            window = min(US, tolerance // 2)
            places, theirs = (unchopped(one, decoder.pins.widths[port], window) for one in (places, theirs))
        for bit, channel in sorted(places.items()):
            name = f"{port}[{bit + decoder.pins.low(port)}]" if decoder.pins.widths[port] > 1 else port
            start = starts.get(decoder.axis_of(port, bit), starts[0])
            known = len(result.differences)
            match_edges(name, channel, theirs[bit], start, wires.end, tolerance, reset, result)
            if len(result.differences) == known:
                axis = decoder.axis_of(port, bit)
                begins = [one.begin for one in decoded.moves if axis in (0, one.axis) and one.begin > start]
                points = [*([start + 2 * tolerance] if reset else []), *begins]
                _constant(name, channel, theirs[bit], points, tolerance, result)
            result.pins.append(name)
    if not result.pins:
        raise CaptureError(
            f"{decoded.capture}: no output of {decoder.title} is in the map: there is nothing to compare"
        )
    if not result.compared and not result.differences:
        raise CaptureError(
            f"{decoded.capture}: no output changes in it, neither the chip's nor the model's: capture a move"
        )
    result.differences.sort()
    return result


def _same_place(
    port: str,
    places: Mapping[int, Channel],
    played: _ModelEdges,
    starts: dict[int, int],
    decoder: PartDecoder,
) -> bool:
    """Return True if chip and model output the same phases at the beginning of the comparison."""
    start = starts.get(decoder.axis_of(port, 0), starts[0]) + SETTLED
    return all(
        level_at(channel, start) == level_at(played.outputs[port].bit(bit), start)
        for bit, channel in places.items()
    )


def match_edges(
    name: str,
    chip: Channel,
    model: Channel,
    start: int,
    end: int,
    tolerance: int,
    known: bool,
    result: Result,
) -> None:
    """Match the edges of chip and model, and add pairs and edges without a partner to `result`.

    Args:
        known: True if the levels at `start` must be equal. Otherwise, if they differ, edges are compared from
            the first time at which the levels are equal.
    """
    np = numpy()
    mine, levels = chip.since(start)
    other, theirs = model.since(start)
    if not known and level_at(chip, start) != level_at(model, start):
        # Chip and model have equal levels after the earlier of their two first edges, so that edge is
        # skipped.
        if int(mine[0] if len(mine) else end + 1) < int(other[0] if len(other) else end + 1):
            mine, levels = mine[1:], levels[1:]
        else:
            other, theirs = other[1:], theirs[1:]
    while len(mine) or len(other):
        # Most edges have the same index as their partner, so compare whole columns first.
        least = min(len(mine), len(other), BLOCK)
        apart = np.abs(mine[:least] - other[:least])
        same = (apart <= tolerance) & (levels[:least] == theirs[:least])
        head = least if same.all() else int(np.argmin(same))
        result.add_pairs(name, apart[:head])
        mine, levels, other, theirs = mine[head:], levels[head:], other[head:], theirs[head:]
        if head < BLOCK:
            part = (mine[:WINDOW].tolist(), levels[:WINDOW].tolist())
            parts = (*part, other[:WINDOW].tolist(), theirs[:WINDOW].tolist())
            more = (len(mine) > WINDOW, len(other) > WINDOW)
            i, j = _differs(name, parts, more, end, tolerance, result)
            mine, levels, other, theirs = mine[i:], levels[i:], other[j:], theirs[j:]


def _differs(
    name: str,
    sides: tuple[list[int], list[int], list[int], list[int]],
    more: tuple[bool, bool],
    end: int,
    tolerance: int,
    result: Result,
) -> tuple[int, int]:
    """Match edges one by one; return how many edges of the chip and of the model were processed.

    Args:
        more: for chip and model, True if there are further edges after the given ones.
    """
    mine, levels, other, theirs = sides
    pairs: list[int] = []
    never = end + 2 * tolerance + 1
    i = j = 0
    while i < len(mine) or j < len(other):
        if (more[0] and i == len(mine)) or (more[1] and j == len(other)):
            break
        a, x = (mine[i], levels[i]) if i < len(mine) else (never, -1)
        b, y = (other[j], theirs[j]) if j < len(other) else (never, -1)
        if x == y and abs(a - b) <= tolerance:
            pairs.append(abs(a - b))
            i, j = i + 1, j + 1
        elif a <= b:
            if a < end - tolerance:
                result.differences.add(Difference(name, a, x, True))
            i += 1
        else:
            if b < end - tolerance:
                result.differences.add(Difference(name, b, y, False))
            j += 1
    result.add_pairs(name, numpy().array(pairs, "i8"))
    return i, j


def _constant(
    name: str, chip: Channel, model: Channel, points: Sequence[int], tolerance: int, result: Result
) -> None:
    """Add a difference at the first time of `points` at which chip and model have different stable levels."""
    np = numpy()
    at = np.array(points, np.int64)
    steady = np.ones(len(at), bool)
    for side in (chip, model):
        before = side.times.searchsorted(at - tolerance, "left")
        steady &= before == side.times.searchsorted(at + tolerance, "right")
    wrong = np.flatnonzero(steady & (chip.at_all(at) != model.at_all(at)))
    if len(wrong):
        t = points[int(wrong[0])]
        result.differences.add(Difference(name, t, level_at(chip, t), True, True))
