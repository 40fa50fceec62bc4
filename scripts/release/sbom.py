"""Bill of materials as CycloneDX: RTL files with their digests, packages of the lock."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Iterator
from datetime import datetime, timezone
from pathlib import Path
from uuid import NAMESPACE_URL, uuid5

from cyclonedx.factory.license import LicenseFactory
from cyclonedx.model import HashAlgorithm, HashType, Property
from cyclonedx.model.bom import Bom
from cyclonedx.model.component import Component, ComponentScope, ComponentType
from cyclonedx.output.json import JsonV1Dot6
from packageurl import PackageURL

from cocotb_tests.harness.project import ROOT
from scripts.release.state import Release, tracked

_PINNED = re.compile(r"^([\w.-]+)==(\S+)")
LICENCE = "Apache-2.0"


def pinned(text: str) -> Iterator[tuple[str, str]]:
    """Yield name and version of each package of a lock."""
    for line in text.splitlines():
        if match := _PINNED.match(line):
            yield match[1], match[2]


def _packages() -> Iterator[Component]:
    """Yield the packages of requirements.lock; the metadata of each package names its dependencies."""
    for name, version in pinned((ROOT / "requirements.lock").read_text(encoding="utf-8")):
        purl = PackageURL("pypi", name=name.lower().replace("_", "-"), version=version)
        yield Component(
            name=name,
            version=version,
            type=ComponentType.LIBRARY,
            scope=ComponentScope.EXCLUDED,
            purl=purl,
            bom_ref=purl.to_string(),
        )


def _sources(release: Release) -> Iterator[Component]:
    for path in tracked("rtl"):
        if path.suffix in (".sv", ".svh"):
            digest = hashlib.sha256((ROOT / path).read_bytes()).hexdigest()
            yield Component(
                name=path.as_posix(),
                version=release.version,
                type=ComponentType.FILE,
                bom_ref=path.as_posix(),
                hashes=[HashType(alg=HashAlgorithm.SHA_256, content=digest)],
                licenses=[LicenseFactory().make_with_id(LICENCE)],
            )


def make(release: Release, out: Path, scratch: Path) -> None:
    """Write the bill of materials to `out`. Tools are `excluded`: they are not in the release."""
    bom = Bom(serial_number=uuid5(NAMESPACE_URL, f"openppmc:{release.version}:{release.commit}"))
    bom.metadata.timestamp = datetime.fromtimestamp(release.epoch, timezone.utc)
    bom.metadata.component = Component(
        name="openppmc",
        version=release.version,
        type=ComponentType.LIBRARY,
        bom_ref="openppmc",
        licenses=[LicenseFactory().make_with_id(LICENCE)],
        properties=[Property(name="openppmc:commit", value=release.commit)],
    )
    parts = [*_sources(release), *_packages()]
    bom.components.update(parts)
    bom.register_dependency(bom.metadata.component, parts)
    text = JsonV1Dot6(bom).output_as_string(indent=1)
    (out / f"openppmc-{release.version}.cdx.json").write_text(f"{text}\n", encoding="utf-8")
