"""Files for GitHub: workflows, forms, citation. The targets and files that they name exist."""

from __future__ import annotations

import re
import subprocess

import pytest
import yaml

from cocotb_tests.harness.paths import ROOT
from openppmc import __version__
from scripts.targets import TARGETS

GITHUB = ROOT / ".github"
WORKFLOWS = sorted((GITHUB / "workflows").glob("*.yml"))
FORMS = sorted(path for path in (GITHUB / "ISSUE_TEMPLATE").glob("*.yml") if path.name != "config.yml")
TOLD = [*WORKFLOWS, *FORMS, ROOT / "CONTRIBUTING.md", ROOT / "SECURITY.md"]
ROOMS = ("tests/", "docs/", "openppmc/", "constraints/", "rtl/", "packages/", ".ci/")
by_name = pytest.mark.parametrize("path", TOLD, ids=lambda path: path.name)


def commands(path) -> str:
    """Return the commands in a file: the steps of a workflow, or else code between backquotes or indented."""
    text = path.read_text(encoding="utf-8")
    if path in WORKFLOWS:
        jobs = yaml.safe_load(text)["jobs"].values()
        return "\n".join(step.get("run", "") for job in jobs for step in job["steps"])
    return "\n".join([*re.findall(r"`([^`\n]+)`", text), *re.findall(r"^    (\S.*)$", text, re.M)])


@by_name
def test_targets_exist(path):
    """Each `make X` in a file names an existing target."""
    assert set(re.findall(r"\bmake ([a-z][\w-]*)", commands(path))) <= set(TARGETS)


@by_name
def test_files_exist(path):
    """Each file or folder of the tree that a file names exists."""
    names = {word for word in re.findall(r"[\w./-]+", commands(path)) if word.startswith(ROOMS)}
    assert not [name for name in names if not (ROOT / name).exists()]


def test_something_is_looked_at():
    """The two tests above find targets and files at all."""
    text = "\n".join(map(commands, TOLD))
    assert {"nightly", "site", "test", "lint"} <= set(re.findall(r"\bmake ([a-z-]+)", text))
    assert ".ci/run" in text and "tests/common/host" in text


def test_every_test_of_a_driver_runs_elsewhere():
    """The workflow for other operating systems names all folders with tests of drivers."""
    text = commands(GITHUB / "workflows" / "host.yml")
    folders = {f"tests/{path.parent.name}/host" for path in (ROOT / "tests").glob("*/host")}
    assert folders == set(re.findall(r"(?<![=/])\btests/\w+/host\b(?!/)", text))


def test_release_workflow():
    """Each job of the release workflow has at most one write permission, and no job uses a secret."""
    text = (GITHUB / "workflows" / "release.yml").read_text(encoding="utf-8")
    flow = yaml.safe_load(text)
    assert flow["permissions"] == {"contents": "read"} and "secrets." not in text
    may = {name: job.get("permissions") for name, job in flow["jobs"].items()}
    assert may == {"build": None, "assets": {"contents": "write"}, "pypi": {"id-token": "write"}}
    assert "make release" in text and "SKIP" not in text


@pytest.mark.parametrize("path", FORMS, ids=lambda path: path.stem)
def test_form(path):
    """A form has a name, a description and questions with unique ids, and requires at least one answer."""
    form = yaml.safe_load(path.read_text(encoding="utf-8"))
    assert form["name"] and form["description"]
    asked = [one for one in form["body"] if one["type"] != "markdown"]
    assert len({one["id"] for one in asked}) == len(asked) > 0
    assert {one["type"] for one in asked} <= {"input", "textarea", "dropdown", "checkboxes"}
    assert any(one.get("validations", {}).get("required") for one in asked)


def test_citation_is_of_this_version():
    """Version and licence in CITATION.cff are those of the package."""
    cited = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    assert cited["cff-version"] == "1.2.0" and cited["authors"] and cited["title"]
    assert (cited["version"], cited["license"]) == (__version__, "Apache-2.0")


def test_files_are_known_to_git():
    """No rule for ignored files matches workflows or forms."""
    names = [str(path.relative_to(ROOT)) for path in TOLD]
    done = subprocess.run(
        ["git", "check-ignore", *names], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert done.stdout == ""
