"""`make release`: its errors, archives that depend only on their contents, a complete dist/."""

from __future__ import annotations

import os
import sys
import tarfile
import zipfile

import pytest

from cocotb_tests.harness import project
from cocotb_tests.harness.project import ProjectError
from scripts.release import __main__ as command
from scripts.release import archive, bitstreams, notes, python, site, state
from scripts.release.__main__ import build

TEXT = "# Changelog\n\n## [Unreleased]\n\n## [1.2.0] - 2026-01-02\n\n- this\n\n## [1.1.0]\n\n- that\n"


def release(**changes) -> state.Release:
    """Return a release of version 1.2.0."""
    return state.Release(
        **{"version": "1.2.0", "commit": "c" * 40, "epoch": 1_700_000_000, "notes": "- this", **changes}
    )


def test_notes_are_the_newest_section():
    """The notes are the text below the newest heading, if [Unreleased] has no text."""
    assert state.section(TEXT, "1.2.0") == "- this"


@pytest.mark.parametrize(
    "text, version, message",
    [
        (TEXT, "1.3.0", r"version 1.3.0, but the newest heading of CHANGELOG.md is \[1.2.0\]"),
        (TEXT, "1.1.0", r"newest heading of CHANGELOG.md is \[1.2.0\]"),
        (TEXT.replace("Unreleased]\n", "Unreleased]\n- new\n"), "1.2.0", r"below \[Unreleased\] the heading"),
        (TEXT.replace("- this", ""), "1.2.0", "has no text below"),
        ("# Changelog\n", "1.2.0", r"is \[none\]"),
    ],
)
def test_version_and_changelog_that_do_not_fit(text, version, message):
    """If the newest heading is not that of the version, or has no text, one line reports it."""
    with pytest.raises(ProjectError, match=message):
        state.section(text, version)


UNRELEASED = TEXT.replace("Unreleased]\n", "Unreleased]\n\n- new\n")


def test_a_trial_takes_what_is_unreleased():
    """A trial uses the text below [Unreleased]; the next heading may have any version."""
    assert state.section(UNRELEASED, "1.2.0", trial=True) == "- new"
    assert state.section(UNRELEASED, "1.3.0", trial=True) == "- new"
    assert state.section("# Changelog\n\n## [Unreleased]\n\n- new\n", "0.1.0", trial=True) == "- new"
    assert state.section(TEXT, "1.2.0", trial=True) == "- this"


@pytest.mark.parametrize("trial", [False, True])
def test_a_heading_that_does_not_fit_is_no_trial(trial):
    """Without text below [Unreleased], the newest heading must be that of the version, even in a trial."""
    with pytest.raises(ProjectError, match=r"version 1.3.0, but the newest heading"):
        state.section(TEXT, "1.3.0", trial=trial)


def git_of(tagged: str, changed: str = ""):
    """Return a replacement of git for commit c…c; the tag of the version is on commit `tagged`."""

    def git(*words: str) -> str:
        if words[0] == "status":
            return changed
        if words[0] == "log":
            return "1700000000"
        if words[0] == "tag":
            return "v" + state.__version__ if tagged else ""
        return tagged if words[1].startswith("refs/tags/") else "c" * 40

    return git


def test_a_trial_of_an_unreleased_tree(monkeypatch, tmp_path):
    """A trial of commits after the newest release gets a version that ends in +trial."""
    changelog = tmp_path / "CHANGELOG.md"
    changelog.write_text(UNRELEASED.replace("1.2.0", state.__version__))
    monkeypatch.setattr(state, "CHANGELOG", changelog)
    monkeypatch.setattr(state, "git", git_of("a" * 40))
    made = state.current_release((), trial=True)
    assert made.trial and made.version == f"{state.__version__}+trial" and made.notes == "- new"
    assert made.name("site", ".tar.gz") == f"openppmc-site-{state.__version__}+trial.tar.gz"
    with pytest.raises(ProjectError, match="exists already, on aaaaaaaaaa"):
        state.current_release()
    monkeypatch.setattr(state, "git", git_of(""))
    with pytest.raises(
        ProjectError, match=r"below \[Unreleased\] the heading .*; a trial needs SKIP= or ONLY="
    ):
        state.current_release()
    monkeypatch.setattr(state, "git", git_of("", " M README.md"))
    with pytest.raises(ProjectError, match="^README.md is not committed"):
        state.current_release((), trial=True)


@pytest.mark.parametrize(
    "arguments, trial",
    [
        ([], False),
        (["--skip", "", "--only", ""], False),
        (["--skip", "site"], True),
        (["--only", "icebreaker"], True),
    ],
)
def test_skip_and_only_make_a_trial(monkeypatch, capsys, arguments, trial):
    """With SKIP or ONLY, the run is a trial, and its last line states this; otherwise it is a release."""
    asked = []

    def current_release(only, trial):
        asked.append(trial)
        return release(trial=trial)

    monkeypatch.setattr(command, "current_release", current_release)
    monkeypatch.setattr(command, "build", lambda of, skip: None)
    monkeypatch.setattr(command.site, "check", lambda: None)
    monkeypatch.setattr(command, "DIST", project.BUILD / "test" / "no_dist")
    (project.BUILD / "test" / "no_dist").mkdir(parents=True, exist_ok=True)
    monkeypatch.setattr(sys, "argv", ["release", *arguments])
    assert command.main() == 0 and asked == [trial]
    assert ("This is a trial" in capsys.readouterr().out) is trial


def test_notes_of_a_trial_say_so():
    """The notes of a trial state at the beginning that it is not a release; other notes do not."""
    text = notes.notes(release(version="1.2.0+trial", trial=True), [])
    assert text.startswith("# OpenPPMC 1.2.0+trial\n\n**Trial, not a release.**")
    assert "rial" not in notes.notes(release(), [])


def test_the_python_package_of_a_trial(tmp_path):
    """In a copy of the package for a trial, the version is that of the trial; for a release it does not
    change.
    """
    file = tmp_path / "openppmc" / "__init__.py"
    file.parent.mkdir()
    text = f'__version__ = "{python.__version__}"\n'
    for version in (python.__version__, f"{python.__version__}+trial"):
        file.write_text(text)
        python.set_version(tmp_path, version)
        assert file.read_text() == f'__version__ = "{version}"\n'


def test_the_site_reports_its_stages(tmp_path, monkeypatch):
    """A release prints the lines of `make site` as soon as they appear; a failure is reported in one line."""
    told = []
    program = (
        "import sys; print('site: pages', flush=True); print('first\\nlast', file=sys.stderr); sys.exit({})"
    )
    monkeypatch.setattr(site, "COMMAND", [sys.executable, "-c", program.format(0)])
    site.run(told.append, tmp_path)
    assert told == ["site: pages"]
    monkeypatch.setattr(site, "COMMAND", [sys.executable, "-c", program.format(1)])
    with pytest.raises(ProjectError, match="^make site: last$"):
        site.run(told.append, tmp_path)


def test_a_tag_elsewhere_is_another_release():
    """A version whose tag is on another commit is rejected; without a tag, or on this commit, it is
    accepted.
    """
    state.check_tag("1.2.0", "a" * 40, "")
    state.check_tag("1.2.0", "a" * 40, "a" * 40)
    with pytest.raises(ProjectError, match="v1.2.0 exists already, on bbbbbbbbbb"):
        state.check_tag("1.2.0", "a" * 40, "b" * 40)


def test_a_changed_tree_is_refused(monkeypatch):
    """If a file is not committed, one line names it."""
    monkeypatch.setattr(state, "git", lambda *words: " M README.md" if words[0] == "status" else "")
    with pytest.raises(ProjectError, match="^README.md is not committed"):
        state.current_release()


@pytest.mark.parametrize("pack, suffix", [(archive.tar_gz, ".tar.gz"), (archive.zipped, ".zip")])
def test_archives_depend_on_their_contents_alone(tmp_path, pack, suffix):
    """Files with the same contents result in the same archive, regardless of their times, modes and order."""
    made = []
    for number, names in enumerate((("a", "b/c"), ("b/c", "a"))):
        folder = tmp_path / str(number)
        for name in names:
            path = folder / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(name)
            path.chmod(0o600 + 0o44 * number)
            os.utime(path, (1000 * number, 1000 * number))
        target = tmp_path / f"{number}{suffix}"
        pack(target, archive.files_below(folder), 1_700_000_000)
        made.append(target.read_bytes())
    assert made[0] == made[1]
    other = tmp_path / f"other{suffix}"
    pack(other, {"a": b"a", "b/c": b"x"}, 1_700_000_000)
    assert other.read_bytes() != made[0]
    if suffix == ".zip":
        assert zipfile.ZipFile(other).namelist() == ["a", "b/c"]
    else:
        assert tarfile.open(other).getnames() == ["a", "b/c"]


def test_unknown_bitstreams_are_named():
    """For an unknown bitstream, one line lists the existing ones; without names, all are built."""
    with pytest.raises(
        ProjectError, match="ONLY=nosuch: no such bitstream .there are icebreaker, icebreaker-bus"
    ):
        bitstreams.selected(("nosuch",))
    assert list(bitstreams.selected(("ulx3s-25f-stmc",))) == ["ulx3s-25f-stmc"]
    assert len(bitstreams.selected(())) > 30


def test_a_missing_tool_is_told_before_anything_is_made(monkeypatch):
    """A missing npm is reported in one line before the build begins; without the site, npm is not
    required.
    """
    made = []
    monkeypatch.setattr(site.shutil, "which", lambda name: None)
    monkeypatch.setattr(command, "current_release", lambda only, trial: release())
    monkeypatch.setattr(command, "build", lambda of, skip: made.append(skip))
    monkeypatch.setattr(command, "DIST", project.BUILD / "test" / "no_dist")
    (project.BUILD / "test" / "no_dist").mkdir(parents=True, exist_ok=True)
    monkeypatch.setattr(sys, "argv", ["release"])
    with pytest.raises(ProjectError, match="^npm is not installed; install Node.js"):
        command.main()
    assert made == []
    monkeypatch.setattr(sys, "argv", ["release", "--skip", "site"])
    assert command.main() == 0 and made == [{"site"}]


def test_dist_is_whole_or_as_it_was(tmp_path):
    """If a step fails, dist/ is unchanged; otherwise it contains files, checksums and notes."""
    dist, scratch = tmp_path / "dist", tmp_path / "scratch"

    def good(of, out, folder):
        (out / of.name("rtl", ".tar.gz")).write_bytes(b"rtl")

    def bad(of, out, folder):
        raise ProjectError("a tool is missing")

    dist.mkdir()
    (dist / "before").touch()
    with pytest.raises(ProjectError, match="a tool is missing"):
        build(release(), set(), dist, scratch, lambda say: {"rtl": good, "site": bad, "notes": notes.make})
    assert [path.name for path in dist.iterdir()] == ["before"]
    build(release(), {"site"}, dist, scratch, lambda say: {"rtl": good, "site": bad, "notes": notes.make})
    names = sorted(path.name for path in dist.iterdir())
    assert names == ["RELEASE_NOTES.md", "SHA256SUMS", "openppmc-rtl-1.2.0.tar.gz"]
    text = (dist / "RELEASE_NOTES.md").read_text()
    assert "- this" in text and "The site: left out (SKIP)." in text and "c" * 40 in text
    assert [row.split()[1] for row in (dist / "SHA256SUMS").read_text().splitlines()] == [names[0], names[2]]
