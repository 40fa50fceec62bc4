"""Results of all campaigns in one SQLite file; stored results remain even if a process is killed."""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Iterator
from contextlib import closing
from datetime import datetime, timezone
from pathlib import Path
from types import TracebackType

from cocotb_tests.harness.project import BUILD, ProjectError, relative
from scripts.measure.campaign.jobs import Done

RESULTS = BUILD / "campaign" / "results.sqlite"
TABLE = """create table if not exists results (
    campaign text not null, key text not null, stamp text not null,
    good integer not null, data text not null, seconds real not null, ended text not null,
    primary key (campaign, key, stamp)) without rowid"""


class Store:
    """The open file of results; raises ProjectError if it cannot be written or has another format."""

    def __init__(self, path: Path = RESULTS) -> None:
        path.parent.mkdir(parents=True, exist_ok=True)
        try:
            # Several campaigns may write at the same time. Each waits up to a minute for the lock.
            self._base = sqlite3.connect(path, timeout=60, isolation_level=None)
            self._base.execute("pragma journal_mode = wal")
            self._base.execute("pragma synchronous = normal")
            self._base.execute(TABLE)
        except sqlite3.Error as error:
            raise ProjectError(f"{relative(path)}: {error}; remove it to start again") from None

    def __enter__(self) -> Store:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._base.close()

    def note(self, campaign: str, stamp: str, done: Done) -> None:
        """Store one result; it replaces an earlier result of the same job."""
        now = datetime.now(timezone.utc).isoformat(timespec="seconds")
        row = (campaign, done.key, stamp, done.good, json.dumps(done.data), done.seconds, now)
        self._base.execute("insert or replace into results values (?, ?, ?, ?, ?, ?, ?)", row)

    def good(self, campaign: str, key: str, stamp: str) -> Done | None:
        """Return the stored result of a job if there is one and it is good."""
        query = "select data, seconds from results where campaign = ? and key = ? and stamp = ? and good"
        row = self._base.execute(query, (campaign, key, stamp)).fetchone()
        return Done(key, True, json.loads(row[0]), row[1], old=True) if row else None

    def all(self, campaign: str) -> Iterator[tuple[str, Done]]:
        """Yield (stamp, result) of every stored job of a campaign, sorted by key."""
        query = "select stamp, key, good, data, seconds from results where campaign = ? order by key, ended"
        with closing(self._base.execute(query, (campaign,))) as rows:
            for stamp, key, good, data, seconds in rows:
                yield stamp, Done(key, bool(good), json.loads(data), seconds, old=True)

    def forget(self, campaign: str) -> None:
        """Remove all results of a campaign."""
        self._base.execute("delete from results where campaign = ?", (campaign,))
