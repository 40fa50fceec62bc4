"""Hypothesis as in tests/model: fixed examples by default, new ones with OPENPPMC_EXPLORE=1."""

from __future__ import annotations

import os

from hypothesis import HealthCheck, settings

_COMMON = {"deadline": None, "suppress_health_check": [HealthCheck.too_slow, HealthCheck.data_too_large]}
settings.register_profile("host-fixed", derandomize=True, database=None, max_examples=100, **_COMMON)
settings.register_profile("host-explore", print_blob=True, max_examples=1000, **_COMMON)
settings.load_profile("host-explore" if os.environ.get("OPENPPMC_EXPLORE") else "host-fixed")
