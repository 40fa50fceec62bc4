"""Captures in VCD, written by sigrok, PulseView, GTKWave or our own simulations.

Files of this project state the core in a comment, so that the golden model has the same clock and parameters:

    $comment openppmc {"part": "pmc006", "parameters": {"CLK_HZ": 8000000, "TIMING": "FAST"}} $end

The value changes are read in pieces of bounded size, all tokens of a piece together.
"""

from __future__ import annotations

import json
import re
from array import array
from collections.abc import Iterator, Mapping
from fractions import Fraction
from pathlib import Path
from typing import Any

from ...errors import needs
from ...textfile import NotTextError, chunks
from .errors import CaptureError
from .signals import SECOND, Capture, Channel, level_code, level_type

_UNITS = {"s": SECOND, "ms": 10**9, "us": 10**6, "µs": 10**6, "ns": 10**3, "ps": 1}
_UNITS_OF: dict[str, Fraction] = {name: Fraction(ps) for name, ps in _UNITS.items()} | {
    "fs": Fraction(1, 1000),
    "as": Fraction(1, 10**6),
}
_MARK = "openppmc "
_END = re.compile(rb"\$enddefinitions\s+\$end\s")
_SECTION = re.compile(rb"(?:^|(?<=\s))\$(?:comment|date|version|vcdclose)\s.*?\$end(?=\s)", re.DOTALL)
_OPEN = re.compile(rb"(?:^|(?<=\s))\$(?:comment|date|version|vcdclose)\s")
_TEXTS = (b"$comment", b"$date", b"$version", b"$vcdclose")
_RANGE = re.compile(r"\[\s*(-?\d{1,9})\s*(?::\s*(-?\d{1,9})\s*)?\]$")
_LEFT_OUT = ": a number, not a level, left out"
_WIDEST = 64
_MOST_PS = 1 << 62


def core_comment(part: str, parameters: Mapping[str, object]) -> str:
    """Return the comment of a VCD file that states its core: part and parameters of the top module."""
    return _MARK + json.dumps({"part": part, "parameters": dict(parameters)})


def _core(comment: str, name: str) -> tuple[str, dict[str, object]]:
    """Return part and parameters from a comment of `core_comment`, else empty values. Raises CaptureError."""
    text = comment.strip()
    if not text.startswith(_MARK):
        return "", {}
    try:
        told = json.loads(text[len(_MARK) :])
        part, parameters = told["part"], told["parameters"]
        if not isinstance(part, str) or not isinstance(parameters.get("XTAL_HZ", 16_000_000), int):
            raise ValueError
        if parameters.get("TIMING", "FAST") not in ("FAST", "DATASHEET"):
            raise ValueError
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
        raise CaptureError(
            f"{name}: its comment `openppmc …` is damaged: take it out, and name part and clock in a map"
        ) from None
    return part, parameters


class _Variable:
    """Declared variable and its changes, in columns that grow while the file is read."""

    def __init__(self, width: int, indices: range) -> None:
        self.width, self.indices = width, indices
        code = level_code(width)
        self.times, self.levels, self.unknown = array("q"), array(code), array(code)

    def add(self, times: Any, levels: Any, unknown: Any) -> None:
        """Add changes.

        Args:
            unknown: `None` if all levels are known.
        """
        if unknown is not None:
            missing = len(self.levels) - len(self.unknown)
            self.unknown.frombytes(bytes(missing * self.unknown.itemsize))
            self.unknown.frombytes(unknown.tobytes())
        self.times.frombytes(times.tobytes())
        self.levels.frombytes(levels.tobytes())

    def channel(self, start: int) -> Channel:
        """Return the channel, with times from `start` on. The columns of this object are then empty."""
        import numpy as np

        full, kind = (1 << self.width) - 1, level_type(self.width)
        times = np.frombuffer(self.times, np.int64)
        levels = np.frombuffer(self.levels, kind)
        unknown = None
        if len(self.unknown):
            self.unknown.frombytes(bytes((len(levels) - len(self.unknown)) * self.unknown.itemsize))
            unknown = np.frombuffer(self.unknown, kind)
        self.times = self.levels = self.unknown = array("q")
        if start:
            times = times - start
        # The levels at the first time stamp are the levels at the beginning of the capture.
        first = int(times.searchsorted(0, "right"))
        initial, hidden = (0, full) if not first else (int(levels[first - 1]), 0)
        if first and unknown is not None:
            hidden = int(unknown[first - 1])
        if unknown is None and hidden:
            unknown = np.zeros_like(levels)
        return Channel.of(
            initial,
            times[first:],
            levels[first:],
            self.width,
            None if unknown is None else unknown[first:],
            hidden,
            range(min(self.indices), max(self.indices) + 1),
        )


class _Head:
    """Declarations of a VCD file."""

    def __init__(self, text: str, name: str) -> None:
        self.name = name
        self.part, self.parameters = "", dict[str, object]()
        self.scale = Fraction(0)
        self.notes: list[str] = []
        self.variables: dict[str, _Variable] = {}
        self.named: dict[str, str] = {}
        """Identifier code of each variable, by the names that the user may write."""
        self.doubled: set[str] = set()
        self._depths: dict[str, tuple[int, str, str]] = {}
        declared = self._sections(text)
        if not self.scale:
            self.scale = Fraction(1000)
            self.notes.append("no $timescale in it, 1 ns is assumed")
        if self.part:
            # Files of this project contain analogue curves of the speed for a viewer. Omit the notes about
            # these curves.
            self.notes = [note for note in self.notes if not note.endswith(_LEFT_OUT)]
        self._name(declared)

    def _sections(self, text: str) -> list[tuple[tuple[str, ...], str, int, list[str]]]:
        """Read the header; return its variables as (scopes, code, width, words of the name)."""
        scopes: list[str] = []
        declared = []
        tokens = [(one[0], one.start()) for one in re.finditer(r"\S+", text)]
        place = 0
        while place < len(tokens):
            word, at = tokens[place]
            line = text.count("\n", 0, at) + 1
            after = place + 1
            while after < len(tokens) and tokens[after][0] != "$end":
                after += 1
            inside = [one for one, _ in tokens[place + 1 : after]]
            if not word.startswith("$") or after == len(tokens):
                raise CaptureError(f"{self.name}: no VCD at line {line}: export it again")
            if word == "$scope":
                scopes.append(inside[-1] if inside else "")
            elif word == "$upscope":
                if scopes:
                    scopes.pop()
            elif word == "$comment" and not self.part:
                until = tokens[after][1]
                self.part, self.parameters = _core(text[at + len(word) : until], self.name)
            elif word == "$timescale":
                self._timescale("".join(inside), line)
            elif word == "$var":
                try:
                    kind, width, code, *words = inside
                    size = int(width)
                    if size < 1 or not words:
                        raise ValueError
                except ValueError:
                    what = f"`$var {' '.join(inside)[:60]}` is damaged: export it again"
                    raise CaptureError(f"{self.name}: line {line}: {what}") from None
                if kind in ("real", "realtime", "string", "parameter") or size > _WIDEST:
                    self.variables.setdefault(code, _Variable(0, range(0)))
                    self.notes += [f"{' '.join(words)}{_LEFT_OUT}"] if kind == "real" else []
                else:
                    declared.append((tuple(scopes), code, size, words))
            place = after + 1
        return declared

    def _timescale(self, text: str, line: int) -> None:
        match = re.fullmatch(r"(\d{1,20}(?:\.\d{1,20})?(?:e-?\d{1,2})?)?([munpfaµ]?s)", text)
        if match is None or not Fraction(match[1] or 1):
            raise CaptureError(
                f"{self.name}: line {line}: $timescale {text[:40]}: expected a number and s, ms, us, ns, ps "
                "or fs; correct it by hand"
            )
        self.scale = Fraction(match[1] or 1) * _UNITS_OF[match[2]]

    def _name(self, declared: list[tuple[tuple[str, ...], str, int, list[str]]]) -> None:
        ranges: dict[tuple[tuple[str, ...], str], set[str]] = {}
        rows = []
        for scopes, code, size, words in declared:
            text = " ".join(words)
            match = _RANGE.search(text)
            base = text[: match.start()].strip() if match else text
            base = base.removeprefix("\\")
            left = int(match[1]) if match else size - 1
            right = int(match[2]) if match and match[2] else (left if match else 0)
            if match and abs(left - right) + 1 != size:
                if size == 1 and match[2] is None:
                    right = left
                else:
                    raise CaptureError(
                        f"{self.name}: {text}: {size} bits, but the range has {abs(left - right) + 1}: "
                        "export it again"
                    )
            indices = range(right, left + 1) if left >= right else range(right, left - 1, -1)
            rows.append((scopes, code, size, base, indices, bool(match)))
            ranges.setdefault((scopes, base), set()).add(str(list(indices)))
        for scopes, code, size, base, indices, ranged in rows:
            name = base
            alone = len(ranges[scopes, base]) == 1
            if ranged and size == 1 and (indices[0] or not alone):
                name = f"{base}[{indices[0]}]"
            elif not alone and size > 1:
                name = f"{base}[{indices[-1]}:{indices[0]}]"
            if size > 1 and indices[0] > indices[-1]:
                self.notes.append(
                    f"{base} is declared [{indices[-1]}:{indices[0]}]: its bits are taken by these indices, "
                    "the lowest is bit 0"
                )
            known = self.variables.get(code)
            if known is None or not known.width:
                self.variables[code] = _Variable(size, indices)
            elif known.width != size:
                raise CaptureError(f"{self.name}: {base}: {size} and {known.width} bits: export it again")
            self._add(scopes, name, code)

    def _add(self, scopes: tuple[str, ...], name: str, code: str) -> None:
        """Add a variable under its name.

        If variables in several scopes have this name, the name refers to the variable in the outermost scope
        or, if several scopes are equally far out, to the first such variable. Each variable is also available
        as `scope.name`.
        """
        depth, home = len(scopes), ".".join(scopes)
        known = self._depths.get(name)
        if known is None or depth < known[0]:
            self.named[name] = code
            self._depths[name] = (depth, home, code)
            if known is None:
                return
            self.named[f"{known[1]}.{name}"] = known[2]
        elif depth == known[0] and home == known[1]:
            if code != known[2]:
                self.doubled.add(name)
        elif depth == known[0]:
            self.named[f"{known[1]}.{name}"] = known[2]
            full = f"{home}.{name}"
            if self.named.get(full, code) != code:
                self.doubled.add(full)
            self.named[full] = code


def read_vcd(path: Path) -> Capture:
    """Read all variables of a VCD.

    If variables in several scopes have the same name, the name refers to the variable in the outermost scope
    or, if several scopes are equally far out, to the first such variable. Each variable is also available as
    `scope.name`.

    Raises:
        CaptureError: the file is invalid.
    """
    needs("decode", f"{path.name}: a capture in VCD", "numpy")
    try:
        pieces = chunks(path)
        head = b""
        for piece in pieces:
            head += piece
            if (match := _END.search(head + b"\n")) is not None:
                break
        else:
            what = "cut off in its head: export it again"
            raise CaptureError(f"{path.name}: {what if b'$' in head[:4096] else 'no VCD: export it again'}")
        text = _text(head[: match.start()])
        declared = _Head(text, path.name)
        return _Body(declared, head[: match.end()].count(b"\n") + 1).read(head[match.end() :], pieces)
    except OSError as error:
        raise CaptureError(f"{path.name}: cannot be read ({error.strerror})") from None
    except NotTextError as error:
        raise CaptureError(f"{path.name}: {error}") from None


def _text(data: bytes) -> str:
    try:
        return data.decode()
    except UnicodeDecodeError:
        return data.decode("latin-1")


class _Body:
    """Value changes of a file, read in pieces."""

    def __init__(self, head: _Head, line: int) -> None:
        import numpy as np

        self.np, self.head, self.line = np, head, line
        self.codes = list(head.variables)
        raw = [self._code_bytes(code) for code in self.codes]
        if len(self.codes) > 30_000 or any(len(one) > 8 for one in raw):
            raise CaptureError(
                f"{head.name}: {len(self.codes)} variables, or very long identifier codes: export only the "
                "pins"
            )
        keys = np.array([int.from_bytes(one, "little") for one in raw], np.uint64)
        self.order = np.argsort(keys)
        self.keys = keys[self.order]
        self.widest = max((len(one) for one in raw), default=1)
        self.small = None
        if self.widest <= 2:
            self.small = np.full(65536, -1, np.int32)
            self.small[keys] = np.arange(len(keys))
        self.kinds = np.array([head.variables[code].width for code in self.codes], np.int64)
        self.now = 0
        self.start: int | None = None
        self.level = np.full(256, 255, np.uint8)
        for text, value in (("0Ll", 0), ("1Hh", 1), ("xXzZuUwW-", 2)):
            for one in text:
                self.level[ord(one)] = value

    @staticmethod
    def _code_bytes(code: str) -> bytes:
        try:
            return code.encode("latin-1")
        except UnicodeEncodeError:
            return code.encode()

    def read(self, first: bytes, pieces: Iterator[bytes]) -> Capture:
        """Read the whole file. Raises CaptureError."""
        rest = self._piece(first, False) if first else b""
        for piece in pieces:
            rest = self._piece(rest + piece, False)
        rest = self._piece(rest + b"\n", True)
        head = self.head
        if self.start is None:
            raise CaptureError(f"{head.name}: no time stamp in it: capture again")
        made = {
            code: variable.channel(self.start) for code, variable in head.variables.items() if variable.width
        }
        channels = {name: made[code] for name, code in head.named.items()}
        return Capture(
            head.name,
            channels,
            self.now - self.start,
            part=head.part,
            parameters=head.parameters,
            doubled=frozenset(head.doubled),
            notes=head.notes,
        )

    def _fail(self, data: bytes, at: int, what: str) -> CaptureError:
        line = self.line + data.count(b"\n", 0, at)
        return CaptureError(f"{self.head.name}: cut off or damaged at line {line}: {what}; export it again")

    def _piece(self, data: bytes, final: bool) -> bytes:
        """Process all complete tokens of a piece; return the incomplete last token for the next piece."""
        np = self.np
        if any(word in data for word in _TEXTS):
            data = _SECTION.sub(lambda match: b"\n" * match[0].count(b"\n") + b" ", data)
            opened = _OPEN.search(data)
            if opened is not None:
                if final:
                    raise self._fail(data, opened.start(), "a comment without $end")
                if len(data) > 1 << 26:
                    raise self._fail(data, opened.start(), "a comment without $end")
                rest = self._piece(data[: opened.start()], False)
                return rest + data[opened.start() :]
        buf = np.frombuffer(data, np.uint8)
        space = buf <= 32
        edge = np.flatnonzero(space[1:] != space[:-1]) + 1
        if len(buf) and not space[0]:
            edge = np.concatenate(([0], edge))
        if len(edge) % 2:
            # The last token may be incomplete.
            cut = int(edge[-1])
            edge = edge[:-1]
        else:
            cut = len(buf)
        starts, ends = edge[0::2], edge[1::2]
        first = buf[starts]
        size = ends - starts
        pair = self._pairs(first, size)
        if len(pair) and pair[-1]:
            if final:
                raise self._fail(data, int(starts[-1]), "a level without a variable")
            cut = int(starts[-1])
            starts, ends, first, size, pair = starts[:-1], ends[:-1], first[:-1], size[:-1], pair[:-1]
        if not len(starts):
            self.line += data.count(b"\n", 0, cut)
            return data[cut:]
        code_of = np.zeros(len(pair), bool)
        code_of[1:] = pair[:-1]
        stamp = (first == 35) & ~code_of & ~pair
        plain = (self.level[first] != 255) & (size > 1) & ~code_of & ~pair & ~stamp
        other = ~(stamp | plain | code_of | pair)
        self._words(data, starts[other], ends[other])
        times = self._times(data, buf, starts[stamp], ends[stamp])
        # Number of time stamps that precede each token.
        at = np.cumsum(stamp, dtype=np.int32)
        if self.start is None and (len(times) or plain.any() or pair.any()):
            early = plain | pair
            self.start = int(times[0]) if len(times) and not (early & (at == 0)).any() else 0
            if len(times) and int(times[0]) < 0:
                self.start = int(times[0])
            self.now = self.start
        stamps = np.concatenate((np.array([self.now], np.int64), times))
        if len(stamps) > 1:
            back = np.flatnonzero(np.diff(stamps) < 0)
            if len(back):
                raise self._fail(data, int(starts[stamp][back[0]]), "time goes back")
            self.now = int(stamps[-1])
        self._scalars(data, buf, starts[plain], ends[plain], stamps, at[plain])
        if pair.any():
            which = np.flatnonzero(pair)
            self._vectors(data, buf, starts, ends, which, stamps, at)
        self.line += data.count(b"\n", 0, cut)
        return data[cut:]

    def _pairs(self, first: Any, size: Any) -> Any:
        """Return a mask of the tokens after which the code of the variable is a separate token.

        These tokens are vectors, real numbers, texts, and levels that a space separates from the code.
        """
        np = self.np
        pair = np.isin(first, np.frombuffer(b"bBrR", np.uint8)) & (size > 1)
        # The value of a text variable may be empty, as in our own recordings.
        pair |= np.isin(first, np.frombuffer(b"sS", np.uint8))
        pair |= (self.level[first] != 255) & (size == 1)
        if not pair.any():
            return pair
        # An identifier code after a value may itself look like a value; in a run of such words, every second
        # one is a code.
        which = np.flatnonzero(pair)
        begins = np.concatenate(([True], np.diff(which) > 1))
        origin = np.maximum.accumulate(np.where(begins, np.arange(len(which)), 0))
        pair[which[(np.arange(len(which)) - origin) % 2 == 1]] = False
        return pair

    def _words(self, data: bytes, starts: Any, ends: Any) -> None:
        for a, b in zip(starts.tolist(), ends.tolist(), strict=True):
            word = data[a:b]
            if word not in (b"$dumpvars", b"$dumpall", b"$dumpon", b"$dumpoff", b"$end", b"$dumpports"):
                shown = _text(word[:20])
                raise self._fail(data, a, f"{shown!r} is neither a time nor a level")

    def _times(self, data: bytes, buf: Any, starts: Any, ends: Any) -> Any:
        """Return the time stamps in ps."""
        np = self.np
        if not len(starts):
            return np.zeros(0, np.int64)
        size = ends - starts - 1
        odd = size > 18
        found = np.zeros(len(starts), np.int64)
        for place in range(min(18, int(size.max()))):
            live = place < size
            digit = buf[np.where(live, starts + 1 + place, 0)].astype(np.int64) - 48
            bad = live & ((digit < 0) | (digit > 9))
            odd |= bad
            found = np.where(live & ~bad, found * 10 + digit, found)
        odd |= size < 1
        up, down = self.head.scale.numerator, self.head.scale.denominator
        if not odd.any() and int(found.max()) < _MOST_PS // up:
            return (found * up + down // 2) // down
        exact = found.tolist()
        for place in np.flatnonzero(odd).tolist():
            text = data[starts[place] + 1 : ends[place]]
            if not re.fullmatch(rb"-?\d{1,40}(\.\d{1,40})?", text):
                raise self._fail(data, int(starts[place]), f"#{_text(text[:20])} is no time")
            exact[place] = Fraction(text.decode())
        rounded = [round(one * self.head.scale) for one in exact]
        if max(map(abs, rounded)) >= _MOST_PS:
            place = next(n for n, one in enumerate(rounded) if abs(one) >= _MOST_PS)
            raise self._fail(data, int(starts[place]), "more than 50 days")
        return np.array(rounded, np.int64)

    def _lookup(self, data: bytes, buf: Any, starts: Any, ends: Any) -> Any:
        """Return the numbers of the variables whose codes are between these indices."""
        np = self.np
        size = ends - starts
        long = size > self.widest
        keys = np.zeros(len(starts), np.uint64 if self.small is None else np.uint16)
        for place in range(self.widest):
            live = place < size
            byte = buf[np.where(live, starts + place, 0)].astype(keys.dtype)
            keys |= np.where(live, byte << keys.dtype.type(8 * place), keys.dtype.type(0))
        if self.small is not None:
            found = self.small[keys]
        elif len(self.keys):
            place = np.minimum(self.keys.searchsorted(keys), len(self.keys) - 1)
            found = np.where(self.keys[place] == keys, self.order[place], -1)
        else:
            found = np.full(len(keys), -1)
        found = np.where(long, -1, found)
        lost = np.flatnonzero(found < 0)
        if len(lost):
            code = _text(data[starts[lost[0]] : ends[lost[0]]][:20])
            raise self._fail(data, int(starts[lost[0]]), f"no variable has the code {code}")
        return found

    def _scalars(self, data: bytes, buf: Any, starts: Any, ends: Any, stamps: Any, at: Any) -> None:
        np = self.np
        if not len(starts):
            return
        which = self._lookup(data, buf, starts + 1, ends).astype(np.int16)
        levels = self.level[buf[starts]]
        self._store_times(which, stamps[at], levels & 1, levels >> 1)

    def _store_times(self, which: Any, times: Any, levels: Any, unknown: Any) -> None:
        """Add changes of single wires to their variables."""
        np = self.np
        order = np.argsort(which, kind="stable")
        which, times, levels, unknown = which[order], times[order], levels[order], unknown[order]
        bounds = np.flatnonzero(np.diff(which)) + 1
        for begin, end in zip([0, *bounds.tolist()], [*bounds.tolist(), len(which)], strict=True):
            variable = self.head.variables[self.codes[int(which[begin])]]
            if not variable.width:
                continue
            level, doubt = levels[begin:end], unknown[begin:end]
            if variable.width > 1:
                # A single x means that all bits of a vector are unknown.
                full = (1 << variable.width) - 1
                kind = np.dtype(level_type(variable.width)).type
                level, doubt = level.astype(kind), doubt.astype(kind) * kind(full)
            variable.add(times[begin:end], level, doubt if doubt.any() else None)

    def _vectors(
        self, data: bytes, buf: Any, starts: Any, ends: Any, which: Any, stamps: Any, at: Any
    ) -> None:
        """Add changes of vectors. The missing leftmost bits are extended as the format requires."""
        np = self.np
        variables = self._lookup(data, buf, starts[which + 1], ends[which + 1])
        first = buf[starts[which]]
        number = np.isin(first, np.frombuffer(b"rRsS", np.uint8))
        alone = ends[which] - starts[which] == 1
        low = np.where(alone, starts[which], starts[which] + 1)
        for variable in np.flatnonzero(np.bincount(variables)).tolist():
            one = self.head.variables[self.codes[variable]]
            if not one.width:
                continue
            rows = np.flatnonzero((variables == variable) & ~number)
            if not len(rows):
                continue
            begin, end = low[rows], ends[which[rows]]
            size = end - begin
            wide = size > one.width
            if wide.any() and (buf[begin[wide]] != 48).any():
                raise self._fail(data, int(begin[wide][0]), f"more than {one.width} bits")
            kind = np.dtype(level_type(one.width)).type
            levels = np.zeros(len(rows), kind)
            unknown = np.zeros(len(rows), kind)
            left = self.level[buf[begin]]
            for place in range(one.width):
                live = place < size
                value = self.level[buf[np.where(live, end - 1 - place, 0)]]
                # Bits that the file omits are 0, or unknown if the leftmost bit in the file is unknown.
                value = np.where(live, value, left & 2)
                if (value == 255).any():
                    bad = int(begin[np.flatnonzero(value == 255)[0]])
                    raise self._fail(data, bad, "a digit that is no level")
                levels |= (value & 1).astype(kind) << kind(place)
                unknown |= (value >> 1).astype(kind) << kind(place)
            if one.indices[0] > one.indices[-1]:
                levels, unknown = (
                    self._reverse_bits(levels, one.width),
                    self._reverse_bits(unknown, one.width),
                )
            times = stamps[at[which[rows]]]
            one.add(times, levels, unknown if unknown.any() else None)

    def _reverse_bits(self, values: Any, width: int) -> Any:
        """Return the numbers with their bits in reverse order."""
        kind = values.dtype.type
        turned = values & kind(0)
        for place in range(width):
            turned |= ((values >> kind(place)) & kind(1)) << kind(width - 1 - place)
        return turned
