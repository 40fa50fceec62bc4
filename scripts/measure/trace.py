"""`make trace`: list the tests of each rule and their results.

The rules are the rows `| P104-ABC-NN | text |` and `| AC-NN | text |` of docs/<part>/README.md (for stmc also
`| J105-NN | text |`). The results are in build/trace/results.jsonl, written by the last test runs. The output
is docs/<part>/traceability.md. The exit code is 1, with a list, if a rule has no passing test, a test names
an unknown rule, or a test failed.
"""

from __future__ import annotations

import argparse
import json
import re
import sys
from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from cocotb_tests.harness.collect import manual_rules, part_of_rule
from cocotb_tests.harness.project import BUILD, DOCS, ProjectError, console, part, run
from openppmc.parts import PARTS
from scripts.markdown import table
from scripts.measure.prove.results import by_rule, failed
from scripts.measure.prove.table import Proof

CHECK = re.compile(r"AC-|\w+-(?:CHK|AC)-")
RESULTS = BUILD / "trace" / "results.jsonl"

Record = Mapping[str, Any]


@dataclass
class Group:
    """All runs of one test function: its configurations, number of runs, number of passed runs."""

    name: str
    configs: set[str] = field(default_factory=set)
    runs: int = 0
    passed: int = 0

    def __str__(self) -> str:
        count = f" ×{self.runs}" if self.runs > 1 else ""
        where = f" ({', '.join(sorted(self.configs))})" if self.configs else ""
        return f"`{self.name}`{count}{where}"


@dataclass
class Trace:
    """The rules with their results; `problems` is empty if every rule has tests and all tests pass."""

    rules: dict[str, str]
    groups: dict[str, list[Group]]
    problems: list[str]
    proofs: Mapping[str, Sequence[Proof]] = field(default_factory=dict)

    def proved(self, rule: str) -> str:
        """Return the names of a rule's proofs (docs/proofs.md), with the cycles of a bounded proof."""
        bound = {one.name: f" ({one.bound} cycles)" if one.bound else "" for one in self.proofs.get(rule, ())}
        return "<br>".join(f"`{name}`{words}" for name, words in bound.items())

    def result(self, rule: str) -> str:
        """Return the text for the column "Result": pass, FAIL or NO TEST."""
        groups = self.groups.get(rule, [])
        if not groups:
            return "NO TEST"
        return "pass" if all(group.passed == group.runs for group in groups) else "FAIL"


def _part(record: Record) -> str:
    """Return the part to whose manual a record refers, for records whose rules do not name the part."""
    row = PARTS.get(record["part"])
    return row.folder if row else str(record["part"])


def load_records(path: Path, part_name: str) -> list[Record]:
    """Return the test records of one part, in order of test ID."""
    if not path.is_file():
        raise ProjectError("no test results yet: run `make test` first")
    records = [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()]
    own = [
        record
        for record in records
        if _part(record) == part_name or any(part_of_rule(rule) == part_name for rule in record["rules"])
    ]
    return sorted(own, key=lambda record: record["test"])


def join(rules: dict[str, str], records: Iterable[Record], part_name: str) -> Trace:
    """Assign the test records to the rules. Each rule without a test and each failure is a problem."""
    found: dict[str, dict[str, Group]] = defaultdict(dict)
    failed, unknown = [], []
    for record in records:
        if record["outcome"] != "passed":
            failed.append(f"test {record['outcome']}: {record['test']}")
        for rule in record["rules"]:
            # The IDs AC-NN are not unique: each part has its own.
            if (part_of_rule(rule) or _part(record)) != part_name:
                continue
            if rule not in rules:
                unknown.append(f"unknown rule {rule}: named by {record['test']}")
                continue
            group = found[rule].setdefault(record["name"], Group(record["name"]))
            runs = record.get("runs", 1)
            group.runs += runs
            group.passed += runs if record["outcome"] == "passed" else 0
            if record["config"]:
                group.configs.add(record["config"])
    groups = {rule: [by_name[name] for name in sorted(by_name)] for rule, by_name in found.items()}
    bare = [
        f"rule without a passing test: {rule}"
        for rule in rules
        if not any(g.passed for g in groups.get(rule, []))
    ]
    return Trace(rules, groups, [*bare, *unknown, *failed])


def unproved(proofs: Mapping[str, Sequence[Proof]], rules: Mapping[str, str], part_name: str) -> list[str]:
    """Return the problems of a part's proofs: unknown rules, and proofs whose last run has failed."""
    own = {rule: every for rule, every in proofs.items() if part_of_rule(rule) == part_name}
    strange = [
        f"unknown rule {rule}: named by proof {every[0].name}"
        for rule, every in own.items()
        if rule not in rules
    ]
    names = {one.name for every in own.values() for one in every}
    return strange + [f"proof failed: {name}" for name in failed() if name in names]


def at_home(statement: str) -> str:
    """Return a statement of docs/<part>/README.md with links relative to the page in the same folder."""
    return re.sub(r"\]\(#", "](README.md#", statement)


def _table(trace: Trace, rules: Sequence[str]) -> str:
    rows = []
    for rule in rules:
        tests = "<br>".join(str(group) for group in trace.groups.get(rule, [])) or "none"
        statement = at_home(trace.rules[rule])
        rows.append((rule, statement, tests, trace.result(rule), trace.proved(rule)))
    return table(("Rule", "Statement", "Tests", "Result", "Proved"), rows)


def page(trace: Trace, part_name: str) -> str:
    """Return the page in Markdown; the same results always give the same text."""
    checks = [rule for rule in trace.rules if CHECK.match(rule)]
    rules = [rule for rule in trace.rules if not CHECK.match(rule)]
    passing = sum(trace.result(rule) == "pass" for rule in rules)
    passing_checks = sum(trace.result(rule) == "pass" for rule in checks)
    lines = [
        f"# Traceability of {part_name}",
        "",
        "Generated by `make trace` from the rule list of"
        f" [docs/{part_name}/README.md](README.md) and the last test results; not edited by hand.",
        "",
        f"{passing} of {len(rules)} rules and {passing_checks} of {len(checks)} acceptance checks have tests"
        " that all pass. A number after × says how often a test ran (seeds or configurations);"
        " the names in brackets are the build configurations of `cocotb_tests/harness/config.py`."
        f" {sum(bool(trace.proved(rule)) for rule in trace.rules)} of them are proved as well, as far as"
        " [proofs.md](../proofs.md) says of each proof.",
        "",
        "## Rules",
        "",
        _table(trace, rules),
    ]
    if checks:
        lines += ["", "## Acceptance checks", "", _table(trace, checks)]
    return "\n".join(lines) + "\n"


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; return the exit code."""
    parser = argparse.ArgumentParser(
        prog="python -m scripts.measure.trace", description=(__doc__ or "").splitlines()[0]
    )
    parser.add_argument("part", nargs="?", default="ppmc104")
    name = parser.parse_args(arguments).part
    try:
        part(name)
        rules = manual_rules(name)
        if not rules:
            raise ProjectError(f"docs/{name}/README.md lists no rules: nothing to trace")
        trace = join(rules, load_records(RESULTS, name), name)
        trace.proofs = by_rule()
        trace.problems += unproved(trace.proofs, rules, name)
    except (ProjectError, ValueError) as error:
        console.print(f"error: {error}", markup=False)
        return 2
    target = DOCS / name / "traceability.md"
    target.write_text(page(trace, name), encoding="utf-8")
    for problem in trace.problems:
        console.print(problem, markup=False)
    if trace.problems:
        console.print(f"error: {len(trace.problems)} traceability problems of {name}", markup=False)
        return 1
    tests = {group.name for groups in trace.groups.values() for group in groups}
    console.print(
        f"{name}: all {len(trace.rules)} rules have passing tests ({len(tests)} tests)", markup=False
    )
    return 0


if __name__ == "__main__":
    sys.exit(run(main))
